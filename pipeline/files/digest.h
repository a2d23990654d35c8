// SHA-256, the fingerprint by which files name their inputs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

std::string sha256(std::string_view bytes);                     ///< 64 hexadecimal digits
std::string sha256_of_file(const std::filesystem::path& file);  ///< Errors: InputError when it cannot be read

}  // namespace dresslife::pipeline
