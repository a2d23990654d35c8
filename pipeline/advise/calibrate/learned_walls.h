// What dresspacks in service teach of the strength of hoses' walls (pipeline/job/wall_strength.h).
//
// A hose that had not cracked at an age says S(age) of (P5), over the lives of (F37). Nothing of the wires depends on this strength,
// so it is learned by itself: prior N(0, 1), the posterior by sums over equal steps of z.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/calibrate/emulation.h"

namespace dresslife::pipeline {

struct LearnedWall {
  std::string name;                            ///< wall_strength_of()
  double mean = 0, deviation = 1;              ///< of z
  double low = 0, median = 0, high = 0;        ///< z: 80 % lie between low and high
};

/// One for each material. Tests without a wall say nothing.
std::vector<LearnedWall> learned_walls(const std::vector<EmulatedTest>& tests);

}  // namespace dresslife::pipeline
