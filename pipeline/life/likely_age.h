// Ages of dresspacks that a table is likely to have. Other ages suggest a wrong date.
#pragma once

#include <optional>
#include <string>

#include "pipeline/base/days.h"

namespace dresslife::pipeline {

/// Robots are overhauled or replaced after 40,000 h, and no dresspack is older than its robot.
inline constexpr std::chrono::days oldest_likely{20 * 365};
/// A dresspack that fails earlier was damaged when it was mounted, or has a wrong date.
inline constexpr std::chrono::days earliest_likely_failure{7};

/// A doubt about an age: the first three parts of a warning.
struct AgeDoubt {
  std::string problem, cause, remedy;
};
/// Returns the doubt; absent: the age is likely. name: of the dresspack. hours: of operation from `installed` to `until`.
/// robot_life: fatigue.robot_life_hours [h]. failed: whether it failed on `until`.
std::optional<AgeDoubt> doubt_about_age(const std::string& name, Day installed, Day until, double hours,
                                        double robot_life, bool failed);

}  // namespace dresslife::pipeline
