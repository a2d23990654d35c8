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

/// Makes what is not up to date and brings the states up to date. Returns how many stages were started.
int make_rest(const StudyRequest& request, StudyState& standing, const RunOptions& options);

/// Runs what is not up to date of a study that no file of its own tells. Returns its rows.
std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options);

/// The same in a search. Errors: FilesChanged when a file is not as it was at its start.
std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options,
                                  const FilesAtStart& files);

/// The results of the ratings of its cables for each row; to_run: lets their rigs run first, and says with which
/// options.
void add_relative_lives(const Study& study, const StudyPlaces& of_study, const RunOptions* to_run,
                        std::vector<RankingRow>& rows);

/// The folder of a command's own jobs, below that of the results. As long as this lives no other run writes there.
struct OwnFolder {
  StudyPlaces places;
  FolderLock lock;
  /// file: the folder notes it as the source of its results. Errors: those of FolderLock and claim_folder().
  OwnFolder(const StudyOptions& options, const std::string& name, const std::filesystem::path& file);
};

/// A line of a job that is written before these runs.
inline constexpr const char* not_verified =
    "# Not yet verified within the mounting tolerance. The command replaces this file at its end.\n";

/// The runs within the mounting tolerance as one piece of work, whose remaining time is that of all runs.
class ToleranceRuns {
 public:
  ToleranceRuns(const std::string& label, const RunOptions& options);
  /// Of the runs that follow: how many were done before.
  void begin(const ToleranceCount& count);
  /// Options of these runs. Precondition: it stays where it is.
  const RunOptions& options() const { return options_; }

 private:
  void show(double share);

  Progress progress_;
  RunOptions options_;
  ToleranceCount count_;
};

int count_failed(const std::vector<RankingRow>& rows);

/// Says on standard error how many jobs failed. input: what the user named. Returns the exit status.
int say_failures(const std::string& input, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
