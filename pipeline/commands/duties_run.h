// Runs the study that is named in a file of duties.
#pragma once

#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

struct DutiesRun {
  Study study;
  StudyPlaces places;
  std::vector<RankingRow> rows;
};

/// Checks the duties against the study before the first run. Runs the stages that are not up to date. Errors: InputError.
DutiesRun run_duties(const DutyFile& file, const RunOptions& options);

}  // namespace dresslife::pipeline
