// A preview before a run: the robot over its program, the clamps, and each dresspack as a smooth curve of
// its length; the distance of its clamps, suitable lengths, and the bend of each length at rest.
#pragma once

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::sim {

/// Writes all of preview_format() except the stamp. If the mounting pose is not the program's first pose, it is the first sample,
/// at -1 s. Errors: InputError for a motion that the robot cannot run; a refusal by the
/// simulation is written to the file.
void write_preview(const pipeline::Job& job, pipeline::FileWriter& file);

}  // namespace dresslife::sim
