#include "sim/program/backup.h"

#include <map>

#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"
#include "sim/program/encoding.h"
#include "sim/program/inform.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

namespace {

/// A file that can hold moves, not settings alone.
bool holds_moves(const fs::path& file) {
  const std::string end = lower_case(file.extension().string());
  const auto among = [&](std::initializer_list<const char*> ends) {
    return std::any_of(ends.begin(), ends.end(), [&](const char* other) { return end == other; });
  };
  return among({".mod", ".modx", ".prg", ".sys", ".sysx", ".src", ".ls", ".jbi"});
}

/// The language of a file of a backup; VAR.DAT holds the variables of a Motoman.
Language language_within(const fs::path& file) {
  return lower_case(file.filename().string()) == "var.dat" ? Language::inform : language_of(file);
}

/// Programs that a program calls, itself or through others.
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

/// ABB's list of what a backup holds.
bool is_contents(const fs::path& file) { return lower_case(file.filename().string()) == "backinfo.txt"; }

}  // namespace

bool moves(const std::string& program, const CallGraph& graph) {
  std::set<std::string> reached = reached_from(program, graph);
  reached.insert(program);
  return std::any_of(reached.begin(), reached.end(),
                     [&](const std::string& name) { return graph.at(name).moves; });
}

std::vector<std::string> uncalled_programs(const CallGraph& graph) {
  std::set<std::string> called;
  for (const auto& [name, calls] : graph)
    for (const std::string& other : calls.names)
      if (other != name) called.insert(other);
  std::vector<std::string> found, mains;
  for (const auto& [name, calls] : graph) {
    if (called.contains(name) || !moves(name, graph)) continue;
    found.push_back(name);
    if (name.starts_with("main")) mains.push_back(name);
  }
  return mains.size() == 1 ? mains : found;
}

std::string only_start(const fs::path& folder, std::vector<std::string> choices, const char* what) {
  constexpr std::size_t listed_programs = 20;
  if (choices.empty())
    throw pipeline::InputError({folder.string()}, fmt::format("holds no {} that moves the robot", what),
                               "name the routine to run with --routine (motion.routine in a job)");
  if (choices.size() == 1) return choices[0];
  const std::size_t more = choices.size() - std::min(choices.size(), listed_programs);
  choices.resize(choices.size() - more);
  throw pipeline::InputError({folder.string()}, "holds several programs, and none that calls them",
                             fmt::format("name one with --routine (motion.routine in a job): {}{}",
                                         fmt::join(choices, ", "), more ? fmt::format(" and {} more", more) : ""));
}

Backup inform_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::inform, {}, routine};
  CallGraph graph;
  std::map<std::string, fs::path> file_of;
  for (const fs::path& file : files)
    if (lower_case(file.extension().string()) == ".jbi") {
      Calls calls = inform_calls(SourceFile(file.string(), decoded_text(pipeline::read_text(file))));
      file_of[calls.name] = file;
      graph[calls.name] = std::move(calls);
    }
  if (routine.empty()) backup.routine = only_start(folder, uncalled_programs(graph), "job");
  const auto first = file_of.find(lower_case(backup.routine));
  if (first != file_of.end()) backup.files.push_back(first->second);  // it names the motion
  for (const fs::path& file : files)
    if (first == file_of.end() || file != first->second) backup.files.push_back(file);
  return backup;
}

bool is_backup(const fs::path& program) {
  return pipeline::kind_of(program) == pipeline::FileKind::folder || lower_case(program.extension().string()) == ".pgf";
}

Backup backup_of(const fs::path& program, const std::string& routine) {
  const bool listed = pipeline::kind_of(program) != pipeline::FileKind::folder;
  const fs::path folder = listed ? (program.has_parent_path() ? program.parent_path() : ".") : program;
  std::map<Language, std::vector<fs::path>> files;
  for (const fs::path& file : pipeline::program_files(folder))
    files[is_contents(file) ? Language::rapid : language_within(file)].push_back(file);
  if (listed) {
    std::vector<fs::path> own{program};
    for (const fs::path& file : files[Language::rapid])
      if (lower_case(file.extension().string()) != ".pgf" && !is_contents(file)) own.push_back(file);
    return rapid_backup(folder, own, routine);
  }
  std::erase_if(files, [](const auto& of_language) {  // settings alone make no program
    return std::none_of(of_language.second.begin(), of_language.second.end(), holds_moves);
  });
  // System modules alone are no ABB program beside those of another controller, whose files may end likewise.
  if (const auto rapid = files.find(Language::rapid); files.size() > 1 && rapid != files.end())
    if (std::all_of(rapid->second.begin(), rapid->second.end(),
                    [](const fs::path& file) { return lower_case(file.extension().string()) == ".sys"; }))
      files.erase(rapid);
  if (files.size() != 1)
    throw pipeline::InputError(
        {folder.string()}, files.empty() ? "holds no robot program" : "holds programs of several languages",
        files.empty() ? "give RAPID, KRL, Fanuc or INFORM files" : "name the folder of one");
  const auto& [language, list] = *files.begin();
  switch (language) {
    case Language::rapid:
      return rapid_backup(folder, list, routine);
    case Language::krl:
      return krl_backup(folder, list, routine);
    case Language::inform:
      return inform_backup(folder, list, routine);
    default:
      return fanuc_backup(folder, list, routine);
  }
}

}  // namespace dresslife::sim
