// Duties as text for the terminal, and as a table for other programs.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/base/csv_rows.h"

namespace dresslife::pipeline {

/// Returns, for several programs, the share of places that they do not have in common, the effect of changes between them on each
/// mode, and the measured difference between such a duty and one motion. Empty: one program, or no effect of relevant size.
std::string mixture_words(const DutyResult& duty);

/// Returns, for each duty, the replacement time and a line for each program. Ends with a line feed.
std::string duty_words(const std::vector<DutyResult>& results);

/// Return the replacement time as a sentence; and the hours by which 1 of 10, half and 90 % have failed.
std::string duty_action(const DutyResult& duty);
std::string percentile_words(const DutyResult& duty);
/// Returns hours in the form of a study's tables: beyond the robot's own life only "over" this life.
std::string shown_hours(double robot_life, double hours);
/// Returns the first percentile of DutyPart::without, or "not known".
std::string without_text(const DutyResult& duty, const DutyPart& part);
/// Returns the first percentile of DutyPart::as_twice, or "no time for it".
std::string as_twice_text(const DutyResult& duty, const DutyPart& part);

/// Returns what the hours of a duty leave out: modes that no test validates, and parts that are not evaluated. Lines, or empty.
std::string caution_words(const DutyResult& duty);

/// Returns one row per duty and program; lives belong to the whole duty. Numbers are exact when read back; "inf": no damage; empty: not
/// computed, or not possible.
CsvTable duty_table(const std::vector<DutyResult>& results);

}  // namespace dresslife::pipeline
