#include "pipeline/life/likely_age.h"

#include <fmt/format.h>

#include "pipeline/base/readable.h"

namespace dresslife::pipeline {

std::optional<AgeDoubt> doubt_about_age(const std::string& name, Day installed, Day until, double hours,
                                        double robot_life, bool failed) {
  const auto age = until - installed;
  if (age > oldest_likely)
    return AgeDoubt{fmt::format("'{}' was installed {} days before {} (limit {}: 20 years)", name, age.count(),
                                day_text(until), oldest_likely.count()),
                    "the date of the robot, or a wrong year", "installed: the date of the dresspack"};
  if (hours > robot_life)
    return AgeDoubt{
        fmt::format("'{}' ran {} until {} (limit {}: the robot's life)", name, hours_text(hours), day_text(until),
                    hours_text(robot_life)),
        "the date of the robot, a replacement that is not in the table, or too many hours per week",
        "installed: the date of the dresspack; fatigue.robot_life_hours in the job if its robot runs so long"};
  if (failed && age < earliest_likely_failure)
    return AgeDoubt{fmt::format("'{}' failed {} {} after its installation (limit {} or more)", name, age.count(),
                                age.count() == 1 ? "day" : "days", earliest_likely_failure.count()),
                    "damage when it was mounted, or a wrong date",
                    "preventive as its reason if its wires did not fail by wear; else the dates as they were"};
  return std::nullopt;
}

}  // namespace dresslife::pipeline
