#include "pipeline/commands/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <thread>

#include "pipeline/base/errors.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/stage/stage.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_source.h"

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

Option folder_option(const std::string& of, std::string& out) {
  return {"-o,--output",
          "DIR",
          "folder of " + of,
          [&out](const std::string& text) {
            if (text.ends_with(".yaml"))
              throw InputError({"--output"}, fmt::format("'{}' is the name of a job, not of a folder", text),
                               "name a folder; dresslife route --job names the job that it writes");
            out = text;
          },
          {.shown_default = out}};
}

std::vector<Option> study_options(StudyOptions& options) {
  return {folder_option("the results", options.out), sets_option("override a key in every job", options.sets)};
}

std::vector<Option> run_options(RunOptions& options) {
  return {number_option("-j,--jobs", "COUNT", "stages at a time", &options.jobs, 1, 1024,
                        {.shown_default = "one per core"}),
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

/// Returns the shipped file of an entry; empty: no such file exists.
fs::path shipped_file(const fs::path& entry) {
  const fs::path shipped = shipped_catalogue() / (entry.string() + ".yaml");
  return kind_of(shipped) == FileKind::file ? fs::proximate(shipped) : fs::path();
}

/// Returns the file of a name. shelves: the first shelf with the entry is used. "studies/NAME" is an entry of one shelf.
fs::path file_or_entry(const std::string& name, const std::vector<std::string>& shelves) {
  const std::string shelf_of_name = fs::path(name).parent_path().string();
  const bool on_shelf = std::ranges::find(shelves, shelf_of_name) != shelves.end();
  const bool is_name = (shelf_of_name.empty() || on_shelf) && fs::path(name).extension() != ".yaml";
  if (!is_name || kind_of(name) == FileKind::file) return name;
  std::string looked_for;
  for (const std::string& shelf : on_shelf ? std::vector<std::string>{""} : shelves) {
    const fs::path entry = fs::path(shelf) / name, shipped = shipped_file(entry);
    if (!shipped.empty()) {
      if (shelf == "jobs" && !shipped_file(fs::path("studies") / name).empty())
        write_stderr(
            fmt::format("{}: note: is a job and a study; the job is taken. The study is studies/{}\n", name, name));
      return shipped;
    }
    looked_for += (looked_for.empty() ? "" : " or ") + entry.string() + ".yaml";
  }
  std::vector<std::string> entries;
  for (const std::string& shelf : shelves) {
    std::error_code failure;
    for (const fs::directory_entry& entry : fs::directory_iterator(shipped_catalogue() / shelf, failure))
      if (entry.path().extension() == ".yaml") entries.push_back(entry.path().stem().string());
  }
  std::ranges::sort(entries);
  if (name.find_first_not_of("0123456789") == std::string::npos)
    throw InputError(
        {name}, "is a number where a study or job is expected",
        "write the study's or job's name. -n prints what would run and takes no number; -j COUNT sets how many stages run at a time");
  const std::string near = nearest_entry(fs::path(name).filename().string(), entries);
  throw InputError({name}, fmt::format("is no file, and {} holds no {}", shipped_catalogue().string(), looked_for),
                   near.empty() ? "write the path of a YAML file"
                                : fmt::format("did you mean '{}'? Else write the path of a YAML file", near));
}

/// A kind of file that is no job and no study, and its use.
struct OtherKind {
  std::string_view kind, use;
};
constexpr OtherKind program_kind{"robot program", "name it in a job: dresslife new --program FILE JOB.yaml"},
    robot_kind{"robot description (URDF)",
               "name it in a job: dresslife new --robot FILE JOB.yaml; or give it to dresslife route"},
    result_kind{"result", "see it by dresslife show FILE or plot FILE"};

/// Returns the kind by the end of the file name; null: perhaps a YAML file, whose keys show its kind
/// (pipeline/resolve/document_kind.h).
const OtherKind* kind_by_name(const fs::path& file) {
  const std::string end = lower_case(file.extension().string());
  static const WordSet programs =
      word_set(".mod .modx .prg .sys .sysx .pgf .src .dat .sub .ls .va .jbi .cnd .script .urscript");
  if (programs.contains(end)) return &program_kind;
  if (end == ".urdf" || end == ".xacro") return &robot_kind;
  if (end == ".h5" || end == ".hdf5") return &result_kind;
  return nullptr;
}

/// Returns the input file that the user named. Throws InputError for a robot program or a result file.
fs::path input(fs::path file) {
  if (const OtherKind* const other = kind_by_name(file))
    throw InputError({file.string()}, fmt::format("is a {}, not a YAML file of dresslife", other->kind),
                     std::string(other->use));
  note_input(file);
  return file;
}

}  // namespace

Day day_of(const std::string& option, const std::string& text) {
  if (const std::optional<Day> day = exported_day(text)) return *day;
  throw InputError({option}, fmt::format("'{}' is no date", text), day_remedy(text));
}

fs::path named_file(const std::string& name, const std::string& shelf) { return input(file_or_entry(name, {shelf})); }

fs::path named_study(const std::string& name) { return input(file_or_entry(name, {"jobs", "studies"})); }

void check_sets(const fs::path& study, const std::vector<std::string>& sets, bool quiet) {
  const std::string notes = replaced_by_sets(study, sets);
  if (!quiet) write_stderr(shown(notes));
}

StudyRequest request_of(const StudyOptions& options, bool quiet) {
  StudyRequest request{named_study(options.study), options.sets, options.out, program_folder()};
  check_sets(request.file, request.sets, quiet);
  return request;
}

StudyState standing_study(const StudyRequest& request) {
  check_source(request.out / study_name(request.file), request.file);
  StudyState standing = expanded(request);
  report_changes(standing.study, standing.places, standing.states);
  return standing;
}

fs::path folder_of_results(const StudyRequest& request, const StudyOptions& options) {
  const fs::path folder = request.out / study_name(request.file);
  if (kind_of(folder) != FileKind::folder)
    throw InputError({folder.string()}, "is not there (the study has not run)",
                     "run it: dresslife run " + options.study);
  return folder;
}

void print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size()) note_failed_output(errno);
}

}  // namespace dresslife::pipeline
