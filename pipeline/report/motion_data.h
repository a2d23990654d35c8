// A motion for a page's 3D view as JSON for viewer.js: poses of links and dresspacks, curvature and twist, at a reduced
// number of samples.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// strain: source of curvature and twist; null: without. Samples are chosen (key_samples.h) so that straight lines
/// between them are within 0.5 mm, 1 % of the largest curvature and 1 % of the largest twist. These tolerances double
/// until a motion fits into 2.3 MB; the text states them. Errors: InputError when the files cannot be read or do not
/// belong together.
Json motion_data(const FileReader& motion, const FileReader* strain, const Setup& setup);

/// Lines of the program, and when they begin [s after the first sample]; -1 before the program (time 0).
Json program_data(const FileReader& file);

}  // namespace dresslife::pipeline
