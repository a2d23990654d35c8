// What observations have taught, put into the job that names them.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// In a job's tree that is not read yet: the calibration's file in place of its name, its medians in the keys
/// that stand at their defaults. Errors: InputError.
void apply_calibration(Node& job);

}  // namespace dresslife::pipeline
