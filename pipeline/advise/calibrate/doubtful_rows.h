// Rows of observations that another unit, a copy of a row or a contradiction explains, before anything is computed.
#pragma once

#include <vector>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// Each with the place of its row, the value with its limit, the likely cause and a remedy. Errors: InputError of a bending table
/// that cannot be read.
std::vector<Warning> doubtful_rows(const std::vector<ObservedTest>& tests);

}  // namespace dresslife::pipeline
