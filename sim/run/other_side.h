// Dresspacks that rest on both sides of their clamps and move differently on each.
//
// Between clamps in one plane with the arm a hose can rest on the left and on the right. Chance decides on which side it is mounted.
// Some motions forget this start, in others the hose keeps a way of its own on each side.
#pragma once

#include <limits>
#include <vector>

#include "pipeline/base/warnings.h"
#include "sim/rod/rod.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// The states of a run at its begin, and at the end of its last repeat.
struct Ends {
  RodState begin, end;
};

/// Returns a warning for each dresspack without routing.side that is mounted in another shape if it is pulled to a side, and then ends
/// the program more than half its diameter from `own`. own: of the run of this setup with this time step [s]. Other runs end after
/// `most_work` (World::work); a run that ends so is not compared.
std::vector<pipeline::Warning> other_side_warnings(const pipeline::Setup& setup, double time_step, const Ends& own,
                                                   double most_work = std::numeric_limits<double>::infinity());

}  // namespace dresslife::sim
