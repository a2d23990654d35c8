// The page of duties: for each program its share of the damage, the life without it, and the life over its share of the time.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/evaluated_duties.h"

namespace dresslife::pipeline {

/// Returns the page. name: name of the file of duties. table: file with the same numbers.
std::string duty_page(const std::string& name, const std::vector<DutyResult>& results, const std::string& table);

}  // namespace dresslife::pipeline
