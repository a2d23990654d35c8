// Where the running program lies, what came with it and what it was built from. No path of the machine that
// built it is compiled in, so programs and catalogue can be moved together:
//
//     bin/dresslife, bin/dresslife-sim, ...   the programs, beside each other
//     share/dresslife/config                  the catalogue
//     share/dresslife/commit                  the sources' commit, where it was known
//
// A build folder is laid out in the same way. The commit is a file and no part of a program, because a study
// computes again what another program would make: a commit that leaves the programs alone must not touch them.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// The running program itself, whatever link or search path led to it. Errors: InputError where there is no
/// /proc and the name it was started by leads nowhere.
std::filesystem::path program_file();
std::filesystem::path program_folder();

/// The file that a program was started from as `name`: a path, or a name on the search path. Errors:
/// InputError.
std::filesystem::path program_called(const std::string& name);

/// The folder that the environment variable DRESSLIFE_CONFIG names (who sets it means it), else the catalogue
/// that came with the program. Errors: InputError when it is no folder.
std::filesystem::path shipped_catalogue();

const char* version();  ///< "0.1.0"

/// For --version: the program's name and version, then lines with commit, build, instruction sets, libraries
/// and catalogue.
std::string version_text(const std::string& program);

}  // namespace dresslife::pipeline
