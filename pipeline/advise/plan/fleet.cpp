#include "pipeline/advise/plan/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {
namespace {

constexpr std::chrono::days longest_plan{3653};  // duties and robots change earlier

/// Access to the cells of a row by the titles of the columns.
class Row {
 public:
  Row(const CsvReader& table, const CsvRow& titles, const CsvRow& row) : table_(table) {
    check_width(table, titles, row);
    for (std::size_t k = 0; k < row.size(); ++k) cells_[titles[k].text] = &row[k];
  }
  Where where(const std::string& title) const { return table_.where(*cells_.at(title)); }
  /// Returns an empty text if the column or the cell is empty.
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
      throw InputError(where(title), fmt::format("{} is '{}' (must be {:g} .. {:g})", title, text(title), low, high),
                       value ? fmt::format("give a number of {:g} .. {:g}", low, high) : number_remedy(text(title)));
    return value;
  }
  /// Returns an amount of money. A point before three digits may be a thousands separator. Precondition: the cell is not empty.
  double cost(const std::string& title) const {
    constexpr double most = 1e12;
    const std::string cell = text(title);
    const std::size_t point = cell.find('.');
    if (point != cell.npos && point >= 1 && point <= 3 && cell.size() == point + 4 && cell[0] != '0' &&
        exported_number(cell))
      throw InputError(
          where(title), fmt::format("{} is '{}', in which the point may separate thousands", title, cell),
          fmt::format("write {} or {:g}", cell.substr(0, point) + cell.substr(point + 1), *exported_number(cell)));
    return *number(title, 0, most);
  }

 private:
  const CsvReader& table_;
  std::map<std::string, const CsvCell*> cells_;
};

Day installed_on(const Row& row, Day today) {
  const std::string date = row.text("installed");
  if (date.empty()) return today;
  const std::optional<Day> day = exported_day(date);
  if (!day && exported_day(row.text("duty")))
    throw InputError(row.where("installed"),
                     fmt::format("'{}' is no date, and duty is the date {}", date, row.text("duty")),
                     "exchange the titles 'duty' and 'installed'");
  if (!day) throw InputError(row.where("installed"), fmt::format("'{}' is no date", date), day_remedy(date));
  if (*day > today)
    throw InputError(row.where("installed"),
                     fmt::format("'{}' was installed after today, {}", row.text("name"), day_text(today)),
                     "correct the date, or give --today");
  return *day;
}

Installed installed_from(const Row& row, Day today, bool has_costs, Problems& problems) {
  Installed one;
  one.where = row.where("name");
  const auto attempt = [&](const char* title, const auto& act) { return problems.attempt("", row.where(title), act); };
  attempt("name", [&] { one.name = row.needed("name"); });
  attempt("duty", [&] { one.duty = row.needed("duty"); });
  attempt("installed", [&] { one.since = installed_on(row, today), one.undated = row.text("installed").empty(); });
  attempt("name", [&] { one.hours_per_week = row.number("hours_per_week", 0.1, 168); });
  if (!has_costs) return one;
  const auto cost = [&](const char* title, double& value) {
    return attempt(title, [&] { row.needed(title), value = row.cost(title); });
  };
  const bool planned = cost("planned_cost", one.planned_cost), unplanned = cost("unplanned_cost", one.unplanned_cost);
  if (planned && unplanned && !(one.unplanned_cost > one.planned_cost))
    problems.add(
        row.where("unplanned_cost"),
        fmt::format("an unplanned replacement costs {:g}, a planned one {:g}", one.unplanned_cost, one.planned_cost),
        "unplanned_cost must be larger; else no plan saves anything");
  return one;
}

