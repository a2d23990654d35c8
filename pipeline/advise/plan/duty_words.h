// Duties as text for the terminal, and as a table for other programs.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/plan/evaluated_duties.h"

namespace dresslife::pipeline {

/// Of several programs: places that they do not share, what changes between them do to each mode, and the measured difference of such
/// duties to one motion; empty: one program, and nothing worth a word.
std::string mixture_words(const DutyResult& duty);

/// Of each duty: when to replace, then a line for each program. Ends with a line feed.
std::string duty_words(const std::vector<DutyResult>& results);

/// When to replace, a sentence; and the hours by which 1 of 10, half and 90 % have failed.
std::string duty_action(const DutyResult& duty);
std::string percentile_words(const DutyResult& duty);
/// Hours as the tables of a study show them: beyond the robot's own life only that.
std::string shown_hours(double robot_life, double hours);

/// What is not in its hours: modes that no test validates, and what is not evaluated. Lines, or empty.
std::string caution_words(const DutyResult& duty);

/// One row per duty and program; lives are of the whole duty. Numbers read back exactly, "inf" without damage.
std::string duty_csv(const std::vector<DutyResult>& results);

}  // namespace dresslife::pipeline
