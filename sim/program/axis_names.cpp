#include "sim/program/axis_names.h"

#include <algorithm>
#include <array>

#include "pipeline/base/order.h"
#include "pipeline/base/text.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return c >= 'a' && c <= 'z'; }

template <std::size_t n>
bool among(const std::string& word, const std::array<std::string_view, n>& list) {
  return std::ranges::find(list, word) != list.end();
}

constexpr std::array<std::string_view, 9> times{"time", "t",       "timestamp", "stamp", "sec",
                                                "secs", "seconds", "clock",     "zeit"};
constexpr std::array<std::string_view, 5> coordinates{"x", "y", "z", "tcp", "pose"};
constexpr std::array<std::string_view, 32> others{
    "velocity", "velocities",  "vel",     "speed", "acceleration", "accelerations", "acc",    "accel",
    "effort",   "efforts",     "torque",  "trq",   "current",      "gripper",       "finger", "force",
    "seq",      "frame",       "id",      "index", "line",         "step",          "row",    "name",
    "temp",     "temperature", "voltage", "error", "digital",      "status",        "mode",   "jerk"};

/// Returns whether the name contains the sign of 1e-6, which is no letter of words_of_name(): the micro sign or a Greek mu in UTF-8, or
/// the micro sign in Latin-1.
bool has_micro(std::string_view name) {
  return name.find("\xC2\xB5") != name.npos || name.find("\xCE\xBC") != name.npos || name.find("\xB5s") != name.npos;
}

/// Returns the axis number of every name: its last or first number; empty: a name has none, or they are not consecutive.
std::vector<int> numbers_of(const std::vector<std::string>& names, bool last) {
  std::vector<int> numbers;
  for (const std::string& name : names) {
    std::vector<std::string> words = words_of_name(name);
    std::erase_if(words, [](const std::string& w) { return !digit(w[0]) || w.size() > 3; });
    if (words.empty()) return {};
    numbers.push_back(std::stoi(last ? words.back() : words.front()));
  }
  std::vector<int> sorted = numbers;
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] != sorted[i - 1] + 1) return {};
  return numbers;
}

std::vector<std::size_t> sorted_by(const std::vector<int>& numbers) {
  return pipeline::smallest_first(numbers.size(), [&](std::size_t k) { return numbers[k]; });
}

/// Returns the index of the name that contains each of an arm's words; std::nullopt: not exactly one name per word.
std::optional<std::vector<std::size_t>> order_by(const std::vector<std::string>& names,
                                                 const std::vector<std::vector<std::string>>& arm) {
  if (names.size() != arm.size()) return {};
  std::vector<std::size_t> order;
  for (const std::vector<std::string>& wanted : arm) {
    std::size_t found = names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::vector<std::string> words = words_of_name(names[i]);
      const bool fits =
          std::ranges::all_of(wanted, [&](const std::string& w) { return std::ranges::find(words, w) != words.end(); });
      if (!fits) continue;
      if (found < names.size()) return {};
      found = i;
    }
    if (found == names.size() || std::ranges::find(order, found) != order.end()) return {};
    order.push_back(found);
  }
  return order;
}

/// Returns the index of T among Yaskawa's axes S, L, U, R, B, T; names.size(): the names are others.
std::size_t axis_t(const std::vector<std::string>& names) {
  const auto last_of = [&](const char* axis) {
    std::size_t found = names.size();
    for (std::size_t k = 0; k < names.size(); ++k)
      if (const auto words = words_of_name(names[k]); !words.empty() && words[0] == axis) found = k;
    return found;
  };
  for (const char* axis : {"s", "l", "u", "r", "b"})
    if (last_of(axis) == names.size()) return names.size();
  return last_of("t");
}

}  // namespace

std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words;
  char before = ' ';
  for (char c : lower_case(name)) {
    const bool part = digit(c) || letter(c);
    if (part && ((digit(c) && digit(before)) || (letter(c) && letter(before))))
      words.back() += c;
    else if (part)
      words.emplace_back(1, c);
    before = c;
  }
  return words;
}

