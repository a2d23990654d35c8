// What lies in a file between the stages, in words: `dresslife show FILE.h5`.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Format, history and input, then each attribute with its value and each dataset with its shape, unit and
/// range, all with their meanings. Reads the whole file. Errors: InputError when it is none of ours or is
/// damaged.
std::string file_summary(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
