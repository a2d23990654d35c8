// The files of a robot program on disk.
#pragma once

#include <filesystem>
#include <vector>

namespace dresslife::pipeline {

/// Files that a robot program may be read from besides those that the motion names: of a folder (or of the
/// folder of a list of modules), those that end like robot programs, within it and the folders in it; of a
/// KRL program, those of the robot's folder R1 in a backup, else those beside it. Sorted.
std::vector<std::filesystem::path> program_files(const std::filesystem::path& program);

/// Whether the file is a module of KUKA's language: .src, .dat or .sub in any case.
bool is_krl(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
