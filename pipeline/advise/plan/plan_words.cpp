#include "pipeline/advise/plan/plan_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/life/planning.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

const std::size_t width = screen_columns() - 2;

/// Returns "1 dresspack", "2.5 spare dresspacks".
std::string dresspacks_text(const std::string& number, const char* kind = "") {
  return fmt::format("{} {}dresspack{}", number, kind, number == "1" ? "" : "s");
}

/// Returns the text of an iCalendar property, folded into lines of at most 75 bytes.
std::string folded(std::string line) {
  std::string text;
  constexpr std::size_t most = 75;
  while (line.size() > most) {
    std::size_t end = most;
    while (end > 1 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80)
      --end;  // do not fold inside a UTF-8 character
    text += line.substr(0, end) + "\r\n";
    line = " " + line.substr(end);
  }
  return text + line + "\r\n";
}

std::string escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : shown(text)) {
    if (letter == '\\' || letter == ';' || letter == ',') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

/// Returns the names as a list: the first twenty, which take four lines, and the number of the others.
std::string names_text(std::vector<std::string> names, const char* where_others_are = "") {
  constexpr std::size_t most = 20;
  if (const std::size_t count = names.size(); count > most) {
    names.resize(most);
    names.push_back(fmt::format("and {} more{}", count - most, where_others_are));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns "replace 3; on average 1.2 of those put in after today". later: later_in(). day: first day of the plan.
std::string window_words(std::size_t count, double later, const std::string& day = "today") {
  if (count == 0 && later == 0) return "nothing to replace";
  const std::string today = count == 0 ? "none of today's dresspacks" : fmt::format("replace {}", count);
  return later == 0 ? today : fmt::format("{}; on average {} of those put in after {}", today, readable(later, 2), day);
}

std::string compact(Day day) {
  std::string text = day_text(day);
  std::erase(text, '-');
  return text;
}

/// Returns the title of a window's event. later: later_in().
std::string event_words(std::size_t count, double later, const std::string& day) {
  if (count == 0 && later == 0) return "No dresspack to replace";
  if (count == 0) return fmt::format("Replace on average {} dresspacks put in after {}", readable(later, 2), day);
  return fmt::format("Replace {} dresspack{}{}", count, count == 1 ? "" : "s",
                     later > 0 ? fmt::format(" and on average {} put in after {}", readable(later, 2), day) : "");
}

}  // namespace

std::vector<std::string> replaced_in(const Fleet& fleet, const Plan& plan, std::size_t window) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < fleet.rows.size(); ++i)
    if (plan.rows[i].window == window) names.push_back(fleet.rows[i].name);
  return names;
}

double later_in(const Plan& plan, std::size_t window) {
  constexpr double worth_a_word = 0.01;  // one dresspack in 100 simulated plants
  const double mean = window < plan.later_in_window.size() ? plan.later_in_window[window] : 0;
  return mean < worth_a_word ? 0 : mean;
}

std::string window_text(const Window& window) { return day_text(window.first) + " .. " + day_text(window.last); }

std::string percent_text(double share) { return readable(100 * share, 2) + " %"; }

std::string expected_words(const Plan& plan) {
  const double before = sum_of(plan.rows, &RowPlan::fails_before_first);
  constexpr double surprising = 0.023;  // one-sided probability of more than two standard deviations
  std::string alive;
  if (plan.all_alive < surprising)
    alive = fmt::format(
        " That all of them live today was unlikely by the model: 1 of {} such plants. This plan is of such plants alone. If a job or a "
        "date is wrong, correct it; dresslife calibrate learns from more records.",
        readable(1 / std::max(plan.all_alive, 1e-12), 2));
  return fmt::format("{} dresspack{}, from {} to {}. Before the first window {} of them are expected to fail.{}",
                     plan.rows.size(), plan.rows.size() == 1 ? "" : "s", day_text(plan.today), day_text(plan.end),
                     readable(before, 2), alive);
}

