// Content of a result file of a stage as text: `dresslife show FILE.h5`.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Returns format, history and input, then each attribute with its value and each dataset with its shape, unit and
/// range, all with their meanings. Reads the whole file. Errors: InputError for other or damaged files.
std::string file_summary(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
