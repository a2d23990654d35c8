// What stands where before a run: the robot over its program, clamps, and each dresspack in a smooth curve of
// its length; how far its clamps are apart, which lengths suit that, and how hard each would be bent at rest.
#pragma once

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Writes all of preview_format() but the stamp. The first sample stands at -1 s in the mounting pose where
/// that is not the program's first. Errors: InputError for a motion that the robot cannot run; what the
/// simulation itself refuses stands in the file.
void write_preview(const pipeline::Setup& setup, pipeline::FileWriter& file);

}  // namespace dresslife::sim