std::string kept_words(const Fleet& fleet, const Plan& plan) {
  std::vector<std::string> safe, no_better, costly;
  double most = 0, most_before = 0;
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    const RowPlan& row = plan.rows[i];
    if (row.window) continue;
    const double fails = *std::ranges::max_element(row.fails_until_next);
    (plan.by_cost ? costly : fails > plan.risk ? no_better : safe).push_back(fleet.rows[i].name);
    if (!plan.by_cost && fails <= plan.risk)
      most = std::max(most, fails), most_before = std::max(most_before, row.fails_before_first);
  }
  std::string text;
  const auto add = [&](const std::string& why, const std::vector<std::string>& names) {
    if (!names.empty()) text += wrapped(fmt::format("{}: {}.", why, names_text(names, " in the table")), width, "  ");
  };
  add(fmt::format(
          "Before the first window, when no replacement is planned, the probability of failure is at most {}. After that, "
          "until {}, the probability between two windows is at most {} (limit {})",
          percent_text(most_before), day_text(plan.end), percent_text(most), percent_text(plan.risk)),
      safe);
  add(fmt::format(
          "The probability of failure between two windows is above {}. A new dresspack fails as often or more often in this time",
          percent_text(plan.risk)),
      no_better);
  add("To keep them costs less, on average, than to replace them in one of these windows", costly);
  return text.empty() ? text : text + "  If one of them fails, it is replaced at once.\n";
}

std::string plan_words(const Fleet& fleet, const Plan& plan) {
  std::string text = wrapped(expected_words(plan), width, "");
  for (std::size_t n = 0; n < plan.windows.size(); ++n) {
    const std::vector<std::string> names = replaced_in(fleet, plan, n);
    const double later = later_in(plan, n);
    text += fmt::format("\n{}: {}\n", window_text(plan.windows[n]),
                        names.empty() ? window_words(0, later) : fmt::format("replace {}", names.size()));
    if (!names.empty()) text += wrapped(fmt::format("{}", fmt::join(names, ", ")), width, "  ");
    if (!names.empty() && later > 0)
      text += fmt::format("  On average also {} of those put in after today.\n", readable(later, 2));
  }
  const auto kept = std::ranges::count_if(plan.rows, [](const RowPlan& row) { return !row.window; });
  text += fmt::format("\nIn no window: {}\n{}", kept, kept_words(fleet, plan));
  std::vector<std::size_t> risky =
      largest_first(plan.rows.size(), [&](std::size_t i) { return plan.rows[i].fails_before; });
  risky.resize(std::min<std::size_t>(risky.size(), 10));
  const std::size_t wide =
      largest_of(risky, std::size_t{9}, [&](std::size_t i) { return columns_of(fleet.rows[i].name); });
  text += fmt::format("\n{:<{}}  {:>9}  {:>26}  {:>25}  {}\n", "most risk", wide, "age [h]",
                      "fails before first window", "fails before replacement", "replace");
  for (const std::size_t i : risky) {
    const RowPlan& row = plan.rows[i];
    text += fmt::format("{:<{}}  {:>9}  {:>26}  {:>25}  {}\n", fleet.rows[i].name, wide, readable(row.age_hours),
                        percent_text(row.fails_before_first), percent_text(row.fails_before),
                        row.window ? day_text(plan.windows[*row.window].first) : "in no window");
  }
  text += '\n';
  for (std::size_t y = 0; y < plan.years.size(); ++y) {
    const YearOfPlan& year = plan.years[y];
    text += fmt::format(
        "Year {} from today{}: {} ({:g} .. {:g} in 90 of 100 plants): {} planned, {} after failures, "
        "also of their replacements.\n",
        y + 1,
        plan.end < plan.today + std::chrono::days(365 * static_cast<int>(y + 1))
            ? ", until " + day_text(plan.end) + " only"
            : "",
        dresspacks_text(readable(year.planned + year.unplanned, 2), "spare "), std::floor(year.low),
        std::ceil(year.high), readable(year.planned, 2), readable(year.unplanned, 2));
  }
  if (fleet.has_costs)
    text += fmt::format("Cost until {}: {} by this plan, {} if only failed dresspacks are replaced.{}\n",
                        day_text(plan.end), readable(plan.cost), readable(plan.cost_without_windows),
                        later_saving_words(plan));
  return text;
}

std::string later_saving_words(const Plan& plan) {
  return plan.by_cost && plan.cost > plan.cost_without_windows
             ? " The plan saves only after this day, because its dresspacks are younger then."
             : "";
}

