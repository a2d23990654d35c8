// The page of a plan: what to replace in which window, a calendar of the dresspacks with the greatest risk, spare parts per
// year, and the table of all dresspacks.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/plan.h"

namespace dresslife::pipeline {

/// name: of the fleet. notes: paragraphs on what the plan does not contain. table: the file with all dresspacks.
std::string plan_page(const std::string& name, const Fleet& fleet, const Plan& plan, const std::vector<std::string>& notes,
                      const std::string& table);

}  // namespace dresslife::pipeline
