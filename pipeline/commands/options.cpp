#include "pipeline/commands/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <thread>

#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {

namespace fs = std::filesystem;

RunOptions::RunOptions() : jobs(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

void add_sets(CLI::App& command, const std::string& what, std::vector<std::string>& sets) {
  command.add_option("--set", sets, what + "; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

void add_study_options(CLI::App& command, StudyOptions& options) {
  command.add_option("-o,--output", options.out, "folder of the results")
      ->type_name("DIR")
      ->capture_default_str();
  add_sets(command, "override a key in every job", options.sets);
}

void add_run_options(CLI::App& command, RunOptions& options) {
  command.add_option("-j,--jobs", options.jobs, "stages at a time")
      ->check(CLI::Range(1, 1024))
      ->default_str("one per core");
  command.add_flag("--quiet", options.quiet, "no progress, no notes");
}

void add_launcher(CLI::App& command, RunOptions& options) {
  command
      .add_option(
          "--launcher", options.launcher,
          "shell words before each stage's command, which start it elsewhere and end as it ends: 'srun -n1 -c1 --exact'")
      ->type_name("WORDS")
      ->check([](const std::string& text) {
        return text.find('\n') == std::string::npos ? std::string() : std::string("must be one line");
      });
}

namespace {

/// shelves: the first that has one counts.
fs::path file_or_entry(const std::string& name, const std::vector<std::string>& shelves) {
  const bool is_name = fs::path(name).parent_path().empty() && fs::path(name).extension() != ".yaml";
  if (!is_name || kind_of(name) == FileKind::file) return name;
  std::string looked_for;
  for (const std::string& shelf : shelves) {
    const fs::path entry = fs::path(shelf) / (name + ".yaml"), shipped = shipped_catalogue() / entry;
    if (kind_of(shipped) == FileKind::file) return fs::proximate(shipped);
    looked_for += (looked_for.empty() ? "" : " or ") + entry.string();
  }
  throw InputError({name},
                   fmt::format("is no file, and {} holds no {}", shipped_catalogue().string(), looked_for),
                   "write the path of a YAML file");
}

/// What a user names is read, here or by a stage, and not replaced.
fs::path input(fs::path file) {
  note_input(file);
  return file;
}

}  // namespace

fs::path named_file(const std::string& name, const std::string& shelf) {
  return input(file_or_entry(name, {shelf}));
}

fs::path named_study(const std::string& name) { return input(file_or_entry(name, {"studies", "jobs"})); }

StudyRequest request_of(const StudyOptions& options) {
  return {named_study(options.study), options.sets, options.out, program_folder()};
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

}  // namespace dresslife::pipeline
