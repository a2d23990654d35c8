// The dresspacks of a plant, one per row of a CSV file, and the windows in which they can be replaced.
//
//   name,duty,installed,hours_per_week,planned_cost,unplanned_cost
//   robot 17,two variants,2026-03-02,,1200,9500
//
// `duty` names an entry of a file of duties (duty.h). An empty `installed` means today; an empty `hours_per_week` means the value
// of the duty. Costs have any unit, the same in all rows; both columns may be absent.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/days.h"
#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

struct Installed {
  Where where;
  std::string name, duty;
  Day since{};
  std::optional<double> hours_per_week;
  double planned_cost = 0, unplanned_cost = 0;
  /// hours of operation so far, under any duty; absent: hours per week since the date of installation
  std::optional<double> run_hours{};
  struct Spell {
    std::string duty;
    double hours = 0;  ///< hours of operation
  };
  /// hours under other duties, past or future, before its own duty begins (add_histories(), keep_ages())
  std::vector<Spell> before{};
  struct Change {
    double day = 0;            ///< [days from today]
    double hours_per_day = 0;  ///< hours of operation until that day, under the duty of the last spell
  };
  bool undated = false;            ///< the cell of the date is empty: installed today
  std::optional<Change> change{};  ///< set if its duty begins later than today (keep_ages())
};

struct Fleet {
  std::vector<Installed> rows;
  bool has_costs = false;
  std::vector<std::string> unused;      ///< titles of columns that a plan does not need
  std::vector<std::string> renamed{};   ///< "installed = 'Einbaudatum'": columns under another title
  std::vector<std::size_t> comments{};  ///< lines that begin with # and otherwise are rows
};

/// Reads a fleet. Titles may have any capitals, and blanks for underscores. Errors: InputError with line and column, for all rows
/// together: a missing column, two equal names, text that is no date, a date after `today`, an unplanned cost that is not above
/// the planned cost.
Fleet read_fleet(const std::filesystem::path& file, Day today);

/// A period in which dresspacks can be replaced. The plan replaces them on its first day.
struct Window {
  Day first, last;
};
/// Reads "2027-07-12..2027-08-01,2027-12-20..2028-01-02". Errors: InputError for other text, for windows that are not in order,
/// and for a window that begins before today or ends more than ten years later.
std::vector<Window> windows_from(const std::string& text, Day today);

}  // namespace dresslife::pipeline
