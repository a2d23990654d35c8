// Runs the study that a file of duties names.
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

/// Checks the duties against the study before anything runs. Errors: InputError.
DutiesRun run_duties(const DutyFile& file, const RunOptions& options);

}  // namespace dresslife::pipeline
