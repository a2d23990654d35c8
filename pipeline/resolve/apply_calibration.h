// Applies a calibration to the job that names it.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct Job;

/// Replaces the calibration's name by the content of its file, in a job's tree that was not read yet. Errors: InputError.
void read_calibration(Node& job);

/// Checks that the calibration was learned with the job's settings, removes parameters that are not valid for the job
/// (pipeline/job/learned_settings.h) and writes its medians into the keys with default values. In a resolved job, keys may have been
/// changed since: then it removes what the present keys exclude, with its medians. tree: from which the job was read. Errors:
/// InputError.
void apply_calibration(Node& tree, Job& job);

/// Sets Calibration::residual_spread to 1 if the calibration has no records of the job's motion and routing. A resolved job keeps its
/// value if the files of its motion are not there. Precondition: the job has a calibration and is complete.
void apply_spread(Job& job);

/// File of the catalogue with a calibration for cables without one: it was learned from makers' ratings by dresslife calibrate.
inline constexpr const char* typical_ratings_file = "observations/typical_cables.yaml";

/// Applies typical_ratings_file to a job that names no calibration, unless uncertainty.ratings is none or uncertainty.enabled is
/// false. It has no effect on a job with other settings than the tests, and on parameters that the job sets itself. If nothing of
/// it applies, `ratings` becomes none, so that a resolved job is the same with any catalogue; ratings_left_out names a setting that
/// excludes them. Errors: InputError if the file is no calibration.
void apply_ratings(Node& tree, Job& job);

}  // namespace dresslife::pipeline