namespace {

ColumnName column_name(std::string_view name, bool may_be_time) {
  ColumnName made;
  const std::vector<std::string> words = words_of_name(name);
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  if (has("rad") || has("radian") || has("radians")) made.unit = ColumnName::Unit::radians;
  if (has("deg") || has("degree") || has("degrees") || name.find("\xC2\xB0") != std::string_view::npos)
    made.unit = ColumnName::Unit::degrees;
  const bool any_other = std::ranges::any_of(words, [](const auto& w) { return among(w, others); });
  const bool coordinate = std::ranges::any_of(words, [](const auto& w) { return among(w, coordinates); });
  if (may_be_time && !words.empty() &&
      (among(words[0], times) || (words.size() > 1 && words.back() == "time") || name == "%time")) {
    made.kind = ColumnName::Kind::time;
    made.unit_told = has("s") || has("sec") || has("secs") || has("seconds");
    if (has("h") || has("hour") || has("hours")) made.seconds = 3600;
    if (has("min") || has("mins") || has("minute") || has("minutes")) made.seconds = 60;
    if (has("ms") || has("msec") || has("millis") || has("milliseconds")) made.seconds = 1e-3;
    if (has("us") || has("usec") || has("micros") || has("microseconds") || has_micro(name)) made.seconds = 1e-6;
    if (has("ns") || has("nsec") || has("nanoseconds") || name == "%time") made.seconds = 1e-9;
    made.unit_told |= made.seconds != 1;
  } else if (has("mm") || has("cm") || has("m") || has("meter") || has("meters")) {
    made.kind = ColumnName::Kind::point;
  } else if (any_other || words.empty()) {
    made.kind = ColumnName::Kind::other;
  } else if (has("stamp")) {  // of a ROS header, in addition to %time
    made.kind = ColumnName::Kind::other;
  } else if (coordinate) {
    made.kind = ColumnName::Kind::point;
  }
  return made;
}

}  // namespace

std::vector<ColumnName> column_names(const std::vector<std::string>& names) {
  const std::size_t axis = axis_t(names);
  std::vector<ColumnName> made;
  for (std::size_t k = 0; k < names.size(); ++k) made.push_back(column_name(names[k], k != axis));
  return made;
}

double unit_of_clock(double time) {
  constexpr double first = 9e11;  // [ms] 1998; recordings of robots are later
  double unit = 1;
  for (double digits = first; time > digits && unit > 1e-9; digits *= 1e3) unit *= 1e-3;
  return unit;
}

std::optional<std::vector<std::size_t>> order_of_axes(const std::vector<std::string>& names,
                                                      const std::string& wanted) {
  if (!wanted.empty()) {
    std::vector<std::size_t> order;
    const auto without_blanks = [](std::string text) {
      std::erase(text, ' ');
      return text;
    };
    for (const std::string& part : pipeline::parts_between(wanted, ",")) {
      const std::string name = without_blanks(part);
      const auto found =
          std::ranges::find_if(names, [&](const std::string& n) { return same_word(without_blanks(n), name); });
      if (found == names.end()) return {};
      order.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    std::vector<std::size_t> sorted = order;
    std::ranges::sort(sorted);
    const bool twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    return twice ? std::nullopt : std::optional(order);
  }
  if (names.size() == 1) return std::vector<std::size_t>{0};
  if (auto order = order_by(
          names,
          {{"shoulder", "pan"}, {"shoulder", "lift"}, {"elbow"}, {"wrist", "1"}, {"wrist", "2"}, {"wrist", "3"}}))
    return order;
  if (auto order = order_by(names, {{"s"}, {"l"}, {"u"}, {"r"}, {"b"}, {"t"}})) return order;
  for (bool last : {true, false})
    if (const std::vector<int> numbers = numbers_of(names, last); !numbers.empty()) return sorted_by(numbers);
  return {};
}

}  // namespace dresslife::sim
