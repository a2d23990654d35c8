// Which of the files beside a robot program the program can reach.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Of `beside`, those that the programs may use: whose name, or a name that they declare for others, stands in one of
/// the programs or in a file that those use, or is the routine to run. A copy of a KRL program is not used: the first program's own
/// routines count. More than are used may be among them, none that is used is missing: a
/// file that cannot be looked into counts as used, as do the registers and the system files of a controller. A program
/// that is a folder uses all of it. Errors: DiskError.
std::vector<std::filesystem::path> related_files(const std::vector<std::filesystem::path>& programs,
                                                 std::vector<std::filesystem::path> beside,
                                                 const std::string& routine = "");

}  // namespace dresslife::pipeline
