// The share of a run that is done, from the times at which its stages ended. Stages differ: the strain stage takes most of a job's
// time, and one strain stage may serve many fatigue stages. A share of the number of stages can give a remaining time that is wrong
// by a factor of ten and more.
#pragma once

#include <array>
#include <cstddef>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

class RunShare {
 public:
  /// counts: number of the run's stages of each kind.
  explicit RunShare(const std::array<std::size_t, stage_count>& counts) : left_(counts) {}
  /// Notes the end of a stage. seconds: since the start of the run. Returns the share of the run's time that has passed. It falls
  /// if stages take longer than expected.
  double ended(std::size_t stage, double seconds);

 private:
  std::array<std::size_t, stage_count> left_, ended_{};
  std::array<double, stage_count> seconds_{};  ///< wall time between the ends of stages, by the stage that ended
  double last_ = 0;
};

}  // namespace dresslife::pipeline
