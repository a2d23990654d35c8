// A plan as text for the terminal, as a table, and as a calendar.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/advise/plan/plan.h"
#include "pipeline/advise/plan/value_of_checks.h"
#include "pipeline/advise/plan/value_of_test.h"
#include "pipeline/base/csv_rows.h"

namespace dresslife::pipeline {

/// Returns the plan as text: replacements per window, failures before it, spare parts per year, costs. Ends with a line feed.
std::string plan_words(const Fleet& fleet, const Plan& plan);

/// Returns the first sentence of plan_words().
std::string expected_words(const Plan& plan);
/// Returns why a plan by cost has the larger cost within its time, behind a blank. Empty: it has not.
std::string later_saving_words(const Plan& plan);
/// Returns the reasons why dresspacks are replaced in no window, one line per reason. Empty: all are replaced.
std::string kept_words(const Fleet& fleet, const Plan& plan);
/// Returns the names of the dresspacks that are replaced in a window.
std::vector<std::string> replaced_in(const Fleet& fleet, const Plan& plan, std::size_t window);
/// Returns the mean number of replacements in a window of dresspacks that are put in after today, which have no names yet.
/// 0: fewer than 1 in 100 plants.
double later_in(const Plan& plan, std::size_t window);
/// Return "2027-07-12 .. 2027-08-01", and "4.2 %".
std::string window_text(const Window& window);
std::string percent_text(double share);

/// Returns the value of tests, one line for each test that saves a thousandth of the plan's cost or more and more than by
/// chance, at most three.
std::string test_words(const std::vector<TestValue>& tests, const Plan& plan);

/// Returns the value of visual checks for abrasion: of one check today for the three dresspacks with the largest value, then of
/// all regular checks. checks: result of values_of_checks(); inspection: checks of the jobs.
std::string check_words(const std::optional<std::vector<CheckValue>>& checks, const Inspection& inspection,
                        const Fleet& fleet, const Plan& plan);

/// Hours of operation by which a mode that no test validates has ended 1 of 10 dresspacks under a duty, and the mode's name.
struct AgeLimit {
  std::string mode;
  double hours = 0;
};
/// Returns the dresspacks that reach such an age before their replacement or before the end of the plan, and whose wires live until
/// then in at least 1 of 10 cases (usual_reach): one line per mode, dresspacks already above it first. Hours under earlier duties count by their wear (worn_hours()). limits: (name of the duty)
/// its modes, also for earlier duties. week_hours: (name of the duty) hours per week if the fleet gives none. Empty: no dresspack.
std::string age_words(const Fleet& fleet, const Plan& plan, const std::map<std::string, std::vector<AgeLimit>>& limits,
                      const std::map<std::string, double>& week_hours);

/// A number of two plans and its increase; more is empty if it is no difference of numbers.
struct BesideRow {
  std::string what, now, then, more;
};
/// Returns the numbers of the present fleet's plan and of another plan: failures, windows, spare dresspacks, cost.
std::vector<BesideRow> beside_rows(const Fleet& fleet, const Plan& plan, const Fleet& changed, const Plan& other);
/// Returns beside_rows() as text, and the dresspacks with another window. name: name of the changed fleet.
std::string what_if_words(const std::string& name, const Fleet& fleet, const Plan& plan, const Fleet& changed,
                          const Plan& other);

/// Returns a row per dresspack and a column per week from today: P(failure in this week) of today's dresspack if not replaced.
std::string plan_weeks_csv(const Fleet& fleet, const Plan& plan);

/// Returns one row per dresspack; numbers are exact when they are read back. checks: result of values_of_checks(); absent: their
/// cells are empty.
CsvTable plan_table(const Fleet& fleet, const Plan& plan,
                    const std::optional<std::vector<CheckValue>>& checks = std::nullopt);

/// Returns an iCalendar file (RFC 5545) with an event for each window.
std::string plan_calendar(const Fleet& fleet, const Plan& plan);

}  // namespace dresslife::pipeline
