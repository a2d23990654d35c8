// The dresspacks of a plant, one per row of a CSV file, and the windows in which they can be replaced.
//
//   name,duty,installed,hours_per_week,planned_cost,unplanned_cost
//   robot 17,two variants,2026-03-02,,1200,9500
//
// `duty` names an entry of a file of duties (duty.h). An empty `installed` means today, an empty `hours_per_week` that of
// the duty. Costs have any unit, the same in all rows; both columns may be absent.
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
  std::optional<double> run_hours{};  ///< of operation so far, under any duty; absent: at its hours per week since then
  struct Spell {
    std::string duty;
    double hours = 0;  ///< of operation
  };
  std::vector<Spell> before{};  ///< under other duties, past or still to come, until its own counts (add_histories(), keep_ages())
  struct Change {
    double day = 0;            ///< [days from today]
    double hours_per_day = 0;  ///< of operation until then, under the duty of the last spell
  };
  std::optional<Change> change{};  ///< its duty begins later than today (keep_ages())
};

struct Fleet {
  std::vector<Installed> rows;
  bool has_costs = false;
  std::vector<std::string> unused;  ///< titles of columns that a plan does not need
};

/// Titles in any capitals. Errors: InputError at line and column, all rows' at once: a missing column, two equal names, a date that is none or after `today`, an
/// unplanned cost that is not above the planned one.
Fleet read_fleet(const std::filesystem::path& file, Day today);

/// A time in which dresspacks can be replaced. They are replaced on its first day.
struct Window {
  Day first, last;
};
/// "2027-07-12..2027-08-01,2027-12-20..2028-01-02". Errors: InputError for what is none, for windows that are not in order,
/// and for one that begins before today or ends more than ten years later.
std::vector<Window> windows_from(const std::string& text, Day today);

}  // namespace dresslife::pipeline
