// Numbers of a file of duties and of a fleet that another unit or a slip explains, before anything is computed.
#pragma once

#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/fleet.h"
#include "pipeline/advise/plan/plan.h"
#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// Each with its place, the value with its limit, the likely cause and a remedy.
std::vector<Warning> doubtful_duties(const DutyFile& file);
std::vector<Warning> doubtful_fleet(const Fleet& fleet, Day today);

/// Dresspacks that hardly any new one gets as old as (usual_reach). plan: of this fleet.
std::vector<Warning> doubtful_ages(const Fleet& fleet, const Plan& plan);

}  // namespace dresslife::pipeline
