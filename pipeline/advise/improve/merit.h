// The order of candidates of `improve` and `route`. The first difference in this list decides:
//
// (M1) it runs; it keeps all limits; no mode without a validated law and no limit at other values gets worse.
//      t_m: p10 life by mode m (abrasion, jacket wear, ...). h: p10 life of the wires. L: fatigue.robot_life_hours.
//      Mode m gets worse if t_m < min(L, h, t_m0 / 1.1). t_m0 is the life by that mode in the original job.
//      A mode that comes after L or h is no reason to replace a dresspack. 1.1: twice the segments change a
//      wear depth by up to 10 %.
//      Limits at other values get worse if a larger share of such dresspacks exceeds one, in whole percent, than of the
//      original job (or than AskedLimits::other_values). An original job that exceeds limits itself is no reference.
// (M2) longer min(h, L, t_m of the modes that get worse): wires that outlive the robot gain nothing from a longer life
// (M3) longer min(L, all t_m): the mode that comes first
// (M4) larger distance to the nearest limit
// (M5) longer h
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "pipeline/advise/improve/outcome.h"

namespace dresslife::pipeline {

enum class Kept {
  nothing,
  run,
  limits,
  modes
};  ///< (M1) in rising order: it does not run; it violates a limit; a mode or a limit at other values gets worse; all is kept

struct Merit {
  Kept kept = Kept::nothing;
  double counted_hours = 0;  ///< (M2)
  double first_hours = 0;    ///< (M3)
  double margin = 0;         ///< (M4), unit of Outcome::beyond
  double hours = 0;          ///< (M5)
  /// Compares in the order of the members. Greater: better.
  std::partial_ordering operator<=>(const Merit&) const = default;
};

/// Returns the merit. as_it_is: outcome of the original job. If it does not run, or lacks a mode, t_m0 is infinite.
Merit merit_of(const Outcome& outcome, const Outcome& as_it_is);

/// Returns the hours until this mode; infinite: the mode does not occur, or the job does not run.
double life_by(const Outcome& outcome, const std::string& mode);

/// Returns the modes that get worse (M1), the earliest first.
std::vector<ModeLife> worse_modes(const Outcome& outcome, const Outcome& as_it_is);

/// Returns whether limits at other values get worse (M1).
bool exceeds_more(const Outcome& outcome, const Outcome& as_it_is);

/// Returns the mode that comes first; its hours are infinite if none comes within the robot's life.
ModeLife first_mode(const Outcome& outcome);

/// Returns one number for the models of a search; larger is better. It follows (M2) and (M3). A mode that gets worse
/// reduces it by the logarithm of the ratio of its limit in (M1) to t_m, a larger share at other values by that of the shares.
/// Precondition: the outcome ran.
double search_value(const Outcome& outcome, const Outcome& as_it_is);

/// Returns the p10 life until the wires or a mode fail, at most that of the robot.
double first_failure(const Merit& merit);

/// Returns whether a mode or a limit at other values gets worse and the first failure comes earlier by more than the 10 % of (M1).
bool fails_earlier(const Merit& one, const Merit& other);

/// Returns whether the first is better by more than the 10 % of (M1) in (M2), or with equal (M2) in (M3), or in (M1). A candidate
/// that fails earlier is not, even if it alone keeps all limits.
bool clearly_better(const Merit& one, const Merit& other);

/// Returns the modes within the robot's life, the earliest first, joined by commas: "jacket wear from 5,890 h". Empty: none.
std::string mode_words(const Outcome& outcome);

}  // namespace dresslife::pipeline
