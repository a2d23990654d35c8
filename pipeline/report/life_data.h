// A life, and the strains behind it, for a page's timeline and its places; as JSON for timeline.js and
// page.js.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// strain: brings the strain histories of the worst wires of other segments, whole where they were probed,
/// else their turning points, and the extremes of curvature and twist; null: without. Histories fill at most
/// 0.9 MB, those of the most damaged segments first; longer ones than 20,000 samples are told by the extremes
/// of equal stretches. Of each segment the 300 largest closings of cycles are told. Everything else is told
/// in full, numbers as the file holds them. Errors: InputError.
Json life_data(const FileReader& life, const FileReader* strain);

}  // namespace dresslife::pipeline
