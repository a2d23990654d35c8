// Backups and program folders: the files of a program, and its start.
//
// The files of a folder are all those in it and in the folders within whose names end like a robot program's
// (pipeline::program_files), sorted. One function for each language picks the program among them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/program/import.h"

namespace dresslife::sim {

struct Backup {
  Language language = Language::rapid;
  std::vector<std::filesystem::path> files;  ///< the first one gives the program its name
  std::string routine;                       ///< where it begins; empty: the language's own start
  std::vector<std::string> missing = {};  ///< files that the folder's own list names and that are not there
  std::map<std::string, std::string> written_beside = {};  ///< names that another task writes -> where
};

/// Whether a program is given as a folder or as a list of files.
bool is_backup(const std::filesystem::path& program);

/// routine: the requested one; empty: none. Errors: InputError that names the choices if there are several programs.
Backup backup_of(const std::filesystem::path& program, const std::string& routine);

/// Calls of a program, found without running it.
struct Calls {
  std::string name;             ///< in lower case; empty: the file holds no program
  std::set<std::string> names;  ///< that it calls, in lower case
  bool moves = false;
};
using CallGraph = std::map<std::string, Calls>;  // by the programs' names

/// Whether a program, or one that it calls, moves the robot.
bool moves(const std::string& program, const CallGraph& graph);
/// Programs that move the robot and that no other one calls; the main one alone where one has that name.
std::vector<std::string> uncalled_programs(const CallGraph& graph);
/// The one start. Errors: InputError where there is none ("holds no WHAT that moves"), or where there are several.
std::string only_start(const std::filesystem::path& folder, std::vector<std::string> choices, const char* what);

/// The programs of one language among `files` of `folder`.
Backup rapid_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::string& routine);
Backup krl_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                  const std::string& routine);
Backup fanuc_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::string& routine);
Backup inform_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                     const std::string& routine);

}  // namespace dresslife::sim
