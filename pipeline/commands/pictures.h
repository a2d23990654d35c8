// Pictures for people, as files.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// As the file's ending says: .png, else SVG. Errors: InputError when it cannot be written, or would replace a file
/// that is not ours.
void write_picture(const std::filesystem::path& file, const std::string& svg);

}  // namespace dresslife::pipeline
