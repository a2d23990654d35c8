#include "pipeline/advise/plan/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

constexpr std::chrono::days longest_plan{3653};  // duties and robots change sooner

/// A row by the titles of its columns.
class Row {
 public:
  Row(const CsvReader& table, const CsvRow& titles, const CsvRow& row) : table_(table) {
    if (row.size() != titles.size())
      throw InputError(table.where(row.back()),
                       fmt::format("a row of {} cells (the table has {} columns)", row.size(), titles.size()),
                       "fill or quote its cells");
    for (std::size_t k = 0; k < row.size(); ++k) cells_[titles[k].text] = &row[k];
  }
  Where where(const std::string& title) const { return table_.where(*cells_.at(title)); }
  /// Empty: no such column, or an empty cell.
  std::string text(const std::string& title) const {
    const auto found = cells_.find(title);
    return found == cells_.end() ? "" : found->second->text;
  }
  std::string needed(const std::string& title) const {
    if (text(title).empty()) throw InputError(where(title), fmt::format("{} is empty", title), "fill the cell");
    return text(title);
  }
  std::optional<double> number(const std::string& title, double low, double high) const {
    if (text(title).empty()) return std::nullopt;
    const std::optional<double> value = exported_number(text(title));
    if (!value || !(*value >= low && *value <= high))
      throw InputError(
          where(title), fmt::format("{} is '{}' (must be {:g} .. {:g})", title, text(title), low, high),
          value ? fmt::format("give a number of {:g} .. {:g}", low, high) : number_remedy(text(title)));
    return value;
  }
  /// Money. A point before three digits may separate thousands. Precondition: not empty.
  double cost(const std::string& title) const {
    constexpr double most = 1e12;
    const std::string cell = text(title);
    const std::size_t point = cell.find('.');
    if (point != cell.npos && point >= 1 && point <= 3 && cell.size() == point + 4 && cell[0] != '0' && exported_number(cell))
      throw InputError(where(title), fmt::format("{} is '{}', in which the point may separate thousands", title, cell),
                       fmt::format("write {} or {:g}", cell.substr(0, point) + cell.substr(point + 1), *exported_number(cell)));
    return *number(title, 0, most);
  }

 private:
  const CsvReader& table_;
  std::map<std::string, const CsvCell*> cells_;
};

/// Its place; the size of the text: there is none. Spreadsheets save letters beyond ASCII as Windows-1252, which no page and calendar shows.
std::size_t first_no_utf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t length = byte < 0x80 ? 1 : byte < 0xC2 ? 0 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : byte < 0xF5 ? 4 : 0;
    if (length == 0) return at;
    for (std::size_t k = 1; k < length; ++k)
      if (at + k >= text.size() || (static_cast<unsigned char>(text[at + k]) & 0xC0) != 0x80) return at;
    at += length;
  }
  return text.size();
}

Installed installed_from(const Row& row, Day today, bool has_costs) {
  Installed one{row.where("name"), row.needed("name"), row.needed("duty"), today, row.number("hours_per_week", 0.1, 168), 0, 0};
  if (const std::string date = row.text("installed"); !date.empty()) {
    const std::optional<Day> day = exported_day(date);
    if (!day && exported_day(one.duty))
      throw InputError(row.where("installed"),
                       fmt::format("'{}' is no date, and duty is the date {}", date, one.duty),
                       "exchange the titles 'duty' and 'installed'");
    if (!day)
      throw InputError(row.where("installed"), fmt::format("'{}' is no date", date), day_remedy(date));
    if (*day > today)
      throw InputError(row.where("installed"), fmt::format("'{}' was installed after today, {}", one.name, day_text(today)),
                       "correct the date, or give --today");
    one.since = *day;
  }
  if (!has_costs) return one;
  row.needed("planned_cost"), row.needed("unplanned_cost");
  one.planned_cost = row.cost("planned_cost"), one.unplanned_cost = row.cost("unplanned_cost");
  if (!(one.unplanned_cost > one.planned_cost))
    throw InputError(row.where("unplanned_cost"),
                     fmt::format("an unplanned replacement costs {:g}, a planned one {:g}", one.unplanned_cost, one.planned_cost),
                     "unplanned_cost must be larger; else no plan saves anything");
  return one;
}

