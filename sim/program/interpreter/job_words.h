// Remedies as lines of a job.
#pragma once

#include <string>
#include <vector>

namespace dresslife::sim {

inline constexpr const char* modules_of_job = "motion.modules: [{file: FILE}]";
inline constexpr const char* then_or_else = "then or take: else";

/// Returns "motion.values: [{name: di1, value: VALUE}]", a line at the first level of a job.
std::string values_of_job(const std::vector<std::string>& names, const std::string& value = "VALUE");

/// Returns "motion.assume: [{line: 'm.mod:5', take: then}] or take: else". answers: the first word, and text about others.
std::string assume_of_job(const std::string& line, const std::string& answers = then_or_else);

/// Returns the warnings about answers of the user that no line of the program asked for.
std::string unused_value(const std::string& name);
std::string unused_assumption(const std::string& line);

}  // namespace dresslife::sim
