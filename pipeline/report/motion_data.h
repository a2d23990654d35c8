// A motion for the 3D view of a page, as JSON for viewer.js: poses of links and dresspacks, curvature and twist, at a reduced
// number of samples.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// Returns the motion. strain: source of curvature and twist; null: without them. Samples are chosen (key_samples.h) so that
/// linear interpolation is within 0.5 mm, 1 % of the largest curvature and 1 % of the largest twist. These tolerances are doubled
/// until a motion fits into 2.3 MB; the page states them. Errors: InputError when the files cannot be read or do not
/// belong together.
Json motion_data(const FileReader& motion, const FileReader* strain, const Setup& setup);

/// Returns the lines of the program and the times when they begin [s after the first sample]; -1 before the program (time 0).
Json program_data(const FileReader& file);

}  // namespace dresslife::pipeline
