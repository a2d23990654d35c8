// The settings under which a calibration was learned. Its parameters belong to them: a friction that explains a test
// with sliding parts says nothing of a job whose parts stick.
#pragma once

#include <vector>

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// What of a job's strain and fatigue decides a prediction and is no uncertain parameter, as key and value. Slip is
/// listed level by level; "any" at the first level of a cable alone, which lies in nothing.
std::vector<LearnedSetting> settings_of(const Job& job);

/// Those of several tests; a key has all values that occur, joined by " or ".
std::vector<LearnedSetting> settings_of(const std::vector<const Job*>& jobs);

/// Errors: InputError at the calibration for a setting of the job that is another. A calibration without settings (it
/// was written before they were kept) is refused, too.
void check_learned_settings(const Job& job);

}  // namespace dresslife::pipeline
