// The programs in a folder: their files, their calls and the one that starts.
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
  std::vector<std::filesystem::path> files;  ///< the first one gives the program its name
  std::string routine;                       ///< where it begins; empty: the language's own start
  std::vector<std::string> missing = {};  ///< files that the folder's own list names and that are not there
  std::map<std::string, std::string> written_beside = {};  ///< names that another task writes -> where
};

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

}  // namespace dresslife::sim
