// What observations have taught, put into the job that names them.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct Job;

/// In a job's tree that is not read yet: the calibration's file in place of its name. Errors: InputError.
void read_calibration(Node& job);

/// Checks that the calibration was learned under the job's settings, leaves out what does not hold for the job
/// (pipeline/job/learned_settings.h) and puts its medians into the keys that stand at their defaults.
/// tree: that the job was read from. Errors: InputError.
void apply_calibration(Node& tree, Job& job);

/// In the catalogue: the evidence of makers' ratings for a cable without a calibration, as dresslife calibrate wrote it.
inline constexpr const char* typical_ratings_file = "observations/typical_cables.yaml";

/// The same with typical_ratings_file for a job that names no calibration, unless uncertainty.ratings is none or
/// uncertainty.enabled false. Without effect on a job with other settings than the tests, and on parameters that the job
/// states itself. Where it has none, ratings becomes none: a resolved job is the same with any catalogue. Errors:
/// InputError where the file is no calibration.
void apply_ratings(Node& tree, Job& job);

}  // namespace dresslife::pipeline
