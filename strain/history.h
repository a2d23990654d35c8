// The deformation of segments over time, in the layout of the kernels: for each segment and channel one row of samples, padded.
#pragma once

#include <vector>

#include "strain/deformation.h"
#include "strain/kernels/kernels.h"

namespace dresslife::strain {

/// Returns the number of samples, rounded up to a multiple of the number that the kernels process at a time.
inline std::size_t padded(std::size_t samples) { return (samples + padding - 1) / padding * padding; }

class DeformationHistory {
 public:
  DeformationHistory(std::size_t segments, std::size_t samples)
      : samples_(samples), stride_(padded(samples)), values_(segments * 4 * stride_, 0.0) {}

  std::size_t samples() const { return samples_; }

  void set(std::size_t segment, std::size_t sample, const Deformation& deformation) {
    double* at = values_.data() + segment * 4 * stride_ + sample;
    at[0] = deformation.curvature1;
    at[stride_] = deformation.curvature2;
    at[2 * stride_] = deformation.twist;
    at[3 * stride_] = deformation.elongation;
  }

  DeformationColumns columns(std::size_t segment) const {
    const double* at = values_.data() + segment * 4 * stride_;
    return {at, at + stride_, at + 2 * stride_, at + 3 * stride_};
  }

 private:
  std::size_t samples_, stride_;
  std::vector<double> values_;
};

}  // namespace dresslife::strain
