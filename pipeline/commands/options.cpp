#include "pipeline/commands/options.h"

#include <fmt/format.h>

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

Option study_or_job(StudyOptions& options) {
  return {"study", "", "STUDY.yaml, or JOB.yaml for a study of one", &options.study, {.required = true}};
}

Option sets_option(const std::string& what, std::vector<std::string>& sets) {
  return {"--set", "KEY.PATH=VALUE", what + "; may be repeated", &sets};
}

Option json_option(bool& json) { return {"--json", "", "print JSON for other programs", &json}; }

std::vector<Option> study_options(StudyOptions& options) {
  return {{"-o,--output", "DIR", "folder of the results", &options.out},
          sets_option("override a key in every job", options.sets)};
}

std::vector<Option> run_options(RunOptions& options) {
  return {{"-j,--jobs", "COUNT", "stages at a time", &options.jobs,
           {.range = {{1, 1024}}, .shown_default = "one per core"}},
          {"--quiet", "", "no progress, no notes", &options.quiet}};
}

Option launcher_option(RunOptions& options) {
  return {"--launcher", "WORDS",
          "shell words before each stage's command, which start it elsewhere and end as it ends: 'srun -n1 -c1 "
          "--exact'",
          [&options](const std::string& text) {
            if (text.find('\n') != std::string::npos)
              throw InputError({"--launcher"}, "has more than one line", "write it as one line");
            options.launcher = text;
          }};
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
