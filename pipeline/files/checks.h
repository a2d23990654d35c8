// The checks of a motion (/check/*). The receipt of a motion contains them, so that they are available without motion.h5.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/files/receipt.h"

namespace dresslife::pipeline {

struct CheckedValue {
  std::string name;             ///< check_names.h
  double value = 0, limit = 0;  ///< in the unit of the check; infinite: no bend, or no limit
  bool operator==(const CheckedValue&) const = default;
};

/// Returns the checks of a motion for its receipt; empty for a motion without checks. Errors: InputError if the file cannot be
/// read.
std::vector<ResultValue> results_of_checks(const std::filesystem::path& motion_file);

/// Returns the checks in a list from results_of_checks().
std::vector<CheckedValue> checks_in(const std::vector<ResultValue>& results);

}  // namespace dresslife::pipeline
