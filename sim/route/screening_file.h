// screening.h5: what geometry alone, or a short run, says of many routings of a job.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::sim {

struct ScreeningRequest {
  /// YAML, a list of maps. Each is a candidate: from key paths to values, which change the job, or
  /// {routing_at: [...]}, a place of its routing box (routing_box.h).
  std::filesystem::path candidates;
  bool in_runs = false;   ///< each is rehearsed (rehearsal.h), and what its run saw is written instead
  bool exercise = false;  ///< the job's motion was made for it, and is written, too
  std::string ring_link;  ///< of the routing box; empty: no guide ring
};

/// Writes all of screening_format() but the stamp. A candidate that is no job, or whose motion the robot
/// cannot run, says why in the file; of one that does not run, its numbers are those of geometry. Errors:
/// InputError for a file that is no such list, and for a job that has no routing box if a candidate is a
/// place of it.
void write_screening(const pipeline::Job& job, const ScreeningRequest& request, pipeline::FileWriter& file);

}  // namespace dresslife::sim
