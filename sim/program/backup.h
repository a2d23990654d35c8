// Backups and program folders: the files of a program, and its start.
//
// The files of a folder are all files in it and in its subfolders with the extension of a robot program
// (pipeline::program_files), sorted. One function for each language selects the program among them.
#pragma once

#include <filesystem>
#include <string>

#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// Whether a program is given as a folder or as a list of files.
bool is_backup(const std::filesystem::path& program);

/// Returns the program of a folder. routine: the requested routine; empty: none. Errors: InputError that names the
/// choices if the folder has several programs.
Backup backup_of(const std::filesystem::path& program, const std::string& routine);

}  // namespace dresslife::sim
