// The line of each dresspack in a motion file: base clamp, segment centres, tool clamp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Indices of one dresspack's points in a row of /clamp/position and of /segment/position.
struct DresspackLine {
  std::size_t base_clamp = 0, first_segment = 0, segments = 0, tool_clamp = 0;

  std::size_t points() const { return segments + 2; }
  /// Returns the points, (points) [m]. clamps, centres: rows of the datasets, (point, 3).
  std::vector<Eigen::Vector3d> in(const std::vector<double>& clamps, const std::vector<double>& centres) const;
};

/// Returns one line per dresspack, in the order of the file. Errors: InputError.
std::vector<DresspackLine> hose_lines(const FileReader& motion);

}  // namespace dresslife::pipeline
