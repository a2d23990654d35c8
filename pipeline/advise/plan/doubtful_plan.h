// Checks of a file of duties and of a fleet for values that are likely errors of unit or typing, before anything is computed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/fleet.h"
#include "pipeline/advise/plan/plan.h"
#include "pipeline/base/warnings.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// Return one warning per doubtful value: its place, the value with its limit, the likely cause and a remedy.
std::vector<Warning> doubtful_duties(const DutyFile& file);
std::vector<Warning> doubtful_fleet(const Fleet& fleet, Day today);

/// Returns a warning for dresspacks that ran longer than their robot's life. plan: plan of this fleet. tables: (duty).
std::vector<Warning> doubtful_hours(const Fleet& fleet, const Plan& plan,
                                    const std::map<std::string, LifeTable>& tables);

/// Returns a warning for dresspacks with an age that few new dresspacks reach (usual_reach). plan: plan of this fleet.
std::vector<Warning> doubtful_ages(const Fleet& fleet, const Plan& plan);

/// Returns a warning if a calibration of the study contains hours without a failure, which the plan may count again as the age
/// of a dresspack. fleet: its file.
std::vector<Warning> doubtful_evidence(const Study& study, const std::string& fleet);

}  // namespace dresslife::pipeline
