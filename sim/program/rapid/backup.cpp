// Folders of ABB: a backup BACKUP/RAPID/TASK1/{PROGMOD,SYSMOD}/*.mod with one folder for each task, whose modules are
// all loaded; or a program's folder with its list of modules (.pgf) and system modules.
#include <set>
#include <sstream>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/settings/document.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/rapid/rapid.h"

namespace dresslife::sim {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) { return lower_case(file.extension().string()); }
std::string name_of(const fs::path& file) { return lower_case(file.filename().string()); }
bool is_module(const fs::path& file) { return extension_of(file) != ".pgf" && name_of(file) != "backinfo.txt"; }

/// Returns the folder of a file's task, "…/RAPID/TASK1"; empty: the file is not in such a folder.
fs::path task_of(const fs::path& file) {
  fs::path folder;
  std::string before;
  for (const fs::path& part : file.parent_path()) {
    folder /= part;
    const std::string name = lower_case(part.string());
    if (before == "rapid" && (name.starts_with("task") || name.starts_with("t_"))) return folder;
    before = name;
  }
  return {};
}

/// Whether a module moves a robot: its text contains a word of a move outside of comments.
bool moves(const fs::path& file) {
  const std::string text = lower_case(pipeline::read_text(file));
  static constexpr std::string_view words[] = {"moveabsj", "movej", "movel", "movec", "triggl",
                                               "triggj",   "spotl", "spotj", "arcl",  "arcc"};
  for (std::string_view word : words)
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const std::size_t line = text.rfind('\n', at) + 1;
      if (text.substr(line, at - line).find('!') == std::string::npos) return true;
    }
  return false;
}

/// Returns the modules in a list of modules (XML: <Module>name.mod</Module>), from the list's folder. Errors: InputError
/// for a missing module or an empty list.
std::vector<fs::path> listed(const fs::path& list, const std::vector<fs::path>& files) {
  const std::string text = pipeline::read_text(list);
  const std::string lower = lower_case(text);
  std::vector<fs::path> modules;
  for (std::size_t at = lower.find("<module>"); at != std::string::npos; at = lower.find("<module>", at + 1)) {
    const std::size_t begin = at + 8, end = lower.find('<', begin);
    if (end == std::string::npos) break;
    std::string name = lower.substr(begin, end - begin);
    name = name.substr(name.find_last_of("/\\") + 1);
    const auto found = std::ranges::find_if(
        files, [&](const fs::path& file) { return name_of(file) == name && file.parent_path() == list.parent_path(); });
    if (found == files.end())
      throw pipeline::InputError({list.string()}, fmt::format("lists {}, which is not beside it", name),
                                 "add the module, or give those that there are in motion.modules");
    modules.push_back(*found);
  }
  if (modules.empty() && lower.find("endmodule") != std::string::npos)
    return {list};  // a module with the extension of a list
  if (modules.empty())
    throw pipeline::InputError({list.string()}, "lists no module", "give the module that holds main");
  return modules;
}

/// Returns a task's modules in backinfo.txt: "PROGMOD/main.mod @ ..." after ">>TASK1: (T_ROB1,...)"; in lower case,
/// with '/' (virtual controllers write '\\').
std::vector<std::string> contents_of(const fs::path& backinfo, const std::string& task) {
  std::istringstream lines(lower_case(pipeline::read_text(backinfo)));
  std::vector<std::string> modules;
  bool within = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(">>")) within = line.starts_with(">>" + lower_case(task) + ":");
    const std::size_t end = line.find(" @");
    if (!within || end == std::string::npos) continue;
    modules.push_back(line.substr(0, end));
    std::ranges::replace(modules.back(), '\\', '/');
  }
  return modules;
}

/// Adds the modules of a task's folder that the backup's list of contents names; all if it names none of them.
void add_task(const fs::path& task, const std::vector<fs::path>& files, Backup& backup) {
  std::vector<std::string> named;
  std::vector<fs::path> own;
  for (const fs::path& file : files)
    if (name_of(file) == "backinfo.txt" && file.parent_path().parent_path() == task.parent_path().parent_path())
      named = contents_of(file, task.filename().string());
  for (const fs::path& file : files) {
    if (!is_module(file) || task_of(file) != task) continue;
    own.push_back(file);
    const std::string name = lower_case(file.lexically_relative(task).generic_string());
    if (std::erase(named, name) > 0) backup.files.push_back(file);
  }
  if (backup.files.empty()) backup.files = own;
  backup.missing = named;
}

/// Data that a module may share with other tasks: its PERS declarations (not LOCAL, not TASK), and its assigned
/// variables.
struct Shared {
  std::set<std::string> persistent, assigned;
};

