// Folders with KUKA programs: a whole backup (KRC/R1 with Program, System, TP and Mada) or programs in one folder.
// STEU (data of the controller) and templates are not read. Submit programs (.sub) do not move a robot, but they write
// variables that the programs read.
//
// If the user requests no routine, the start is a program that moves the robot: the program that CELL.SRC calls, else
// the program that no other one calls.
#include <algorithm>
#include <map>
#include <set>

#include "pipeline/base/joined.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"
#include "pipeline/settings/document.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/krl.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

namespace {

std::string stem_of(const fs::path& file) { return lower_case(file.stem().string()); }
bool is_program(const fs::path& file) { return lower_case(file.extension().string()) == ".src"; }

/// Whether the path from `folder` to a file contains a folder of one of these names.
bool lies_in(const fs::path& file, const fs::path& folder, const std::set<std::string>& names) {
  const fs::path below = file.lexically_relative(folder).parent_path();
  return std::ranges::any_of(below, [&](const fs::path& part) { return names.contains(lower_case(part.string())); });
}

/// Returns the folder R1 that contains a file; empty: none.
fs::path robot_of(const fs::path& file) {
  for (fs::path at = file.parent_path(); !at.empty() && at != at.parent_path(); at = at.parent_path())
    if (lower_case(at.filename().string()) == "r1") return at;
  return {};
}

Calls calls_of(const fs::path& file) {
  static const pipeline::WordSet moves = pipeline::word_set("ptp lin circ sptp slin scirc spline ptp_rel lin_rel");
  Calls calls;
  const SourceFile source(file.string(), decoded_text(pipeline::read_text(file)));
  Problems ignored;  // the parser reports them
  const std::vector<Token> tokens = tokens_of(source, {';', "$#", true, true}, ignored);
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].kind != Token::Kind::word) continue;
    const std::string word = lower_case(tokens[i].text);
    calls.moves |= moves.contains(word);
    if (calls.name.empty() && word == "def") calls.name = lower_case(tokens[i + 1].text);
    if (tokens[i + 1].text == "(") calls.names.insert(word);
  }
  return calls;
}

/// Returns the possible start programs: the programs that CELL calls, else those that no program calls.
std::vector<std::string> starts(CallGraph graph) {
  std::vector<std::string> found;
  if (const auto cell = graph.find("cell"); cell != graph.end()) {
    for (const std::string& name : cell->second.names)
      if (name != "cell" && graph.contains(name) && moves(name, graph)) found.push_back(name);
    graph.erase(cell);
  }
  return found.empty() ? uncalled_programs(graph) : found;
}

void check_one_robot(const fs::path& folder, const std::vector<fs::path>& files) {
  std::set<std::string> robots;
  for (const fs::path& file : files)
    if (const fs::path robot = robot_of(file); is_program(file) && !robot.empty()) robots.insert(robot.string());
  if (robots.size() < 2) return;
  throw pipeline::InputError({folder.string()}, fmt::format("holds the programs of {} robots", robots.size()),
                             fmt::format("name one of: {}", pipeline::joined(robots, ", ")));
}

}  // namespace

Backup krl_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  static const std::set<std::string> foreign{"steu", "template", "templates"};
  // Folders of the programs that KUKA installs; the controller calls them itself.
  static const std::set<std::string> system_folders{"system", "tp", "mada"};
  static const std::set<std::string> system_programs{"masref_user", "tm_useraction", "colldetect_useraction"};
  Backup backup;
  backup.language = Language::krl;
  backup.routine = routine;
  CallGraph graph;
  std::map<std::string, fs::path> file_of;
  for (const fs::path& file : files) {
    if (!pipeline::is_krl(file) || lies_in(file, folder, foreign)) continue;
    backup.files.push_back(file);
    if (is_program(file) && !lies_in(file, folder, system_folders) && !system_programs.contains(stem_of(file)))
      if (Calls calls = calls_of(file); !calls.name.empty()) {
        file_of.emplace(calls.name, file);
        graph[calls.name] = std::move(calls);
      }
  }
  check_one_robot(folder, backup.files);
  if (routine.empty()) backup.routine = only_start(folder, starts(graph), "KUKA program");
  put_first(file_of[lower_case(backup.routine.substr(0, backup.routine.find_first_of("( ")))], backup);
  return backup;
}

}  // namespace dresslife::sim
