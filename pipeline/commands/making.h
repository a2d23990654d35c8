// Runs the stages of a study that are not up to date.
#pragma once

#include <vector>

#include "pipeline/commands/options.h"
#include "pipeline/study/changes.h"
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

int count_failed(const std::vector<RankingRow>& rows);

/// Says on standard error how many jobs failed. input: what the user named. Returns the exit status.
int say_failures(const std::string& input, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
