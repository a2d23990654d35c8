// Picture files.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Writes PNG if the file name ends in .png, else SVG. Errors: InputError when the file cannot be written, or when it exists and
/// was not written by dresslife.
void write_picture(const std::filesystem::path& file, const std::string& svg);

}  // namespace dresslife::pipeline
