// Files for people that a command may replace: pictures by pictures, pages by pages.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// The first bytes of a file; zeros where it is shorter or cannot be read.
std::string beginning_of(const std::filesystem::path& file, std::size_t bytes);

/// Errors: InputError when something else than a picture stands there.
void check_picture(const std::filesystem::path& file);

/// As the file's ending says: .png, else SVG.
void write_picture(const std::filesystem::path& file, const std::string& svg);

}  // namespace dresslife::pipeline
