// Poses of a uniformly bent and twisted hose, as in a motion.h5.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::tests {

struct HosePoses {
  std::vector<double> position, orientation, clamp_position, clamp_orientation;

  /// Adds the segments and clamps of one hose at one sample. rate: its rotation [1/m].
  void add(const Eigen::Vector3d& rate, double length, std::size_t segments) {
    const double l = length / static_cast<double>(segments);
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Eigen::Vector3d x(0, 0, 0);
    const auto put = [&](std::vector<double>& positions, std::vector<double>& orientations) {
      positions.insert(positions.end(), {x.x(), x.y(), x.z()});
      orientations.insert(orientations.end(), {q.w(), q.x(), q.y(), q.z()});
    };
    const auto advance = [&](double by) {
      const double angle = rate.norm() * by;
      if (angle > 0) q = q * Eigen::Quaterniond(Eigen::AngleAxisd(angle, rate.normalized()));
    };
    put(clamp_position, clamp_orientation);
    advance(l / 2);
    for (std::size_t i = 0; i < segments; ++i) {
      x += l / 2 * (q * Eigen::Vector3d::UnitZ());
      put(position, orientation);
      x += l / 2 * (q * Eigen::Vector3d::UnitZ());
      advance(i + 1 < segments ? l : l / 2);
    }
    put(clamp_position, clamp_orientation);
  }

  void append_to(pipeline::FileWriter& file, const std::string& group = "") const {
    file.append(group + "/segment/position", position);
    file.append(group + "/segment/orientation", orientation);
    file.append(group + "/clamp/position", clamp_position);
    file.append(group + "/clamp/orientation", clamp_orientation);
  }
};

}  // namespace dresslife::tests
