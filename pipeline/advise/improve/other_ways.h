// Alternatives for the most damaging lines of a program: the same targets on another path.
//
// Each turn of wrist and arm (pipeline/arm/other_turns.h) is tried at each line alone, and at all lines together, which
// saves the turn there and back. Each line is also tried more slowly, and through an intermediate point, so that arm
// and wrist move one after the other. Only for programs of steps with joint targets, because a target of the tool always uses the
// nearest turn.
#pragma once

#include <string>
#include <vector>

#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {

struct OtherWay {
  std::string what;                ///< "axis 6 turned by +360 deg"
  std::vector<std::string> lines;  ///< "hard.yaml:13 'round: gun out to the left'"; empty: all lines
  std::vector<std::string> sets;   ///< "motion.steps.2.steps.1.joints_deg=[...]"
};

/// Returns the alternatives. line_damage: (line) damage of each line (read_life()); the damage of a dwell is added to the move
/// before it. most_lines: number of lines, most damaging first. Targets beyond the axes' limits are left out. Errors: InputError
/// for a motion without steps with joint targets.
std::vector<OtherWay> other_ways(const Job& job, const std::vector<double>& line_damage, std::size_t most_lines);

}  // namespace dresslife::pipeline
