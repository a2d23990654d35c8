// The order of the programs of a duty: one round as a separate motion, which includes the changes between programs.
//
// A round has o_k runs of program k and n_k repeats. A run is a number of consecutive repeats. Cycles of a program after itself
// are those of its own steady state. One repeat of each run is next to other programs. The motion of a round contains each run
// once: the programs one after the other, then the first one again. D_o: damage of this motion. r_k: repeats per hour.
//     damage per hour = sum over k of (r_k - c o_k) D_k + c D_o,   c = min over k of r_k / n_k          (D8)
// c is the number of rounds per hour. Repeats beyond c n_k belong to no round.
// (D8) is exact without memory: the cycles of A A B B are those of A, of B, and of A B. Loose cables and friction have a
// memory of the previous program; (D8) assumes that it has vanished after one repeat.
// D_o is evaluated only at the medians of the uncertain parameters. (D8) changes the damage of all samples by one factor for
// each mode, as (D2) does. Samples of the round's own run would contain the equilibrium that loose cables find by chance at
// another slack; it differs between two runs of one motion by more than the effect of all changes (README).
// If a program ends in another pose than the next one begins, all axes move to it together, with 50 % of the speed and
// 25 % of the acceleration of the slowest axis: position over time is 10 u^3 - 15 u^4 + 6 u^5. ASSUMPTION: a gentle move.
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

/// Returns the name of a round's job: "spot_robot_1+hard", the same for the same order in another duty. Empty: no order.
std::string round_name(const Duty& duty);

/// Returns repeats per hour by (D8): (program, then the round if the duty has an order). repeats_per_hour: (program) r_k.
std::vector<double> repeats_in_rounds(const Duty& duty, const std::vector<double>& repeats_per_hour);

/// Returns a recording of the programs one after the other, with moves between them: time_s, axis_1_deg, ... axes: the driven
/// joints. Precondition: each course has two samples or more.
std::string round_csv(const std::vector<JointCourse>& programs, const std::vector<Joint>& axes);

/// Leaves the job without uncertain parameters. Medians that a calibration or makers' ratings put into its keys stay. The
/// calibration is removed, because without uncertainty the stages would reset these medians to neutral values.
void evaluate_at_medians(Job& job);

/// Returns the jobs of all rounds, each once. Writes their motions to this folder, from the results of the programs.
/// Errors: InputError for programs without joint angles in their results, and for external axes.
Study study_of_rounds(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                      const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
