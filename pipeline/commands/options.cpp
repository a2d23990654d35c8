#include "pipeline/commands/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <set>
#include <string_view>
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

/// The shipped file of this entry; empty: there is none.
fs::path shipped_file(const fs::path& entry) {
  const fs::path shipped = shipped_catalogue() / (entry.string() + ".yaml");
  return kind_of(shipped) == FileKind::file ? fs::proximate(shipped) : fs::path();
}

/// shelves: the first that has the entry counts. "studies/NAME" is the entry of one shelf.
fs::path file_or_entry(const std::string& name, const std::vector<std::string>& shelves) {
  const std::string shelf_of_name = fs::path(name).parent_path().string();
  const bool on_shelf = std::find(shelves.begin(), shelves.end(), shelf_of_name) != shelves.end();
  const bool is_name = (shelf_of_name.empty() || on_shelf) && fs::path(name).extension() != ".yaml";
  if (!is_name || kind_of(name) == FileKind::file) return name;
  std::string looked_for;
  for (const std::string& shelf : on_shelf ? std::vector<std::string>{""} : shelves) {
    const fs::path entry = fs::path(shelf) / name, shipped = shipped_file(entry);
    if (!shipped.empty()) {
      if (shelf == "jobs" && !shipped_file(fs::path("studies") / name).empty())
        tell(fmt::format("{}: note: is a job and a study; the job is taken. The study is studies/{}\n", name, name));
      return shipped;
    }
    looked_for += (looked_for.empty() ? "" : " or ") + entry.string() + ".yaml";
  }
  throw InputError({name},
                   fmt::format("is no file, and {} holds no {}", shipped_catalogue().string(), looked_for),
                   "write the path of a YAML file");
}

/// What a file of another kind is, and what to do with it.
struct OtherKind {
  std::string_view kind, use;
};
constexpr OtherKind program_kind{"robot program", "name it in a job: dresslife new --program FILE JOB.yaml"},
    result_kind{"result", "see it by dresslife show FILE or plot FILE"},
    study_kind{"study", "give it to dresslife run, status, report or improve"},
    job_kind{"job", "give it to dresslife check, preview, run, route or improve"},
    dresspack_kind{"dresspack", "see it by dresslife draw FILE, or name it in a job as dresspack: FILE"},
    robot_kind{"robot", "name it in a job as robot: FILE"}, motion_kind{"motion", "name it in a job as motion: FILE"},
    observations_kind{"table of observations", "give it to dresslife validate or calibrate"}, unknown_kind{"", ""};

/// By the end of the name, or by the keys that begin a line of a YAML file. unknown_kind: none of these.
OtherKind kind_of_content(const fs::path& file) {
  std::string end = file.extension();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char letter) { return std::tolower(letter); });
  static const std::set<std::string> programs{".mod", ".modx", ".prg", ".sys", ".pgf", ".src", ".dat", ".ls", ".jbi", ".script"};
  if (programs.contains(end)) return program_kind;
  if (end == ".h5" || end == ".hdf5") return result_kind;
  if ((end != ".yaml" && end != ".yml") || kind_of(file) != FileKind::file) return unknown_kind;
  std::set<std::string> keys;
  constexpr int most_lines = 10'000;  // a hand-written file is shorter, and others are not for these commands
  std::ifstream lines(file);
  std::string line;
  for (int k = 0; k < most_lines && std::getline(lines, line); ++k)
    if (const std::size_t colon = line.find(':'); colon != line.npos && colon > 0 && line[0] != ' ' && line[0] != '#')
      keys.insert(line.substr(0, colon));
  const auto has = [&](const char* key) { return keys.contains(key); };
  if (has("observations")) return observations_kind;
  if (has("base")) return study_kind;
  if (has("motion") || has("dresspack") || has("dresspacks")) return job_kind;
  if (has("joints") && has("links")) return robot_kind;
  if (has("components") || has("data_sheet")) return dresspack_kind;
  if (has("steps")) return motion_kind;
  return unknown_kind;
}

/// What a user names is read, here or by a stage, and not replaced. wanted: kinds that the command takes.
fs::path input(fs::path file, std::initializer_list<OtherKind> wanted) {
  const OtherKind found = kind_of_content(file);
  const auto same = [&](const OtherKind& one) { return one.kind == found.kind; };
  if (wanted.size() > 0 && !found.kind.empty() && std::none_of(wanted.begin(), wanted.end(), same))
    throw InputError({file.string()}, fmt::format("is a {}, not a {}", found.kind, wanted.begin()->kind), std::string(found.use));
  note_input(file);
  return file;
}

}  // namespace

fs::path named_file(const std::string& name, const std::string& shelf) {
  const fs::path file = file_or_entry(name, {shelf});
  if (shelf == "jobs") return input(file, {job_kind});
  if (shelf == "dresspacks") return input(file, {dresspack_kind});
  if (shelf == "observations") return input(file, {observations_kind});
  return input(file, {});
}

fs::path named_study(const std::string& name) {
  return input(file_or_entry(name, {"jobs", "studies"}), {study_kind, job_kind});
}

StudyRequest request_of(const StudyOptions& options) {
  return {named_study(options.study), options.sets, options.out, program_folder()};
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

}  // namespace dresslife::pipeline
