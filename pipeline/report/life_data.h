// Life and strains for the timeline and the places of a page, as JSON for timeline.js and page.js.
#pragma once

#include "pipeline/files/files.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// Returns the data of a life file. strain: source of the strain histories of the worst wires of other segments (complete if they
/// were probed, else turning points) and of the extremes of curvature and twist; null: without them. Histories take at most
/// 0.9 MB, the most damaged segments first. Histories of more than 20,000 samples are reduced to the extremes of equal intervals.
/// For each segment the 300 largest closings of cycles are included. All other numbers are exactly those of the file. Errors:
/// InputError.
Json life_data(const FileReader& life, const FileReader* strain);

}  // namespace dresslife::pipeline
