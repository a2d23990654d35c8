// Finds the folder of the running program, its catalogue and its version. No path of the build machine is compiled in, so
// programs and catalogue can be moved together:
//
//     bin/dresslife, bin/dresslife-sim, ...   the programs, beside each other
//     share/dresslife/config                  the catalogue
//     share/dresslife/commit                  the commit of the sources, if it was known
//
// A build folder has the same layout. The commit is a file and not a part of a program: a study computes a job again when a
// program has changed, and a commit that does not change the programs must not cause that.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Returns the file of the running program, with links resolved. Errors: InputError if /proc is missing and the name by which the
/// program was started leads to no file.
std::filesystem::path program_file();
std::filesystem::path program_folder();

/// Returns the file of a program that was started as `name`: a path, or a name on the search path. Errors: InputError.
std::filesystem::path program_called(const std::string& name);

/// Returns the folder in the environment variable DRESSLIFE_CONFIG if it is set, else the catalogue installed with the program.
/// Errors: InputError if it is no folder.
std::filesystem::path shipped_catalogue();

const char* version();  ///< "0.1.0"

/// Returns the text of --version: name and version of the program, then lines for commit, build, instruction sets, libraries and
/// catalogue.
std::string version_text(const std::string& program);

}  // namespace dresslife::pipeline
