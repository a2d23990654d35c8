// screening.h5: checks by geometry alone of many routings of a job, or the routings that it proposes.
#pragma once

#include <filesystem>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::sim {

struct ProposalSettings;

/// Writes all of screening_format() but the stamp, a candidate for each item of a YAML list of maps from key
/// paths to values, each of which changes the job. A candidate that is no job, or whose motion the robot
/// cannot run, says why in the file. Where the job itself passes (V7), that limit counts
/// from the job: what the job has can be built. in_runs: each is rehearsed (rehearsal.h), and what its run saw is
/// written instead; of what does not run why, and what geometry says. Errors: InputError for a file that is
/// no such list.
void write_screening(const pipeline::Job& job, const std::filesystem::path& candidates, bool in_runs,
                     pipeline::FileWriter& file);

/// The same of proposals (proposal.h), best first.
void write_proposals(const pipeline::Job& job, const ProposalSettings& settings, pipeline::FileWriter& file);

}  // namespace dresslife::sim
