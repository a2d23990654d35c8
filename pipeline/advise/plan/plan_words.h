// A plan as text for the terminal, as a table, and as a calendar.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/advise/plan/plan.h"
#include "pipeline/advise/plan/value_of_checks.h"
#include "pipeline/advise/plan/value_of_test.h"

namespace dresslife::pipeline {

/// What to replace in which window, failures before it, spare parts per year, costs. Ends with a line feed.
std::string plan_words(const Fleet& fleet, const Plan& plan);

/// The first sentence of it.
std::string expected_words(const Plan& plan);
/// Why dresspacks are replaced in no window, a line per reason. Empty: all are.
std::string kept_words(const Fleet& fleet, const Plan& plan);
/// Names of the dresspacks that are replaced in a window.
std::vector<std::string> replaced_in(const Fleet& fleet, const Plan& plan, std::size_t window);
/// "2027-07-12 .. 2027-08-01", "4.2 %"
std::string window_text(const Window& window);
std::string percent_text(double share);

/// What tests are worth, a line each of those that save a thousandth of the plan's cost or more, three at most.
std::string test_words(const std::vector<TestValue>& tests, const Plan& plan);

/// What visual checks for abrasion are worth: of one check today the three dresspacks with most, then all regular checks. checks: of
/// values_of_checks(); inspection: of the jobs.
std::string check_words(const std::optional<std::vector<CheckValue>>& checks, const Inspection& inspection, const Fleet& fleet,
                        const Plan& plan);

/// By when a mode that no test validates has ended 1 of 10 dresspacks under a duty [h of operation], and its name.
struct AgeLimit {
  std::string mode;
  double hours = 0;
};
/// Dresspacks that reach such an age before they are replaced, or before the end of the plan: a line for each mode, those that are
/// past it today first. limits: (name of the duty) its modes. week_hours: (name of the duty) hours per week where the fleet gives none.
/// Empty: none does.
std::string age_words(const Fleet& fleet, const Plan& plan, const std::map<std::string, std::vector<AgeLimit>>& limits,
                      const std::map<std::string, double>& week_hours);

/// A number of two plans, and how much larger the second is; "": no difference of numbers.
struct BesideRow {
  std::string what, now, then, more;
};
/// A plan beside the one of today's fleet: failures, windows, spare dresspacks, cost.
std::vector<BesideRow> beside_rows(const Fleet& fleet, const Plan& plan, const Fleet& changed, const Plan& other);
/// The same as text, and the dresspacks with another window. name: of the changed fleet.
std::string what_if_words(const std::string& name, const Fleet& fleet, const Plan& plan, const Fleet& changed, const Plan& other);

/// One row per dresspack and one column per week from today: P(failure in it) of today's dresspack, if it is not replaced.
std::string plan_weeks_csv(const Fleet& fleet, const Plan& plan);

/// One row per dresspack; numbers read back exactly. checks: of values_of_checks(); absent: their cells are empty.
std::string plan_csv(const Fleet& fleet, const Plan& plan, const std::optional<std::vector<CheckValue>>& checks = std::nullopt);

/// An iCalendar file (RFC 5545) with an event for each window in which something is replaced.
std::string plan_calendar(const Fleet& fleet, const Plan& plan);

}  // namespace dresslife::pipeline
