#include "sim/program/backup.h"

#include <map>

#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"
#include "sim/program/fanuc/backup.h"
#include "sim/program/import.h"
#include "sim/program/inform/inform.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/krl.h"
#include "sim/program/rapid/rapid.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

namespace {

/// Whether a file can contain moves, not only settings.
bool holds_moves(const fs::path& file) {
  static const pipeline::WordSet ends = pipeline::word_set(".mod .modx .prg .sys .sysx .src .ls .jbi");
  return ends.contains(lower_case(file.extension().string()));
}

/// Returns the language of a file of a backup; VAR.DAT contains the variables of a Motoman.
Language language_within(const fs::path& file) {
  return lower_case(file.filename().string()) == "var.dat" ? Language::inform : language_of(file);
}

/// Whether a file is ABB's list of a backup's contents.
bool is_contents(const fs::path& file) { return lower_case(file.filename().string()) == "backinfo.txt"; }

}  // namespace

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
  std::erase_if(files, [](const auto& of_language) {  // files with settings alone are not a program
    return std::ranges::none_of(of_language.second, holds_moves);
  });
  // System modules alone are not an ABB program beside another controller's files, which may have the same extension.
  if (const auto rapid = files.find(Language::rapid); files.size() > 1 && rapid != files.end())
    if (std::ranges::all_of(rapid->second,
                            [](const fs::path& file) { return lower_case(file.extension().string()) == ".sys"; }))
      files.erase(rapid);
  if (files.size() != 1)
    throw pipeline::InputError({folder.string()},
                               files.empty() ? "holds no robot program" : "holds programs of several languages",
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
