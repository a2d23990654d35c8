// screening.h5: geometric checks of many routings of a job, or proposed routings.
#pragma once

#include <filesystem>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::sim {

struct ProposalSettings;

/// Writes all of screening_format() except the stamp, with one candidate for each item of a YAML list of maps from key
/// paths to values; each map changes the job. A candidate that is no valid job, or whose motion the robot
/// cannot run, has the reason in the file. A clamp or ring of the job that exceeds (V7) keeps its own value as the limit in its
/// place, because its bracket exists. in_runs: each candidate gets a short run (short_run.h), and the results of its run are
/// written instead; for a candidate that does not run the reason and the geometric values. Errors: InputError for a file that is
/// no such list.
void write_screening(const pipeline::Job& job, const std::filesystem::path& candidates, bool in_runs,
                     pipeline::FileWriter& file);

/// Writes proposals (proposal.h) in this format, best first. The softer hose is that of the job's uncertainty.
void write_proposals(const pipeline::Job& job, ProposalSettings settings, pipeline::FileWriter& file);

}  // namespace dresslife::sim
