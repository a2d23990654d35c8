// Runs the stages of a study that are not up to date.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/improve/tolerance.h"
#include "pipeline/base/progress.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Runs the stages that are not up to date and updates the states. Returns the number of started stages.
int make_rest(StudyState& standing, const RunOptions& options);

/// Runs the stages that are not up to date, of a study that has no file of its own. Returns its rows.
std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options);

/// Does the same within a search. Errors: FilesChanged when a file differs from its state at the start of the search.
std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options,
                                  const FilesAtStart& files);

/// Adds the relative lives of the cables with ratings to each row. to_run: options with which the rigs are run first; null: they
/// are not run.
void add_relative_lives(const Study& study, const StudyPlaces& of_study, const RunOptions* to_run,
                        std::vector<RankingRow>& rows);

/// The folder of a command's own jobs, inside the folder of results. No other run writes there during the life of this object.
struct OwnFolder {
  StudyPlaces places;
  FolderLock lock;
  /// file: noted in the folder as the source of its results. Errors: those of FolderLock and claim_folder().
  OwnFolder(const StudyOptions& options, const std::string& name, const std::filesystem::path& file);
};

/// A comment line in a job that is written before the runs within the mounting tolerance.
inline constexpr const char* not_verified =
    "# Not yet verified within the mounting tolerance. The command replaces this file at its end.\n";

/// Progress of the runs within the mounting tolerance; the remaining time is that of all these runs.
class ToleranceRuns {
 public:
  ToleranceRuns(const std::string& label, const RunOptions& options);
  /// Sets how many runs are already done and how many follow.
  void begin(const ToleranceCount& count);
  /// Returns the options for these runs. Precondition: this object is not moved.
  const RunOptions& options() const { return options_; }

 private:
  void show(double share);

  Progress progress_;
  RunOptions options_;
  ToleranceCount count_;
};

int count_failed(const std::vector<RankingRow>& rows);

/// Writes the number of failed jobs to standard error. input: the user's name for the study. Returns the exit status.
int say_failures(const std::string& input, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
