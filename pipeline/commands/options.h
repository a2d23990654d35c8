// Options that several commands have, and the files that their arguments name.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/days.h"
#include "pipeline/base/limits.h"
#include "pipeline/stage/command_line.h"
#include "pipeline/study/study_state.h"

namespace dresslife::pipeline {

struct StudyOptions {
  std::string study, out = "runs";
  bool json = false;  ///< only for commands with json_option()
  std::vector<std::string> sets;
};

struct RunOptions : StudyOptions {
  int jobs;  ///< number of stages that run at the same time
  bool quiet = false;
  std::string launcher;  ///< shell words in front of each stage's command
  std::string shard;     ///< "2/8": only the second eighth of the jobs; empty: all
  /// For runs within a search: receives the share of the finished stages; the run then prints no progress of its own.
  std::function<void(double)> share_done{};
  StageLimits limits{24 * 3600, installed_memory_mb()};  // one day, and the memory of this machine
  RunOptions();
};

/// Returns the argument STUDY.yaml or JOB.yaml.
Option study_or_job(StudyOptions& options);
/// Returns --set KEY.PATH=VALUE, which may be repeated. what: description, such as "override a key".
Option sets_option(const std::string& what, std::vector<std::string>& sets);
/// Returns --json, for commands that print a table.
Option json_option(bool& json);
/// Returns --output DIR. of: what the folder contains. Its value must not be the name of a job.
Option folder_option(const std::string& of, std::string& out);
/// Returns --output DIR and --set.
std::vector<Option> study_options(StudyOptions& options);
/// Returns --jobs and --quiet, for commands that run stages.
std::vector<Option> run_options(RunOptions& options);
/// Returns --launcher, for commands whose stages may run on other machines.
Option launcher_option(RunOptions& options);

/// Returns the date in the text of an option. Errors: InputError for text that is no date.
Day day_of(const std::string& option, const std::string& text);

/// Returns the file for a name given by the user: a path, or an entry of the catalogue ("two_robots" or "studies/two_robots").
/// shelf: folder of config/. If both a job and a study have the name, every command uses the job and prints a note. Errors:
/// InputError when neither exists, or for a robot program or a result file.
std::filesystem::path named_file(const std::string& name, const std::string& shelf);

/// Returns the file of a study, or of a job, which is a study of one job. Names as in named_file().
std::filesystem::path named_study(const std::string& name);

/// Refuses `--set` of keys that a study varies. Prints which own values of its jobs the others replace, unless quiet. Errors:
/// those of replaced_by_sets().
void check_sets(const std::filesystem::path& study, const std::vector<std::string>& sets, bool quiet);

/// Returns the study and its places. Errors: those of check_sets(), whose notes it prints unless quiet.
StudyRequest request_of(const StudyOptions& options, bool quiet = true);

/// Returns the state of a study for commands that compute nothing, with the changes since its stale results. Errors: those of
/// check_source() and expanded().
StudyState standing_study(const StudyRequest& request);

/// Returns the folder of a study's results. Errors: InputError when it does not exist.
std::filesystem::path folder_of_results(const StudyRequest& request, const StudyOptions& options);

/// Writes text unchanged to standard output. Precondition: text from jobs and programs has passed shown().
void print(const std::string& text);

}  // namespace dresslife::pipeline
