// Finds the files beside a robot program that the program may use.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Returns the files of `beside` that the programs may use. A file is used if its name, or a name that it declares for other
/// files, occurs in a program or in a used file, or is the routine to run. The registers and the system files of a controller,
/// and files that cannot be read, always count as used. If a program is a folder, all files count as used. A copy of a KRL
/// program is not used, because the routines of the first program have priority. The result may contain unused files, but no used
/// file is missing. Errors: DiskError.
std::vector<std::filesystem::path> related_files(const std::vector<std::filesystem::path>& programs,
                                                 std::vector<std::filesystem::path> beside,
                                                 const std::string& routine = "");

}  // namespace dresslife::pipeline
