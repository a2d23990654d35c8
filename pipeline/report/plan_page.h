// The page of a plan: what to replace in which window, a calendar of the dresspacks with the greatest risk, spare parts per
// year, and the table of all dresspacks.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/plan_words.h"

namespace dresslife::pipeline {

/// Beside the plan: why not to plan with duties, what tests and checks are worth (lines), and paragraphs on what it does not contain.
struct PlanNotes {
  std::vector<std::string> doubts;
  std::string values;
  std::vector<std::string> paragraphs;
  std::string today{};              ///< of a changed fleet: the name of today's
  std::vector<BesideRow> beside{};  ///< its plan, and that of the changed fleet
};
/// name: of the fleet. table: the file with all dresspacks.
std::string plan_page(const std::string& name, const Fleet& fleet, const Plan& plan, const PlanNotes& notes, const std::string& table);

}  // namespace dresslife::pipeline