std::string test_words(const std::vector<TestValue>& tests, const Plan& plan) {
  constexpr double coin = 0.01;  // smaller amounts are not relevant in any currency
  constexpr std::size_t most = 3;
  std::string lines;
  std::size_t count = 0;
  for (const TestValue& test : tests) {
    if (!(test.saves > std::max(coin, least_saving * plan.cost))) break;
    if (!(test.saves > test.by_chance)) continue;
    if (++count > most) break;
    const UncertainParameter& parameter = uncertain_parameters()[test.what.parameter];
    lines += fmt::format("  {:>9}  {}: {}{}\n", readable(test.saves), parameter.test, parameter.name,
                         test.what.of.empty() ? "" : fmt::format(" of '{}'", test.what.of));
  }
  if (lines.empty())
    return "No test in a laboratory saves more than chance and more than a thousandth of the plan's cost.\n";
  return fmt::format(
      "A test before the first window saves, on average, until {} and by better replacements after that:\n{}",
      day_text(plan.end), lines);
}

std::string check_words(const std::optional<std::vector<CheckValue>>& checks, const Inspection& inspection,
                        const Fleet& fleet, const Plan& plan) {
  constexpr double worth_a_line = 1e-3;  // of the cost of one unplanned replacement
  constexpr std::size_t most = 3;
  if (!checks)
    return "By the predicted abrasion fewer than 1 in 1,000 such plants have all of these dresspacks alive today, so no value of "
           "visual checks is given.\n";
  double fails = 0, found = 0, saves = 0;
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < checks->size(); ++i) {
    const CheckValue& check = (*checks)[i];
    fails += check.fails, found += check.found, saves += check.regular;
    if (check.today > worth_a_line * fleet.rows[i].unplanned_cost) best.push_back(i);
  }
  std::ranges::stable_sort(best, [&](std::size_t a, std::size_t b) { return (*checks)[a].today > (*checks)[b].today; });
  std::string text =
      best.empty()
          ? "No visual check for abrasion today saves a thousandth of an unplanned replacement (not validated).\n"
          : "One visual check of a dresspack for abrasion today saves, on average (not validated, without other checks, not in the plan's cost):\n";
  for (std::size_t k = 0; k < std::min(most, best.size()); ++k)
    text += fmt::format("  {:>9}  {}\n", readable((*checks)[best[k]].today), fleet.rows[best[k]].name);
  if (best.size() > most) text += fmt::format("  {:>9}  more dresspacks in the table\n", best.size() - most);
  if (!(fails > 0)) return text;
  text += fmt::format("Without checks abrasion wears through {} until {}.\n", dresspacks_text(readable(fails, 2)),
                      day_text(plan.end));
  if (inspection.interval_weeks > 0)
    text += fmt::format("Checks every {:g} weeks find {} of these before and save {}.\n", inspection.interval_weeks,
                        readable(found, 2), readable(saves));
  return text;
}

std::string age_words(const Fleet& fleet, const Plan& plan, const std::map<std::string, std::vector<AgeLimit>>& limits,
                      const std::map<std::string, double>& week_hours) {
  struct Reached {
    std::vector<std::string> today, later;
  };
  std::map<std::string, Reached> by_mode;
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    const Installed& row = fleet.rows[i];
    const auto known = limits.find(row.duty);
    const auto usual = week_hours.find(row.duty);
    if (known == limits.end() || (!row.hours_per_week && usual == week_hours.end())) continue;
    const std::optional<std::size_t> window = plan.rows[i].window;
    const Day last = window ? plan.windows[*window].first : plan.end;
    const double weeks = static_cast<double>((last - plan.today).count()) / 7,
                 per_week = row.hours_per_week.value_or(usual == week_hours.end() ? 0 : usual->second),
                 until = weeks * per_week;
    for (const AgeLimit& limit : known->second) {
      const double age = worn_hours(row, plan.rows[i].age_hours, [&](const std::string& duty) {
        const auto of_duty = limits.find(duty);
        const AgeLimit* const same =
            of_duty == limits.end() ? nullptr : find_in(of_duty->second, &AgeLimit::mode, limit.mode);
        return same ? same->hours : std::numeric_limits<double>::infinity();
      });
      if (!(limit.hours <= age + until)) continue;
      // Most dresspacks whose wires fail before are replaced then.
      if (limit.hours > age && wires_live(plan.rows[i], limit.hours - age, per_week) < usual_reach) continue;
      Reached& reached = by_mode[limit.mode];
      (limit.hours <= age ? reached.today : reached.later).push_back(row.name);
    }
  }
  std::string text;
  for (const auto& [mode, reached] : by_mode) {
    std::string line =
        fmt::format("Not validated and not in this plan: {}. At these ages 1 of 10 dresspacks has failed by it.", mode);
    if (!reached.today.empty()) line += fmt::format(" Inspect now: {}.", names_text(reached.today));
    if (!reached.later.empty())
      line += fmt::format(" They reach this age before they are replaced: {}.", names_text(reached.later));
    text += line + '\n';
  }
  return text;
}

