// Settings, cables and materials of the tests from which a calibration was learned. Its parameters are valid only with them: a
// friction from a test in which parts slip gives no information for a job in which parts stick.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// Returns the different settings, cables and materials of these jobs, for a calibration.
LearnedUnder learned_under(const std::vector<const Job*>& jobs);

/// A setting, friction key or constant of a job that is not that of its calibration.
struct OtherSetting {
  std::string what;    ///< "strain.slip: friction (this job has free)"
  std::string remedy;  ///< for a job that names the calibration
};

/// Returns the differences between a job and the tests of its calibration.
std::vector<OtherSetting> other_settings(const Job& job);

/// Checks that a job's settings are those of its calibration. Errors: InputErrors at the calibration, one for each of
/// other_settings(), and one for a calibration without settings.
void check_learned_settings(const Job& job);

/// Returns LearnedFrom::observed for dresspacks in service: "3 of 12 failed".
std::string service_text(std::size_t failed, std::size_t all);
/// Returns whether a calibration was learned from dresspacks in service, some of which are still in use.
bool counts_survivors(const Calibration& calibration);

/// Removes these parameters from a calibration. The other parameters keep their joint normal distribution.
void leave_out(Calibration& calibration, const std::set<std::string>& names);

/// Removes the parameters that are not valid for the job from its calibration. Parameters of a construction (SharedBy) are
/// removed if the job has a cable (for friction_hose and play: a hose) that was not tested. Parameters of a material are removed
/// if one of the job's materials was not tested. The other parameters keep their joint normal distribution, which is exact. Writes
/// within.left_out in words.
void leave_out_foreign_parameters(Job& job);

}  // namespace dresslife::pipeline
