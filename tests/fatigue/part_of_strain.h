// A strain file with only the datasets that a test needs.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::fatigue_tests {

/// Returns the format of strain.h5 with only these datasets, all of them optional.
inline pipeline::Format part_of_strain(const std::vector<std::string_view>& datasets) {
  pipeline::Format part = pipeline::strain_format();
  part.attributes.clear();
  std::erase_if(part.datasets,
                [&](const pipeline::Dataset& one) { return std::ranges::find(datasets, one.path) == datasets.end(); });
  for (pipeline::Dataset& one : part.datasets) one.may_be_absent = true;
  return part;
}

}  // namespace dresslife::fatigue_tests
