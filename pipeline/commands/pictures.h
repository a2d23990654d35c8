// Picture files.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Errors: InputError when the name ends neither in .svg nor in .png, or write_picture() must not replace the file.
void check_picture(const std::filesystem::path& file);

/// Writes PNG if the file name ends in .png, else SVG. Errors: InputError when the file cannot be written, or when it exists and
/// was not written by dresslife.
void write_picture(const std::filesystem::path& file, const std::string& svg);

}  // namespace dresslife::pipeline
