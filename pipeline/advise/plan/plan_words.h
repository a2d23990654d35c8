// A plan as text for the terminal, as a table, and as a calendar.
#pragma once

#include <string>

#include "pipeline/advise/plan/plan.h"

namespace dresslife::pipeline {

/// What to replace in which window, failures before it, spare parts per year, costs. Ends with a line feed.
std::string plan_words(const Fleet& fleet, const Plan& plan);

/// One row per dresspack; numbers read back exactly.
std::string plan_csv(const Fleet& fleet, const Plan& plan);

/// An iCalendar file (RFC 5545) with an event for each window in which something is replaced.
std::string plan_calendar(const Fleet& fleet, const Plan& plan);

}  // namespace dresslife::pipeline