Shared shared_of(const fs::path& module) {
  Shared shared;
  const SourceFile source(module.string(), decoded_text(pipeline::read_text(module)));
  Problems ignored;  // the parser reports them
  const std::vector<Token> tokens = tokens_of(source, {'!', "", false, false}, ignored);
  const auto word = [&](std::size_t i) { return i < tokens.size() ? lower_case(tokens[i].text) : std::string(); };
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (word(i) == "pers" && word(i - 1) != "local" && word(i - 1) != "task") shared.persistent.insert(word(i + 2));
    if (tokens[i].text != ":=") continue;
    std::size_t at = i - 1;  // goes back over {index} and .component to the variable
    while (at > 0 && tokens[at].text == "}") {
      while (at > 0 && tokens[at].text != "{") --at;
      if (at > 0) --at;
    }
    while (at > 1 && tokens[at - 1].text == ".") at -= 2;
    const std::string before = at > 1 ? word(at - 2) : "";
    const bool declared = before == "pers" || before == "var" || before == "const";
    if (at > 0 && tokens[at - 1].text != "\\" && !declared) shared.assigned.insert(word(at));
  }
  return shared;
}

/// Records the task's persistent data that another task writes: it may have any value when the task reads it.
void add_what_others_write(const fs::path& task, const std::vector<fs::path>& files, Backup& backup) {
  std::set<std::string> own;
  for (const fs::path& file : backup.files) own.merge(shared_of(file).persistent);
  for (const fs::path& file : files) {
    const fs::path other = task_of(file);
    if (!is_module(file) || other.empty() || other == task || other.parent_path() != task.parent_path()) continue;
    const Shared shared = shared_of(file);
    for (const std::string& name : shared.assigned)
      if (own.contains(name) && shared.persistent.contains(name))
        backup.written_beside.emplace(
            name, fmt::format("{} of the task {}", file.filename().string(), other.filename().string()));
  }
}

/// Removes tasks in HOME (backups on the controller's disk) if the folder has other tasks: the controller does not
/// run them.
void drop_copies(const fs::path& folder, std::set<fs::path>& tasks) {
  const auto is_copy = [&](const fs::path& task) {
    const fs::path within = task.lexically_relative(folder);
    return std::ranges::any_of(within, [](const fs::path& part) { return lower_case(part.string()) == "home"; });
  };
  if (!std::ranges::all_of(tasks, is_copy)) std::erase_if(tasks, is_copy);
}

std::string names_of(const std::set<fs::path>& paths) {
  return pipeline::joined(pipeline::mapped(paths, [](const fs::path& path) { return path.string(); }), ", ");
}

/// Selects one of several lists of modules: the only one in the folder itself, else the only one in the controller's
/// folder RAPID. If neither is unique, keeps all.
void keep_nearest(const fs::path& folder, std::set<fs::path>& lists) {
  const auto only = [&](const auto& is_meant) {
    if (std::ranges::count_if(lists, is_meant) == 1)
      std::erase_if(lists, [&](const fs::path& list) { return !is_meant(list); });
  };
  const fs::path here = folder.lexically_normal() / "";
  only([&](const fs::path& list) { return list.parent_path().lexically_normal() / "" == here; });
  only([](const fs::path& list) {
    return std::ranges::any_of(list, [](const fs::path& part) { return lower_case(part.string()) == "rapid"; });
  });
}

}  // namespace

Backup rapid_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::rapid, {}, routine};
  std::set<fs::path> tasks, moving, lists;
  for (const fs::path& file : files) {
    if (extension_of(file) == ".pgf") lists.insert(file);
    const fs::path task = task_of(file);
    if (!task.empty()) tasks.insert(task);
  }
  drop_copies(folder, tasks);
  for (const fs::path& file : files)  // tasks without moves run in parallel to the robot's task
    if (const fs::path task = task_of(file);
        tasks.contains(task) && is_module(file) && !moving.contains(task) && (tasks.size() == 1 || moves(file)))
      moving.insert(task);
  if (moving.size() > 1)
    throw pipeline::InputError({folder.string()}, "holds several tasks that move a robot",
                               "name the folder of one: " + names_of(moving));
  if (!moving.empty()) {  // all modules of the task are loaded
    add_task(*moving.begin(), files, backup);
    add_what_others_write(*moving.begin(), files, backup);
    return backup;
  }
  if (lists.size() > 1) keep_nearest(folder, lists);
  if (lists.size() > 1)
    throw pipeline::InputError({folder.string()}, "holds several lists of modules", "name one: " + names_of(lists));
  if (!lists.empty()) backup.files = listed(*lists.begin(), files);
  for (const fs::path& file : files)
    if (is_module(file) && (lists.empty() || extension_of(file).starts_with(".sys")) &&
        std::ranges::find(backup.files, file) == backup.files.end())
      backup.files.push_back(file);
  return backup;
}

}  // namespace dresslife::sim
