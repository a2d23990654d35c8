// Checks of observations for likely errors of unit, copied rows and contradictions, before anything is computed.
#pragma once

#include <vector>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// Returns one warning per doubtful value: the place of its row, the value with its limit, the likely cause and a remedy. Errors:
/// InputError for a bending table that cannot be read.
std::vector<Warning> doubtful_rows(const std::vector<ObservedTest>& tests);

}  // namespace dresslife::pipeline
