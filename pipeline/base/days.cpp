#include "pipeline/base/days.h"

#include <fmt/format.h>

#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

using std::chrono::year_month_day;

std::optional<Day> day_of(std::string_view year, std::string_view month, std::string_view day) {
  const auto y = whole_number_in<int>(year), m = whole_number_in<int>(month), d = whole_number_in<int>(day);
  if (!y || !m || !d || *m < 1 || *d < 1) return std::nullopt;
  const year_month_day date{std::chrono::year(*y), std::chrono::month(static_cast<unsigned>(*m)),
                            std::chrono::day(static_cast<unsigned>(*d))};
  if (!date.ok()) return std::nullopt;
  return Day(date);
}

}  // namespace

std::optional<Day> day_from(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  return day_of(text.substr(0, 4), text.substr(5, 2), text.substr(8, 2));
}

std::string day_text(Day day) {
  const year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()), unsigned(date.day()));
}

Day today() { return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()); }

}  // namespace dresslife::pipeline
