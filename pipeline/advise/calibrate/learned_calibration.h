// What was learned as the file that a job names (pipeline/job/calibration.h).
#pragma once

#include "pipeline/advise/calibrate/learned.h"

namespace dresslife::pipeline {

/// learned: with its axes. round: the last, whose files lie at `places`; what its jobs at the centre went
/// through is where the calibration holds.
Calibration calibration_of(const Learned& learned, const std::vector<ObservedTest>& tests,
                           const RoundOfJobs& round, const StudyPlaces& places);

}  // namespace dresslife::pipeline
