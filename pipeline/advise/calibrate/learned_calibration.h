// The result of a calibration as the file that a job names (pipeline/job/calibration.h).
#pragma once

#include "pipeline/advise/calibrate/learned.h"

namespace dresslife::pipeline {

/// Returns the calibration. round: the last round, with its files at `places`. The calibration is valid in the range of bends,
/// twists and strains of its jobs at the centre.
Calibration calibration_of(const Learned& learned, const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                           const StudyPlaces& places);

}  // namespace dresslife::pipeline