std::vector<BesideRow> beside_rows(const Fleet& fleet, const Plan& plan, const Fleet& changed, const Plan& other) {
  std::vector<BesideRow> rows;
  constexpr double rounding = 1e-9;  // relative; sums over the rows of a table depend on their order
  // digits: 0: the number is a count.
  const auto add = [&](const std::string& what, double now, double then, int digits, const std::string& now_range = "",
                       const std::string& then_range = "") {
    const auto text = [&](double value) {
      return digits == 0 ? fmt::format("{:.0f}", value) : readable(value, digits);
    };
    rows.push_back({what, text(now) + now_range, text(then) + then_range,
                    std::abs(then - now) <= rounding * std::max(std::abs(now), std::abs(then))
                        ? "0"
                        : (then > now ? "+ " : "- ") + text(std::abs(then - now))});
  };
  const auto before_first = [](const Plan& of) { return sum_of(of.rows, &RowPlan::fails_before_first); };
  const auto failures = [](const Plan& of) { return sum_of(of.years, &YearOfPlan::unplanned); };
  const auto range = [](const YearOfPlan& year) {
    return fmt::format(" ({:g} .. {:g})", std::floor(year.low), std::ceil(year.high));
  };
  add("dresspacks", double(plan.rows.size()), double(other.rows.size()), 0);
  add("fail before the first window", before_first(plan), before_first(other), 2);
  add("failures until " + day_text(plan.end), failures(plan), failures(other), 2);
  for (std::size_t n = 0; n < plan.windows.size(); ++n) {
    add("today's replaced from " + day_text(plan.windows[n].first), double(replaced_in(fleet, plan, n).size()),
        double(replaced_in(changed, other, n).size()), 0);
    if (const double now = later_in(plan, n), then = later_in(other, n); now > 0 || then > 0)
      add("put in after today, on average", now, then, 2);
  }
  for (std::size_t y = 0; y < std::min(plan.years.size(), other.years.size()); ++y) {
    const YearOfPlan &now = plan.years[y], &then = other.years[y];
    add(fmt::format("spare dresspacks in year {}", y + 1), now.planned + now.unplanned, then.planned + then.unplanned,
        2, range(now), range(then));
  }
  if (fleet.has_costs) {
    add("cost until " + day_text(plan.end), plan.cost, other.cost, 3);
    add("cost if only failures are replaced", plan.cost_without_windows, other.cost_without_windows, 3);
  }
  return rows;
}

std::string what_if_words(const std::string& name, const Fleet& fleet, const Plan& plan, const Fleet& changed,
                          const Plan& other) {
  std::string text = fmt::format("What if {} were the fleet\n{:<34}  {:>20}  {:>20}  {:>12}\n", name, "",
                                 "today's fleet", "what if", "difference");
  for (const BesideRow& row : beside_rows(fleet, plan, changed, other))
    text += fmt::format("{:<34}  {:>20}  {:>20}  {:>12}\n", row.what, row.now, row.then, row.more);
  const auto when = [](const Plan& of, std::size_t i) {
    return of.rows[i].window ? "from " + day_text(of.windows[*of.rows[i].window].first) : std::string("in no window");
  };
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < changed.rows.size(); ++i) {
    const Installed* const old = find_in(fleet.rows, &Installed::name, changed.rows[i].name);
    const std::string now = old ? "today's fleet: " + when(plan, static_cast<std::size_t>(old - fleet.rows.data()))
                                : "not in today's fleet";
    if (!old || now != "today's fleet: " + when(other, i))
      changes.push_back(fmt::format("{}: {} ({})", changed.rows[i].name, when(other, i), now));
  }
  text += fmt::format("Replaced at another time than in the plan of today's fleet: {}\n",
                      changes.empty() ? "none" : std::to_string(changes.size()));
  if (!changes.empty()) text += wrapped(fmt::format("{}", fmt::join(changes, ", ")), width, "  ");
  const bool other_duty = std::ranges::any_of(changed.rows, [&](const Installed& row) {
    const Installed* const old = find_in(fleet.rows, &Installed::name, row.name);
    return old && old->since == row.since && old->duty != row.duty;
  });
  if (other_duty)
    text += wrapped(
        "A dresspack that survived its duty has shown that it withstands this duty, not that it withstands another one. So "
        "even a milder duty can have more failures at first.",
        width, "");
  return text;
}

