// Observed and predicted lives as complete SVG files: one row per observation on a common axis.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/calibrate/learning.h"
#include "pipeline/advise/calibrate/observations.h"

namespace dresslife::pipeline {

/// Returns each observation with its predictions.
std::string validation_picture(const ValidationStudy& validation, const std::vector<RankingRow>& rows);

/// Returns each parameter before and after a calibration, and each row's observed life with its predictions before and after.
std::string calibration_picture(const Learned& learned);

}  // namespace dresslife::pipeline
