// The order of the programs of a duty: one round of them as a motion of its own, so that the changes between programs count.
//
// A round has o_k runs of program k in a row and n_k repeats. Cycles of a program after itself are those of its own steady
// state. Each run of it has one repeat beside other programs. The motion of a round has each run once: the programs one
// after the other, then again the first one. With D_o the damage of this motion, and of the programs r_k repeats per hour,
//     damage per hour = sum over k of (r_k - c o_k) D_k + c D_o,   c = min over k of r_k / n_k          (D8)
// c is the number of rounds per hour. Repeats that the numbers of the other programs leave over are in no round.
// Without memory this is exact: the cycles of A A B B are those of A, of B, and of A B. Loose cables and friction keep a
// memory of the program before; (D8) takes it to be gone after one repeat.
// D_o is evaluated at the medians of the uncertain parameters only. (D8) changes the damage of all samples by one factor for
// each mode, as (D2) does: a run's own samples contain the rest that loose cables happen to find at another slack, which
// differs between two runs of one motion by more than all changes do (README).
// Where a program ends in another pose than the next one begins, all axes move there together, with 50 % of the speed and
// 25 % of the acceleration of the slowest: position over time is 10 u^3 - 15 u^4 + 6 u^5. ASSUMPTION: a gentle move of a plant.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

struct Joint;

/// Joint angles of a program over time.
struct JointCourse {
  std::vector<double> times;   ///< (sample) [s], from 0
  std::vector<double> angles;  ///< (sample, axis) [rad]
};

/// The job of a round: "spot_robot_1+hard", the same for the same order in another duty. Empty: the duty has no order.
std::string round_name(const Duty& duty);

/// (program, then the round; without an order the programs only) repeats per hour by (D8). repeats_per_hour: (program) r_k.
std::vector<double> repeats_in_rounds(const Duty& duty, const std::vector<double>& repeats_per_hour);

/// A recording of the programs one after the other, with moves between them: time_s, axis_1_deg, ... axes: the driven
/// joints. Precondition: each course has two samples or more.
std::string round_csv(const std::vector<JointCourse>& programs, const std::vector<Joint>& axes);

/// The jobs of all rounds, each once. Their motions are written to this folder, from the results of the programs.
/// Errors: InputError for programs without joint angles in their results, and for external axes.
Study study_of_rounds(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                      const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
