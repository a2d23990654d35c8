#include "sim/recording/log_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <numbers>

#include "pipeline/base/joined.h"
#include "sim/program/axis_names.h"

namespace dresslife::sim {
namespace {

using pipeline::CsvCell;
using pipeline::InputError;

/// Points of a word in favour of the measured position of an axis; every other word has -2 points.
const std::map<std::string, int, std::less<>> weights{
    {"actual", 4}, {"act", 4},      {"ist", 4},   {"meas", 4},   {"measured", 4}, {"position", 2}, {"positions", 2},
    {"pos", 2},    {"q", 2},        {"angle", 2}, {"angles", 2}, {"joint", 1},    {"joints", 1},   {"axis", 1},
    {"achse", 1},  {"j", 1},        {"a", 1},     {"winkel", 2}, {"robot", 0},    {"rob", 0},      {"field", 0},
    {"states", 0}, {"state", 0},    {"deg", 0},   {"rad", 0},    {"degrees", 0},  {"radians", 0},  {"target", -3},
    {"soll", -3},  {"command", -3}, {"cmd", -3}};

struct Group {
  int score = 0;
  std::vector<std::string> words;
  std::map<int, std::size_t> columns;  // (number in the name) column

  /// Returns the first `count` columns, if they are numbered from 0 or 1 without a gap.
  std::vector<std::size_t> first(std::size_t count) const {
    std::vector<std::size_t> found;
    if (columns.empty() || columns.begin()->first > 1) return found;
    for (const auto& [number, column] : columns)
      if (number == columns.begin()->first + static_cast<int>(found.size()) && found.size() < count)
        found.push_back(column);
    if (found.size() < count) found.clear();
    return found;
  }
};

/// Replaces "°" in Latin-1 or UTF-8, if the name contains it.
std::string with_words(std::string name) {
  for (const char* sign : {"\xC2\xB0", "\xB0"})
    for (std::size_t at = name.find(sign); at != name.npos; at = name.find(sign))
      name.replace(at, std::string_view(sign).size(), " deg ");
  return name;
}

std::map<std::string, Group> groups_of(const std::vector<std::string>& titles) {
  std::map<std::string, Group> groups;
  for (std::size_t k = 0; k < titles.size(); ++k) {
    std::vector<std::string> words = words_of_name(titles[k]);
    const auto number =
        std::find_if(words.rbegin(), words.rend(), [](const auto& w) { return w[0] >= '0' && w[0] <= '9'; });
    if (number == words.rend() || number->size() > 2) continue;
    const int value = std::stoi(*number);
    words.erase(std::next(number).base());
    Group& group = groups[pipeline::joined(words, " ")];
    group.columns.emplace(value, k);
    group.words = words;
    group.score = 0;
    for (const std::string& word : words) {
      const auto known = weights.find(word);
      group.score += known == weights.end() ? -2 : known->second;
    }
  }
  return groups;
}

}  // namespace

LogColumns log_columns(const pipeline::CsvReader& log, const pipeline::CsvRow& cells, std::size_t axes,
                       const std::string& joints) {
  LogColumns made;
  std::vector<std::string> titles;
  for (const CsvCell& cell : cells) titles.push_back(with_words(cell.text));
  const pipeline::Where where = log.where(cells.front());
  if (std::ranges::all_of(cells, [](const CsvCell& cell) { return pipeline::number_in(cell.text).has_value(); }))
    throw InputError(where, "the log begins with numbers", "put a line of names first: time,axis_1_deg,axis_2_deg, ..");
  const std::vector<ColumnName> kinds = column_names(titles);
  for (std::size_t k = 0; k < titles.size(); ++k) {
    const std::vector<std::string> words = words_of_name(titles[k]);
    const ColumnName& read = kinds[k];
    const bool date = words == std::vector<std::string>{"date"} || words == std::vector<std::string>{"datum"};
    if (date && !made.date) made.date = k;
    const auto is_any_of = [](const std::string& word, std::initializer_list<std::string_view> known) {
      return std::ranges::find(known, word) != known.end();
    };
    const bool stamp =
        read.kind == ColumnName::Kind::time ||
        (!words.empty() && is_any_of(words.back(), {"ts", "timestamp", "datetime", "zeitstempel", "uhrzeit"})) ||
        (words.size() == 2 && is_any_of(words[0], {"date", "datum", "time"}) &&
         is_any_of(words[1], {"time", "zeit", "stamp"}));
    if (stamp && !date && !made.time) {
      made.time = k;
      if (read.unit_told) made.seconds = read.seconds;
    }
  }
  const std::map<std::string, Group> groups = groups_of(titles);
  const Group* best = nullptr;
  bool tie = false;
  const auto refuse = [&](const std::string& what) {
    throw InputError(where, fmt::format("{} (columns: {})", what, pipeline::joined(titles, ", ")),
                     "give --value joints=NAME,NAME,.. in the order of the robot's axes");
  };
  if (!joints.empty()) {
    const auto order = order_of_axes(titles, with_words(joints));
    if (!order || order->size() != axes) refuse(fmt::format("joints does not name {} columns of the log", axes));
    made.axes = *order;
  } else {
    for (const auto& [stem, group] : groups) {
      if (group.first(axes).empty() || kinds[group.columns.begin()->second].kind != ColumnName::Kind::axis) continue;
      if (best && group.score <= best->score) {
        tie |= group.score == best->score;
        continue;
      }
      best = &group;
      tie = false;
    }
    if (tie) refuse(fmt::format("several groups of {} columns may be the angles of the axes", axes));
    if (best) {
      made.axes = best->first(axes);
      // in rostopic's format field.position0 belongs to field.name0
      for (const auto& [stem, group] : groups)
        if (!group.words.empty() && group.words.back() == "name" && best->words.back() == "position")
          made.names = group.first(axes);
    } else {
      std::vector<std::string> names;
      std::vector<std::size_t> at;
      for (std::size_t k = 0; k < titles.size(); ++k)
        if (k != made.time && k != made.date && kinds[k].kind == ColumnName::Kind::axis)
          names.push_back(titles[k]), at.push_back(k);
      const auto order = names.size() == axes ? order_of_axes(names, "") : std::nullopt;
      if (!order) refuse(fmt::format("the log has no {} columns that are the angles of the robot's axes", axes));
      for (const std::size_t k : *order) made.axes.push_back(at[k]);
    }
  }
  for (const std::size_t k : made.axes) {
    const ColumnName::Unit unit = kinds[k].unit;
    if (unit != ColumnName::Unit::unknown)
      made.radians = unit == ColumnName::Unit::radians ? 1 : std::numbers::pi / 180;
  }
  // q of RTDE and position of ROS are in rad
  if (!made.radians && best && (best->words.back() == "q" || !made.names.empty())) made.radians = 1;
  return made;
}

}  // namespace dresslife::sim
