// The programs in a folder: their files, their calls and the program that starts.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

struct Backup {
  Language language = Language::rapid;
  std::vector<std::filesystem::path> files;                ///< the program has the name of the first file
  std::string routine;                                     ///< first routine; empty: the default of the language
  std::vector<std::string> missing = {};                   ///< files in the folder's list of contents that do not exist
  std::map<std::string, std::string> written_beside = {};  ///< names that another task writes -> file of that task
};

/// Calls of a program, found without running it.
struct Calls {
  std::string name;             ///< in lower case; empty: the file contains no program
  std::set<std::string> names;  ///< names of called programs, in lower case
  bool moves = false;
};
using CallGraph = std::map<std::string, Calls>;  // by the programs' names

/// Whether a program, or a program that it calls, moves the robot.
bool moves(const std::string& program, const CallGraph& graph);
/// Returns the programs that move the robot and that no other calls; only `main`, or the one that begins with it.
std::vector<std::string> uncalled_programs(const CallGraph& graph);
/// Returns the only choice. Errors: InputError if `choices` is empty ("holds no WHAT that moves") or has several entries.
std::string only_start(const std::filesystem::path& folder, std::vector<std::string> choices, const char* what);
/// Makes a file of the backup its first one, which gives the motion its name. Other paths have no effect.
void put_first(std::filesystem::path file, Backup& backup);

}  // namespace dresslife::sim
