// The checks of a motion (datasets /check of motion.h5) as a table.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Returns an HTML table; empty for a file without checks. Errors: InputError.
std::string check_table(const std::filesystem::path& motion_file);

}  // namespace dresslife::pipeline
