// The files of a robot program on disk.
#pragma once

#include <filesystem>
#include <vector>

namespace dresslife::pipeline {

/// Returns the files that a robot program may use besides those that the motion names, sorted. For a folder, or the folder of a
/// list of modules: files with the ending of a robot program, in it and its subfolders. For a KRL program: the files of the
/// robot's folder R1 in a backup, else the files in its folder.
std::vector<std::filesystem::path> program_files(const std::filesystem::path& program);

/// Returns whether the file is a KRL module: .src, .dat or .sub in upper or lower case.
bool is_krl(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
