// The page of a plan: the dresspacks to replace in each window, a calendar of the dresspacks with the greatest risk, spare parts
// per year, and the table of all dresspacks.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/plan_words.h"

namespace dresslife::pipeline {

/// Notes beside the plan: doubts (reasons not to plan with some duties), values (lines on the value of tests and checks), and
/// paragraphs on the limits of the plan.
struct PlanNotes {
  std::vector<std::string> doubts;
  std::string values;
  std::vector<std::string> paragraphs;
  std::string today{};              ///< name of the present fleet, if another fleet is compared with it
  std::vector<BesideRow> beside{};  ///< the plan of the present fleet and that of the other fleet
};
/// Returns the page. name: name of the fleet. table: file with all dresspacks.
std::string plan_page(const std::string& name, const Fleet& fleet, const Plan& plan, const PlanNotes& notes,
                      const std::string& table);

}  // namespace dresslife::pipeline
