// What a robot program could do instead: the lines that cost most reach the same targets in another way.
//
// A wrist whose axes 4 and 6 lie along each other at axis 5 = 0, and whose axis 5 crosses them at a right
// angle in a point, reaches every pose twice, because R_x(pi) R_y(-b) R_x(pi) = R_y(b), and more often by
// whole turns of axes 4 and 6:
//     (q4, q5, q6) -> (q4 +- 180 deg, -q5, q6 +- 180 deg)
//     (q4, q5, q6) -> (q4 +- 360 deg, q5, q6)
//     (q4, q5, q6) -> (q4, q5, q6 +- 360 deg)
// Another configuration of axes 1 to 3 (other_arms.h) reaches it, too. Each way is tried at each line by
// itself, and at all lines together, which saves the turn there and back. Each line is also tried more
// slowly, and through a point on its way, so that arm and wrist move one after the other. All this holds for
// programs of steps with joint targets only: targets of the tool take the nearest turn.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {

struct OtherWay {
  std::string what;                ///< "axis 6 turned by +360 deg"
  std::vector<std::string> lines;  ///< "hard.yaml:13 'round: gun out to the left'"; empty: all
  std::vector<std::string> sets;   ///< "motion.steps.2.steps.1.joints_deg=[...]"
};

/// Other joint angles for those of a target [rad]; absent: there are none within the axes' limits.
struct NamedTurn {
  std::string name;
  std::function<std::optional<std::vector<double>>(const std::vector<double>&)> turn;
};

/// The turns of wrist and arm above, of a robot that must outlive them; empty: its wrist is another.
std::vector<NamedTurn> other_turns(const Robot& robot);

/// line_damage: (line) what each costs, as read_life() tells; what a dwell costs counts to the move before.
/// most_lines: of those that cost most. Targets beyond the axes' limits are left out. Errors: InputError for
/// a motion without steps that have joint targets.
std::vector<OtherWay> other_ways(const Job& job, const std::vector<double>& line_damage,
                                 std::size_t most_lines);

}  // namespace dresslife::pipeline
