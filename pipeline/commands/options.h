// What several commands read from the command line, and how they answer.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/days.h"
#include "pipeline/base/limits.h"
#include "pipeline/stage/command_line.h"
#include "pipeline/study/known_study.h"

namespace dresslife::pipeline {

struct StudyOptions {
  std::string study, out = "runs";
  bool json = false;  ///< of commands with json_option()
  std::vector<std::string> sets;
};

struct RunOptions : StudyOptions {
  int jobs;  ///< stages at a time
  bool quiet = false;
  std::string launcher;  ///< before each stage's command
  std::string shard;     ///< "2/8": only the second eighth of the jobs; empty: all
  /// Of runs within a search: gets the share of the stages that are done, and no line of its own shows it.
  std::function<void(double)> share_done{};
  StageLimits limits{24 * 3600, installed_memory_mb()};  // a day, and what the machine has
  RunOptions();
};

/// The argument STUDY.yaml or JOB.yaml.
Option study_or_job(StudyOptions& options);
/// --set KEY.PATH=VALUE, as often as wanted. what: "override a key".
Option sets_option(const std::string& what, std::vector<std::string>& sets);
/// --json: of commands that print a table.
Option json_option(bool& json);
/// --output DIR and --set.
std::vector<Option> study_options(StudyOptions& options);
/// --jobs and --quiet: of commands that run stages.
std::vector<Option> run_options(RunOptions& options);
/// --launcher: of commands whose stages may run elsewhere.
Option launcher_option(RunOptions& options);

/// The date that an option has. Errors: InputError for a text that is no date.
Day day_of(const std::string& option, const std::string& text);

/// What a user names: a file, or an entry of the catalogue ("two_robots" or "studies/two_robots"). A name of both a job and
/// a study means the job in every command, which a note says. shelf: folder of config/. Errors: InputError, neither, or a robot
/// program or a result.
std::filesystem::path named_file(const std::string& name, const std::string& shelf);

/// Likewise a study, or a job, which is a study of one.
std::filesystem::path named_study(const std::string& name);

StudyRequest request_of(const StudyOptions& options);

/// A study as it stands, for commands that make nothing: with what has changed since its stale results. Errors: those of
/// check_source() and standing_of().
StudyState standing_study(const StudyRequest& request);

/// The folder of a study's results. Errors: InputError when it is not there.
std::filesystem::path folder_of_results(const StudyRequest& request, const StudyOptions& options);

/// To standard output, as it is: what comes from jobs and programs passes shown() first.
void print(const std::string& text);

}  // namespace dresslife::pipeline