Day needed_day(const std::string& text) {
  const bool two = text.size() > 11 && exported_day(text.substr(0, 10)) && exported_day(text.substr(text.size() - 10));
  if (const std::optional<Day> day = exported_day(text); day && !two) return *day;
  throw InputError({"--windows"}, fmt::format("'{}' is no date", text),
                   two ? fmt::format("write {}..{}", text.substr(0, 10), text.substr(text.size() - 10)) : day_remedy(text));
}

}  // namespace

Fleet read_fleet(const std::filesystem::path& file, Day today) {
  const std::string text = read_text(file);
  if (const std::size_t at = std::min(first_no_utf8(text), text.find('\0')); at < text.size())  // each letter of UTF-16 has a 0
    throw InputError({file.string(), 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n')), 0},
                     "is no text in UTF-8", "save the table as CSV UTF-8");
  CsvReader reader(text, file.string());
  const CsvRow titles = reader.next();
  if (titles.empty())
    throw InputError({file.string(), 1, 1}, "holds no table",
                     "write the line 'name,duty,installed', then a row per dresspack");
  const std::vector<std::string> known{"name", "duty", "installed", "hours_per_week", "planned_cost", "unplanned_cost"};
  const auto has = [&](const std::string& title) {
    return std::any_of(titles.begin(), titles.end(), [&](const CsvCell& cell) { return cell.text == title; });
  };
  for (const CsvCell& title : titles)
    if (!title.text.empty() && std::find(known.begin(), known.end(), title.text) == known.end()) {
      const std::string near = nearest_word(title.text, known);
      throw InputError(reader.where(title), fmt::format("unknown column '{}'", title.text),
                       near.empty()
                           ? "columns: name, duty, installed, hours_per_week, planned_cost, unplanned_cost"
                           : fmt::format("did you mean '{}'?", near));
    }
  check_titles(reader, titles, {"name", "duty", "installed"});
  Fleet fleet;
  fleet.has_costs = has("planned_cost") || has("unplanned_cost");
  if (fleet.has_costs) check_titles(reader, titles, {"planned_cost", "unplanned_cost"});
  std::map<std::string, int> lines;
  for (CsvRow row = reader.next(); !row.empty(); row = reader.next()) {
    fleet.rows.push_back(installed_from(Row(reader, titles, row), today, fleet.has_costs));
    const auto [same, is_new] = lines.try_emplace(fleet.rows.back().name, reader.line());
    if (!is_new)
      throw InputError(reader.where(row.front()), fmt::format("'{}' is the name of line {}, too", same->first, same->second),
                       "give each dresspack a name of its own");
  }
  if (fleet.rows.empty()) throw InputError({file.string(), 1, 1}, "has titles and no row", "write a row per dresspack");
  return fleet;
}

std::vector<Window> windows_from(const std::string& text, Day today) {
  std::vector<Window> windows;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    const std::size_t dots = one.find("..");
    const Day first = needed_day(one.substr(0, dots));
    windows.push_back({first, dots == std::string::npos ? first : needed_day(one.substr(dots + 2))});
    const Day before = windows.size() > 1 ? windows[windows.size() - 2].last : today;
    if (windows.back().last < first)
      throw InputError({"--windows"}, fmt::format("'{}' ends before it begins", one),
                       "exchange its two dates");
    if (first <= before)
      throw InputError({"--windows"},
                       fmt::format("'{}' does not begin after {}, which is {}", one, day_text(before),
                                   windows.size() > 1 ? "in the window before it" : "today"),
                       "give windows after today, in order");
    if (windows.back().last > today + longest_plan)
      throw InputError({"--windows"}, fmt::format("'{}' is more than ten years ahead", one), "give nearer windows");
    begin = end + 1;
  }
  return windows;
}

}  // namespace dresslife::pipeline
