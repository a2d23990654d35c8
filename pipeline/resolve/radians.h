// Detects angles of a job that are probably radians: keys in degrees whose values are small multiples of pi.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Returns warnings about the keys *_deg of a map whose values other than 0 are all k pi/4 (to 0.002: typed as 1.57) or k pi/12
/// (to 0.00005), up to 2 pi. path: of the map, "routing". pre_twist_deg has its own limit (plausible_job.cpp).
std::vector<Warning> radians_in(const Node& map, const std::string& path);

}  // namespace dresslife::pipeline
