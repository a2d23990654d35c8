#include "sim/recording/log_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <string>

#include "pipeline/base/csv_rows.h"
#include "sim/program/axis_names.h"

namespace dresslife::sim {
namespace {

constexpr double day = 86'400;

/// Reads three integers with one of these separators from the begin of a text, and removes them from the text.
std::optional<std::array<int, 3>> three_numbers(std::string_view& text, std::string_view separators) {
  std::array<int, 3> numbers{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0) {
      if (rest.empty() || separators.find(rest[0]) == rest.npos) return {};
      rest.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), numbers[k]);
    if (error != std::errc() || numbers[k] < 0) return {};
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  }
  text = rest;
  return numbers;
}

/// Returns the days since 1970.
std::optional<double> date_in(std::string_view& text) {
  std::string_view rest = text;
  const auto found = three_numbers(rest, "-/.");
  if (!found) return {};
  auto [year, month, of_month] = *found;
  if (year < 1000) {
    const bool month_first = text.find('/') != text.npos;
    year = (*found)[2], month = (*found)[month_first ? 0 : 1], of_month = (*found)[month_first ? 1 : 0];
  }
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(of_month))};
  if (year < 1000 || !date.ok()) return {};
  text = rest;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Returns the seconds since midnight for a text that contains only a time of day.
std::optional<double> time_of_day_in(std::string_view text) {
  const auto found = three_numbers(text, ":");
  if (!found || (*found)[0] > 24 || (*found)[1] > 59 || (*found)[2] > 60) return {};
  double seconds = 3600. * (*found)[0] + 60. * (*found)[1] + (*found)[2];
  if (!text.empty() && (text[0] == '.' || text[0] == ',')) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", 1), text.size());
    seconds += pipeline::number_in("0." + std::string(text.substr(1, end - 1))).value_or(0);
    text.remove_prefix(end);
  }
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text.empty() || text == "Z") return seconds;
  const bool morning = text == "AM" || text == "am";
  if (morning || text == "PM" || text == "pm") return std::fmod(seconds, day / 2) + (morning ? 0 : day / 2);
  int hours = 0, minutes = 0;
  if (text[0] != '+' && text[0] != '-') return {};
  const char* const end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data() + 1, std::min(text.data() + 3, end), hours);
  if (error != std::errc()) return {};
  if (at < end && *at == ':') ++at;
  if (at < end && std::from_chars(at, end, minutes).ptr != end) return {};
  return seconds - (text[0] == '+' ? 1 : -1) * (3600. * hours + 60. * minutes);
}

}  // namespace

std::optional<double> LogTime::read(std::string_view text) {
  if (const auto number = pipeline::number_in(text); number && std::isfinite(*number)) {
    if (!unit_) unit_ = unit_of_clock(*number);
    form_ = Form::numbers;
    return *number * *unit_;
  }
  const auto date = date_in(text);
  if (date) {
    if (text.empty()) return {};
    text.remove_prefix(text[0] == 'T' || text[0] == 't' || text[0] == ' ' ? 1 : 0);
  }
  const auto time = time_of_day_in(text);
  if (!time) return {};
  form_ = date ? Form::dates : Form::times_of_day;
  if (date) return *date * day + *time;
  if (last_of_day_ && *time < *last_of_day_ - day / 2) days_ += day;
  last_of_day_ = time;
  return days_ + *time;
}

std::string LogTime::words() const {
  if (form_ != Form::numbers) return form_ == Form::dates ? "dates with times of day" : "times of day";
  const double seconds = unit_.value_or(1);
  for (const auto& [unit, name] :
       {std::pair{1., "s"}, {60., "min"}, {3600., "h"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}})
    if (std::abs(seconds / unit - 1) < 1e-9) return fmt::format("numbers in {}", name);
  return fmt::format("numbers in {:g} s", seconds);
}

}  // namespace dresslife::sim
