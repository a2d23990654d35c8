// The checks of a motion (/check/*) beside it: its receipt contains them, so that they are known where motion.h5
// is not kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/files/receipt.h"

namespace dresslife::pipeline {

struct CheckedValue {
  std::string name;             ///< check_names.h
  double value = 0, limit = 0;  ///< in the unit of the check; infinite: no bend at all, no limit
  bool operator==(const CheckedValue&) const = default;
};

/// For the receipt of a motion; nothing of a motion without checks. Errors: InputError when it cannot be
/// read.
std::vector<ResultValue> results_of_checks(const std::filesystem::path& motion_file);

/// The checks in the results of results_of_checks().
std::vector<CheckedValue> checks_in(const std::vector<ResultValue>& results);

}  // namespace dresslife::pipeline