/// A column of a fleet's table.
struct Column {
  std::string name;
  std::vector<std::string_view> titles;  ///< other titles, as letters_of() returns them
};
const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"name", {"robot", "robotname", "roboter", "dresspack", "schlauchpaket"}},
      {"duty", {"aufgabe", "einsatz", "einsatzprofil"}},
      {"installed", titles_of_installation()},
      {"hours_per_week", titles_of_weekly_hours()},
      {"planned_cost", {"plannedcosts", "costplanned", "kostengeplant", "geplantekosten", "plankosten"}},
      {"unplanned_cost", {"unplannedcosts", "costunplanned", "kostenungeplant", "ungeplantekosten", "ausfallkosten"}},
  };
  return all;
}

/// Replaces other titles of columns that the table does not have under their own names. written: the titles in the file.
void rename_titles(const CsvReader& reader, const CsvRow& written, CsvRow& titles, std::vector<std::string>& renamed) {
  for (const Column& column : columns()) {
    if (find_in(titles, &CsvCell::text, column.name)) continue;
    const CsvCell* first = nullptr;
    for (std::size_t k = 0; k < titles.size(); ++k) {
      if (std::ranges::find(column.titles, letters_of(written[k].text)) == column.titles.end()) continue;
      if (first)
        throw InputError(reader.where(written[k]),
                         fmt::format("columns '{}' and '{}' both mean {}", first->text, written[k].text, column.name),
                         fmt::format("title one of them {}", column.name));
      first = &written[k], titles[k].text = column.name;
      renamed.push_back(fmt::format("{} = '{}'", column.name, first->text));
    }
  }
}

/// Returns whether a title resembles a known column, so that ignoring the column might change the plan.
bool may_be_known(const std::string& title) {
  return std::ranges::any_of(std::initializer_list<std::string_view>{"hour", "stunde", "week", "woche", "cost",
                                                                     "kosten", "instal", "date", "datum"},
                             [&](std::string_view word) { return title.find(word) != title.npos; });
}

/// Whether the title may name hours of operation since the installation.
bool counts_hours(const std::string& title) {
  return (title.find("hour") != title.npos || title.find("stunde") != title.npos) && title.find("week") == title.npos &&
         title.find("woche") == title.npos;
}

/// Whether the title names the day on which a dresspack was taken out.
bool says_removed(const std::string& title) {
  return std::ranges::any_of(
      std::initializer_list<std::string_view>{"replace", "remov", "ausbau", "ausgebaut", "ersetzt", "gewechselt"},
      [&](std::string_view word) { return title.starts_with(word); });
}

/// Returns the lines below the titles that begin with # and have as many cells as the titles.
std::vector<std::size_t> commented_rows(const std::string& text, const CsvRow& titles, char separator) {
  std::vector<std::size_t> lines;
  std::istringstream in(text);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);)
    if (++number > static_cast<std::size_t>(titles.front().line) && trimmed(line).starts_with('#') &&
        std::ranges::count(line, separator) + 1 == std::ssize(titles))
      lines.push_back(number);
  return lines;
}

Day needed_day(const std::string& text) {
  const bool two = text.size() > 11 && exported_day(text.substr(0, 10)) && exported_day(text.substr(text.size() - 10));
  if (const std::optional<Day> day = exported_day(text); day && !two) return *day;
  throw InputError(
      {"--windows"}, fmt::format("'{}' is no date", text),
      two ? fmt::format("write {}..{}", text.substr(0, 10), text.substr(text.size() - 10)) : day_remedy(text));
}

}  // namespace

