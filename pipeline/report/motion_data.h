// A motion for a page's 3D view: poses of links and dresspacks, curvature and twist, at as many samples as
// the page has room for; as JSON for viewer.js.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// strain: brings curvature and twist; null: without. Keys are chosen (key_samples.h) so that straight lines
/// between them miss no sample by more than half a millimetre, 1 % of the largest curvature and of the
/// largest twist; these bounds double until a motion fits into 2.3 MB of numbers. What became of them stands
/// in the text. Errors: InputError where the files cannot be read or do not belong together.
Json motion_data(const FileReader& motion, const FileReader* strain, const Setup& setup);

}  // namespace dresslife::pipeline
