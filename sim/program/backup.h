// Backups and program folders: the files of a program, and its start.
//
// The files of a folder are all those in it and in the folders within whose names end like a robot program's
// (pipeline::program_files), sorted. One function for each language picks the program among them.
#pragma once

#include <filesystem>
#include <string>

#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// Whether a program is given as a folder or as a list of files.
bool is_backup(const std::filesystem::path& program);

/// routine: the requested one; empty: none. Errors: InputError that names the choices if there are several programs.
Backup backup_of(const std::filesystem::path& program, const std::string& routine);

}  // namespace dresslife::sim
