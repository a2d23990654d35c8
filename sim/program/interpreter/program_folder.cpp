#include "sim/program/interpreter/program_folder.h"

#include "pipeline/base/joined.h"

#include <fmt/format.h>

#include <algorithm>

namespace dresslife::sim {

namespace fs = std::filesystem;

namespace {

/// Returns the programs that a program calls, directly or through other programs.
std::set<std::string> reached_from(const std::string& program, const CallGraph& graph) {
  std::set<std::string> reached;
  std::vector<std::string> open{program};
  while (!open.empty()) {
    const auto at = graph.find(open.back());
    open.pop_back();
    if (at == graph.end()) continue;
    for (const std::string& name : at->second.names)
      if (graph.contains(name) && reached.insert(name).second) open.push_back(name);
  }
  return reached;
}

}  // namespace

bool moves(const std::string& program, const CallGraph& graph) {
  std::set<std::string> reached = reached_from(program, graph);
  reached.insert(program);
  return std::ranges::any_of(reached, [&](const std::string& name) { return graph.at(name).moves; });
}

std::vector<std::string> uncalled_programs(const CallGraph& graph) {
  std::set<std::string> called;
  for (const auto& [name, calls] : graph)
    for (const std::string& other : calls.names)
      if (other != name) called.insert(other);
  std::vector<std::string> found, mains;
  for (const auto& [name, calls] : graph) {
    if (called.contains(name) || !moves(name, graph)) continue;
    if (name == "main") return {name};
    found.push_back(name);
    if (name.starts_with("main")) mains.push_back(name);
  }
  return mains.size() == 1 ? mains : found;
}

std::string only_start(const fs::path& folder, std::vector<std::string> choices, const char* what) {
  constexpr std::size_t listed_programs = 20;
  if (choices.empty())
    throw pipeline::InputError({folder.string()}, fmt::format("holds no {} that moves the robot", what),
                               "name the routine to run in motion.routine");
  if (choices.size() == 1) return choices[0];
  const std::size_t more = choices.size() - std::min(choices.size(), listed_programs);
  choices.resize(choices.size() - more);
  throw pipeline::InputError({folder.string()}, "holds several programs, and none that calls them",
                             fmt::format("name one in motion.routine: {}{}", pipeline::joined(choices, ", "),
                                         more ? fmt::format(" and {} more", more) : ""));
}

void put_first(fs::path file, Backup& backup) {
  if (std::erase(backup.files, file)) backup.files.insert(backup.files.begin(), std::move(file));
}

}  // namespace dresslife::sim
