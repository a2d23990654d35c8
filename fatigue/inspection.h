// Whether visual checks find abrasion before the surface is worn through.
//
// A dresspack that fails at the age T is visibly worn from the age v T on. Checks find it by (F32),
// pipeline/life/visual_checks.h, with W = (1 - v) T. v follows from the depth d h at which wear is visible. The worn area grows
// evenly, so v = A(d h, b) / A(h, b) with (F28), (F29) at the arc b that is worn through first.
//
// Not contained: damage that every check misses at the same place; wear that is seen but not repaired.
#pragma once

#include <vector>

#include "pipeline/job/fatigue.h"
#include "pipeline/job/inspection.h"
#include "pipeline/life/visual_checks.h"

namespace dresslife::fatigue {

/// Results for one mode, until the dresspack is replaced.
struct Inspected {
  double failed_share = 0;  ///< share of all samples
  double found_share = 0;   ///< share of the failing samples that a check finds before they fail; NaN: none fails
  double unseen_share = 0;  ///< share of all samples that fail without being found
};
/// A dresspack is replaced when 1 of 10 has failed by the wires, earlier when its own wires fail, and with its robot at the latest.
/// lives: (sample) log10 repeats; wires: the same by the validated modes of this dresspack, infinite if only the robot ends it;
/// repeat: duration of one [s]; visible_from: v. Precondition: the interval is not 0.
Inspected inspected(const std::vector<double>& lives, const std::vector<double>& wires, double repeat,
                    double visible_from, const pipeline::Inspection& inspection, const pipeline::Fatigue& fatigue);

}  // namespace dresslife::fatigue