Fleet read_fleet(const std::filesystem::path& file, Day today) {
  const std::string text = read_text(file);
  check_utf8(text, file.string());
  CsvReader reader(text, file.string());
  CsvRow titles = reader.next();
  if (titles.empty())
    throw InputError({file.string(), 1, 1}, "holds no table",
                     "write the line 'name,duty,installed', then a row per dresspack");
  const std::vector<std::string> known = mapped(columns(), &Column::name);
  Fleet fleet;
  const CsvRow written = titles;
  for (CsvCell& title : titles)
    std::ranges::transform(title.text, title.text.begin(),
                           [](unsigned char letter) { return letter == ' ' ? '_' : std::tolower(letter); });
  rename_titles(reader, written, titles, fleet.renamed);
  const auto has = [&](const std::string& title) {
    return std::ranges::any_of(titles, [&](const CsvCell& cell) { return cell.text == title; });
  };
  std::vector<std::string> missing = known;
  std::erase_if(missing, has);
  for (std::size_t k = 0; k < titles.size(); ++k) {
    const std::string& title = titles[k].text;
    if (title.empty() || std::ranges::find(known, title) != known.end()) continue;
    const std::string near = nearest_word(title, missing);
    if (!near.empty() || (!missing.empty() && may_be_known(title)))
      throw InputError(reader.where(titles[k]), fmt::format("unknown column '{}'", written[k].text),
                       !near.empty() ? fmt::format("did you mean '{}'?", near)
                       : counts_hours(title)
                           ? "for an hour counter give hours_per_week: its hours divided by the weeks since 'installed'"
                           : fmt::format("columns: {}", joined(known, ", ")));
    fleet.unused.push_back(written[k].text);
  }
  check_titles(reader, titles, {"name", "duty", "installed"});
  fleet.has_costs = has("planned_cost") || has("unplanned_cost");
  if (fleet.has_costs) check_titles(reader, titles, {"planned_cost", "unplanned_cost"});
  std::map<std::string, int> lines;
  Problems problems;
  for (CsvRow row = reader.next(); !row.empty(); row = reader.next()) {
    const Where where = reader.where(row.front());
    for (std::size_t k = 0; k < std::min(row.size(), titles.size()); ++k)
      if (says_removed(titles[k].text) && exported_day(row[k].text))
        problems.add(reader.where(row[k]),
                     fmt::format("a dresspack that is in use no more ({}: {})", written[k].text, row[k].text),
                     "remove its row; dresslife calibrate learns from such rows");
    problems.attempt("", where, [&] {
      fleet.rows.push_back(installed_from(Row(reader, titles, row), today, fleet.has_costs, problems));
      const std::string& name = fleet.rows.back().name;
      if (const auto [same, is_new] = lines.try_emplace(name, reader.line()); !is_new && !name.empty())
        throw InputError(where, fmt::format("'{}' is the name of line {}, too", name, same->second),
                         "give each dresspack a name of its own");
    });
  }
  fleet.comments = commented_rows(text, titles, reader.separator());
  problems.finish(file.string());
  if (fleet.rows.empty()) throw InputError({file.string(), 1, 1}, "has titles and no row", "write a row per dresspack");
  return fleet;
}

std::vector<Window> windows_from(const std::string& text, Day today) {
  std::vector<Window> windows;
  for (const std::string& one : parts_between(text, ",")) {
    const std::size_t dots = one.find("..");
    const auto day_in = [](std::string_view part) { return needed_day(std::string(trimmed(part))); };
    const Day first = day_in(std::string_view(one).substr(0, dots));
    windows.push_back({first, dots == std::string::npos ? first : day_in(std::string_view(one).substr(dots + 2))});
    const Day before = windows.size() > 1 ? windows[windows.size() - 2].last : today;
    if (windows.back().last < first)
      throw InputError({"--windows"}, fmt::format("'{}' ends before it begins", one), "exchange its two dates");
    if (first <= before)
      throw InputError({"--windows"},
                       fmt::format("'{}' does not begin after {}, which is {}", one, day_text(before),
                                   windows.size() > 1 ? "in the window before it" : "today"),
                       windows.size() > 1 ? "give windows in order, and two that overlap as one"
                                          : "give windows after today, or another --today");
    if (windows.back().last > today + longest_plan)
      throw InputError({"--windows"}, fmt::format("'{}' is more than ten years ahead", one), "give nearer windows");
  }
  return windows;
}

}  // namespace dresslife::pipeline
