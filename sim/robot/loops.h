// Loops of a motion: successive equal parts, as those of a program's repeats.
#pragma once

#include <vector>

#include "sim/robot/motion.h"

namespace dresslife::sim {

/// Returns, (piece), the index of the first piece that is equal to it, except in its time and program lines.
std::vector<std::size_t> first_equal_pieces(const JointMotion& motion);

struct MotionLoop {
  double begin = 0;  ///< [s]
  double round = 0;  ///< duration of one round [s]
  int rounds = 0;

  double end() const { return begin + rounds * round; }
};

/// Returns the loops of at least three rounds in the order of time. They do not overlap. A loop may begin within the block that the
/// program repeats.
std::vector<MotionLoop> loops_of(const JointMotion& motion);

}  // namespace dresslife::sim
