// Strength of the hoses' walls, learned from dresspacks in service (pipeline/job/wall_strength.h).
//
// A hose that had not cracked at an age has the likelihood S(age) of (P5), over the lives of (F37). The wires do not depend on
// this strength, so it is learned separately: prior N(0, 1), posterior by sums over equal steps of z.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/calibrate/emulation.h"

namespace dresslife::pipeline {

struct LearnedWall {
  std::string name;                      ///< wall_strength_of()
  double mean = 0, deviation = 1;        ///< mean and standard deviation of z
  double low = 0, median = 0, high = 0;  ///< deciles of z
};

/// Returns one result for each material. Tests without a wall have no influence.
std::vector<LearnedWall> learned_walls(const std::vector<EmulatedTest>& tests);

}  // namespace dresslife::pipeline
