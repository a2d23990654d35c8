#include "pipeline/advise/calibrate/emulator.h"

#include <algorithm>
#include <cassert>

namespace dresslife::pipeline {
namespace {

/// Returns the slope limited to 0 .. 2 times the slope of the chord.
double going_on(double slope, double chord) {
  return chord >= 0 ? std::clamp(slope, 0.0, 2 * chord) : std::clamp(slope, 2 * chord, 0.0);
}

}  // namespace

Emulator::Emulator(Eigen::VectorXd centre, Eigen::VectorXd step, double value, const Eigen::VectorXd& low,
                   const Eigen::VectorXd& high)
    : value_(value), centre_(std::move(centre)), step_(std::move(step)) {
  assert(centre_.size() == step_.size() && centre_.size() == low.size() && centre_.size() == high.size());
  slope_ = (high - low) / 2;
  bend_ = (high + low).array() / 2 - value;
  slope_low_.resize(slope_.size());
  slope_high_.resize(slope_.size());
  for (Eigen::Index j = 0; j < slope_.size(); ++j) {
    slope_low_[j] = going_on(slope_[j] - 2 * bend_[j], value - low[j]);
    slope_high_[j] = going_on(slope_[j] + 2 * bend_[j], high[j] - value);
  }
}

double Emulator::operator()(const Eigen::VectorXd& z) const {
  double sum = value_;
  for (Eigen::Index j = 0; j < slope_.size(); ++j) {
    const double d = (z[j] - centre_[j]) / step_[j], within = std::clamp(d, -1.0, 1.0);
    sum += within * (slope_[j] + within * bend_[j]);
    sum += (d - within) * (d < 0 ? slope_low_[j] : slope_high_[j]);
  }
  return sum;
}

}  // namespace dresslife::pipeline
