// Calendar days.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

using Day = std::chrono::sys_days;
inline constexpr const char* date_remedy = "write YYYY-MM-DD, as in 2027-07-12";

/// Reads "2027-07-12". Returns std::nullopt for a text that is no date.
std::optional<Day> day_from(std::string_view text);
std::string day_text(Day day);
Day today();

inline double days_between(Day from, Day to) { return static_cast<double>((to - from).count()); }

}  // namespace dresslife::pipeline
