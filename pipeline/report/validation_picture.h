// Predicted and observed lives: one line per observation on a common axis, as a complete SVG file.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/calibrate/observations.h"

namespace dresslife::pipeline {

std::string validation_picture(const ValidationStudy& validation, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
