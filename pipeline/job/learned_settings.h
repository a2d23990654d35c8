// The settings, cables and materials of the tests from which a calibration was learned. Its parameters belong to them:
// a friction that explains a test whose parts slip says nothing of a job whose parts stick.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// The settings of these jobs to which a calibration belongs, each different one once.
LearnedUnder learned_under(const std::vector<const Job*>& jobs);

/// Errors: InputErrors at the calibration, one for each setting, friction key of a cable and constant of a material that
/// is another in the job; a calibration without settings is refused, too.
void check_learned_settings(const Job& job);

/// LearnedFrom::observed of dresspacks in service: "3 of 12 failed".
std::string service_text(std::size_t failed, std::size_t all);
/// Whether a calibration was learned from dresspacks in service, of which those in use are a part.
bool counts_survivors(const Calibration& calibration);

/// Takes these parameters out. The others keep their joint normal distribution.
void leave_out(Calibration& calibration, const std::set<std::string>& names);

/// Takes the parameters out of the calibration that do not hold for the job: those of a construction (SharedBy) if the job
/// has a cable, for friction_hose and play a hose, that no test had; those of a material if no test had one of the job's.
/// The others keep their joint normal distribution without them, which is exact. within.left_out says it in words.
void leave_out_foreign_parameters(Job& job);

}  // namespace dresslife::pipeline