CsvTable plan_table(const Fleet& fleet, const Plan& plan, const std::optional<std::vector<CheckValue>>& checks) {
  CsvTable table{{{"name", true},
                  {"duty", true},
                  {"installed", true},
                  {"age_hours"},
                  {"fails_before_first_window"},
                  {"replace_in", true},
                  {"fails_before_replacement"}}};
  for (const Window& window : plan.windows) table.columns.push_back({"fails_after_" + day_text(window.first)});
  for (const char* title : {"check_today_saves", "checks_save"}) table.columns.push_back({title});
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    const RowPlan& row = plan.rows[i];
    std::vector<std::string>& cells = table.rows.emplace_back(
        std::vector{fleet.rows[i].name, fleet.rows[i].duty, day_text(fleet.rows[i].since), shortest_text(row.age_hours),
                    shortest_text(row.fails_before_first), row.window ? day_text(plan.windows[*row.window].first) : "",
                    shortest_text(row.fails_before)});
    for (const double share : row.fails_until_next) cells.push_back(shortest_text(share));
    cells.push_back(checks ? shortest_text((*checks)[i].today) : "");
    cells.push_back(checks ? shortest_text((*checks)[i].regular) : "");
  }
  return table;
}

std::string plan_weeks_csv(const Fleet& fleet, const Plan& plan) {
  std::string text = "name";
  for (std::size_t week = 0; week < plan.failures_in_week.size(); ++week)
    text += fmt::format(",fails_in_week_of_{}", day_text(plan.today + std::chrono::days(7 * static_cast<int>(week))));
  text += '\n';
  for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
    text += csv_cell(fleet.rows[i].name);
    for (const double share : plan.rows[i].fails_in_week) text += "," + shortest_text(share);
    text += '\n';
  }
  return text;
}

std::string plan_calendar(const Fleet& fleet, const Plan& plan) {
  std::string text = "BEGIN:VCALENDAR\r\nPRODID:-//dresslife//plan//EN\r\nVERSION:2.0\r\n";
  // A calendar replaces an event by an event with the same UID. The UID identifies the plant, so the next plan replaces the
  // events.
  const Installed& first = fleet.rows.front();
  const std::string plant = xxh3(std::filesystem::path(first.where.file).stem().string() + "\n" + first.name);
  for (std::size_t n = 0; n < plan.windows.size(); ++n) {
    // A window without replacements also has an event, which replaces the event of an earlier plan.
    const std::vector<std::string> names = replaced_in(fleet, plan, n);
    const Window& window = plan.windows[n];
    text += "BEGIN:VEVENT\r\n";
    text += fmt::format("UID:{}-{}@dresslife\r\nDTSTAMP:{}T000000Z\r\n", compact(window.first), plant.substr(0, 16),
                        compact(plan.today));
    text +=
        fmt::format("DTSTART;VALUE=DATE:{}\r\nDTEND;VALUE=DATE:{}\r\n", compact(window.first),
                    compact(window.last + std::chrono::days(1)));  // in iCalendar the end is the day after the last day
    const double later = later_in(plan, n);
    text += folded("SUMMARY:" + escaped(event_words(names.size(), later, day_text(plan.today))));
    text += folded("DESCRIPTION:" +
                   escaped((names.empty() ? expected_words(plan) : fmt::format("{}", fmt::join(names, ", "))) +
                           (later > 0 ? fmt::format("{} In this window: {}.", names.empty() ? "" : ".",
                                                    window_words(names.size(), later, day_text(plan.today)))
                                      : "")));
    text += "END:VEVENT\r\n";
  }
  return text + "END:VCALENDAR\r\n";
}

}  // namespace dresslife::pipeline
