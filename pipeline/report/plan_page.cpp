#include "pipeline/report/plan_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/joined.h"
#include "pipeline/base/order.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/table_page.h"

namespace dresslife::pipeline {
namespace {

constexpr double plan_width = 960, plan_names = 190, plan_right = 14;
constexpr std::size_t most_rows = 40;      // rows of the calendar: more do not fit on a sheet
constexpr std::size_t most_columns = 130;  // columns of the calendar: narrower cells are invisible

/// Lower limits of a cell's probability, with the class of its shade.
constexpr std::array shades{std::pair(1e-4, "p1"), std::pair(1e-3, "p2"), std::pair(1e-2, "p3"), std::pair(1e-1, "p4")};
constexpr const char* shade_rules =
    "<style>svg .p1 { fill: var(--hot); fill-opacity: .12; } svg .p2 { fill: var(--hot); fill-opacity: .3; } "
    "svg .p3 { fill: var(--hot); fill-opacity: .6; } svg .p4 { fill: var(--hot); } "
    "svg .window { fill: var(--blue); fill-opacity: .16; } svg .new { fill: var(--band); } svg .under { fill: var(--page); }</style>\n";

const char* shade_of(double probability) {
  const char* shade = nullptr;
  for (const auto& [from, name] : shades)
    if (probability >= from) shade = name;
  return shade;
}

/// Returns the dresspacks in order of falling risk.
std::vector<std::size_t> by_risk(const Plan& plan) {
  return largest_first(plan.rows.size(), [&](std::size_t k) { return plan.rows[k].fails_before; });
}

/// A picture over the days of the plan.
class Calendar {
 public:
  Calendar(const Fleet& fleet, const Plan& plan) : fleet_(fleet), plan_(plan) {
    order_ = by_risk(plan);
    order_.resize(std::min(order_.size(), most_rows));
    const std::size_t weeks = plan.failures_in_week.size();
    weeks_per_cell_ = (weeks + most_columns - 1) / most_columns;
  }
  std::size_t weeks_per_cell() const { return weeks_per_cell_; }

  std::string svg() const {
    const double bottom = first_row + row_height * double(order_.size());
    Picture picture(
        plan_width, bottom + 50, "Calendar",
        "Probability of failure of each dresspack over the weeks of the plan, its windows and replacements.");
    for (const Window& window : plan_.windows)
      picture.box(x(window.first), top, std::max(2.0, x(window.last + std::chrono::days(1)) - x(window.first)),
                  bottom - top, "window", window_text(window));
    failures(picture);
    for (std::size_t i = 0; i < order_.size(); ++i) row(picture, order_[i], first_row + row_height * double(i));
    months(picture, bottom);
    legend(picture, bottom + 30);
    return picture.svg();
  }

 private:
  static constexpr double top = 8, strip = 90, first_row = top + strip + 16, row_height = 15;

  double x(Day day) const {
    const double share = double((day - plan_.today).count()) / double((plan_.end - plan_.today).count());
    return plan_names + (plan_width - plan_names - plan_right) * std::clamp(share, 0.0, 1.0);
  }
  Day week(std::size_t number) const { return plan_.today + std::chrono::days(7 * static_cast<int>(number)); }

  /// Draws the expected failures of all dresspacks: with the plan, and without it.
  void failures(Picture& picture) const {
    std::vector<double> by_plan, without;
    for (std::size_t k = 0; k < plan_.failures_in_week.size(); ++k) {
      // The last week may be shorter: 1 day or, with a year of 365.2425 days behind the window, less.
      const double part = std::max(1.0, double((std::min(plan_.end, week(k + 1)) - week(k)).count())) / 7;
      by_plan.push_back(plan_.failures_in_week[k] / part);
      without.push_back(plan_.failures_in_week_without_windows[k] / part);
    }
    const double most = std::max(*std::ranges::max_element(by_plan), *std::ranges::max_element(without));
    if (!(most > 0)) return;
    const Panel panel{plan_names, top, plan_width - plan_names - plan_right,
                      strip,      {},  linear_axis("failures a week", 0, most, 4)};
    for (const Tick& tick : panel.y.ticks(3)) {
      picture.line(panel.left, panel.down(tick.value), panel.right(), panel.down(tick.value), "grid");
      picture.text(panel.left - 6, panel.down(tick.value) + 4, tick.label, "tick", Picture::Anchor::end);
    }
    picture.text(panel.left - 52, top + 14, "failures a week", "name", Picture::Anchor::end);
    picture.text(panel.left - 52, top + 32, "without the plan", "tick", Picture::Anchor::end);
    for (const auto& [values, style] : {std::pair(&without, "curve-hot"), std::pair(&by_plan, "curve")}) {
      std::vector<std::pair<double, double>> stairs;
      for (std::size_t k = 0; k < values->size(); ++k)
        for (const std::size_t end : {k, k + 1}) stairs.emplace_back(x(week(end)), panel.down((*values)[k]));
      picture.curve(stairs, style);
    }
    picture.line(panel.left - 48, top + 10, panel.left - 34, top + 10, "curve");
    picture.line(panel.left - 48, top + 28, panel.left - 34, top + 28, "curve-hot");
  }

  void row(Picture& picture, std::size_t i, double y) const {
    const RowPlan& plan = plan_.rows[i];
    const std::string& name = fleet_.rows[i].name;
    picture.text(plan_names - 8, y + row_height - 4, name, "name", Picture::Anchor::end, plan_names - 12);
    const Day end = plan.window ? plan_.windows[*plan.window].first : plan_.end;
    // The shades are translucent. Without this box they would look darker in a window.
    picture.box(x(plan_.today), y + 1, x(end) - x(plan_.today), row_height - 2, "under", name);
    for (std::size_t k = 0; k < plan.fails_in_week.size() && week(k) < end; k += weeks_per_cell_) {
      double fails = 0;
      const std::size_t behind = std::min(k + weeks_per_cell_, plan.fails_in_week.size());
      for (std::size_t of = k; of < behind; ++of) fails += plan.fails_in_week[of];
      if (const char* const shade = shade_of(fails / double(behind - k)))
        picture.box(x(week(k)), y + 1, x(std::min(end, week(behind))) - x(week(k)), row_height - 2, shade,
                    fmt::format("{}, {} .. {}: fails with {}", name, day_text(week(k)),
                                day_text(std::min(end, week(behind)) - std::chrono::days(1)), percent_text(fails)));
    }
    if (!plan.window) return;
    picture.box(x(end), y + 1, x(plan_.end) - x(end), row_height - 2, "new", name + ": a new dresspack");
    picture.dot(x(end) + 4, y + row_height / 2, 4, "dot", fmt::format("replace {} on {}", name, day_text(end)));
  }

  void months(Picture& picture, double bottom) const {
    picture.line(plan_names, bottom, plan_width - plan_right, bottom, "mark");
    const std::chrono::year_month_day today(plan_.today);
    double free = plan_names;
    for (std::chrono::year_month month = today.year() / today.month() + std::chrono::months(1);
         Day(month / 1) < plan_.end; month += std::chrono::months(1)) {
      const double at = x(Day(month / 1));
      picture.line(at, bottom, at, bottom + 4, "mark");
      const std::string words = day_text(Day(month / 1)).substr(0, 7);
      if (at < free || at + text_width(words) / 2 > plan_width) continue;
      picture.text(at, bottom + 17, words, "tick", Picture::Anchor::middle);
      free = at + text_width(words) + 8;
    }
  }

  static void legend(Picture& picture, double y) {
    double at = plan_names;
    const auto entry = [&](const char* style, const std::string& words) {
      picture.box(at, y, 14, 11, style);
      picture.text(at + 19, y + 10, words, "tick");
      at += 19 + text_width(words) + 14;
    };
    for (const auto& [from, style] : shades) entry(style, fmt::format("{:g} % a week", 100 * from));
    entry("window", "window");
    entry("dot", "replace");
    entry("new", "new dresspack");
  }

  const Fleet& fleet_;
  const Plan& plan_;
  std::vector<std::size_t> order_;
  std::size_t weeks_per_cell_ = 1;
};

std::string beside_table(const PlanNotes& notes) {
  std::string rows;
  for (const BesideRow& row : notes.beside)
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
        row.what, row.now, row.then, row.more);
  return "<h3>Beside today's fleet</h3>\n" +
         wide_table({"", "#" + escaped(notes.today), "#what if", "#difference"}, rows);
}

std::string windows_table(const Fleet& fleet, const Plan& plan) {
  std::string rows;
  for (std::size_t n = 0; n < plan.windows.size(); ++n) {
    const std::vector<std::string> replaced = replaced_in(fleet, plan, n);
    const double later = later_in(plan, n);
    rows += fmt::format(
        "<tr><td style=\"white-space: nowrap\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td>{}</td></tr>\n",
        window_text(plan.windows[n]), replaced.size(), later > 0 ? printed(later, 2) : "0",
        !replaced.empty() ? escaped(joined(replaced, ", "))
        : later > 0       ? "none of today's dresspacks"
                          : "nothing to replace");
  }
  return "<h3>What to replace</h3>\n" +
         wide_table({"window", "#today's dresspacks", "#put in after today, on average", "names"}, rows);
}

std::string years_table(const Fleet& fleet, const Plan& plan) {
  std::string rows;
  for (std::size_t y = 0; y < plan.years.size(); ++y) {
    const YearOfPlan& year = plan.years[y];
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{:g} .. {:g}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
        y + 1, printed(year.planned + year.unplanned, 2), std::floor(year.low), std::ceil(year.high),
        printed(year.planned, 2), printed(year.unplanned, 2));
  }
  std::string text =
      "<h3>Spare dresspacks</h3>\n" +
      wide_table({"year from today", "#expected", "#in 90 of 100 plants", "#planned", "#after failures"}, rows);
  if (fleet.has_costs)
    text += fmt::format("<p>Cost until {}: <b>{}</b> by this plan, {} if only failed dresspacks are replaced.{}</p>\n",
                        day_text(plan.end), printed(plan.cost), printed(plan.cost_without_windows),
                        later_saving_words(plan));
  return text;
}

std::string dresspacks_table(const Fleet& fleet, const Plan& plan, const std::string& table) {
  std::string heads =
      "<th>risk</th><th>dresspack</th><th>duty</th><th>installed</th><th class=\"number\">age [h]</th><th class=\"number\">fails before first "
      "window</th><th>replace</th><th class=\"number\">fails before replacement</th>";
  for (const Window& window : plan.windows)
    heads += fmt::format("<th class=\"number\">fails between {} and next</th>", day_text(window.first));
  std::vector<std::string> rows;
  for (const std::size_t i : by_risk(plan)) {
    const RowPlan& row = plan.rows[i];
    const auto percent = [](double share) { return number_cell(share, percent_text(share)); };
    std::string cells = fmt::format(
        "<tr data-rank=\"{0}\"><td class=\"number\" data-value=\"{0}\">{0}</td><td>{1}</td><td>{2}</td><td style=\"white-space: nowrap\">{3}</td>{4}{5}<td style=\"white-space: nowrap\">{6}</td>{7}",
        rows.size() + 1, escaped(fleet.rows[i].name), escaped(fleet.rows[i].duty), day_text(fleet.rows[i].since),
        number_cell(row.age_hours, printed(row.age_hours)), percent(row.fails_before_first),
        row.window ? day_text(plan.windows[*row.window].first) : "in no window", percent(row.fails_before));
    for (const double share : row.fails_until_next) cells += percent(share);
    rows.push_back(cells + "</tr>\n");
  }
  return "<h3>All dresspacks</h3>\n<p class=\"soft\">A click on a head sorts. Probabilities between windows hold for a dresspack that lives "
         "at the first and is not replaced. The file " +
         escaped(table) +
         " has commas between its columns and decimal points: a spreadsheet that expects others imports it as text with these.</p>\n" +
         sorted_table(heads, rows, "dresspacks", table);
}

}  // namespace

std::string plan_page(const std::string& name, const Fleet& fleet, const Plan& plan, const PlanNotes& notes,
                      const std::string& table) {
  const Calendar calendar(fleet, plan);
  std::string body = shade_rules;
  for (const std::string& doubt : notes.doubts) body += "<p><b>" + escaped(doubt) + "</b></p>\n";
  body += "<p>" + escaped(expected_words(plan)) + "</p>\n" + (notes.beside.empty() ? "" : beside_table(notes)) +
          windows_table(fleet, plan);
  if (const std::string kept = kept_words(fleet, plan); !kept.empty())
    body += "<p class=\"soft\">" + escaped("In no window. " + kept) + "</p>\n";
  if (!notes.values.empty()) body += "<p style=\"white-space: pre-wrap\">" + escaped(notes.values) + "</p>\n";
  for (const std::string& note : notes.paragraphs) body += "<p class=\"soft\">" + escaped(note) + "</p>\n";
  body += fmt::format(
      "<h3>Calendar</h3>\n<p class=\"soft\">Above: expected failures of all dresspacks in a week; those of dresspacks that are put in later are counted in simulated plants. Below: {}. Colour: the probability that today's dresspack "
      "fails in a week. {}Rest the pointer on a cell for its number.</p>\n",
      plan.rows.size() > most_rows ? fmt::format("the {} dresspacks with the greatest risk", most_rows)
                                   : "each dresspack, the greatest risk first",
      calendar.weeks_per_cell() > 1
          ? fmt::format("A cell is {} weeks, its colour their mean. ", calendar.weeks_per_cell())
          : "");
  body += chart_in_page(calendar.svg()) + years_table(fleet, plan) + dresspacks_table(fleet, plan, table);
  return table_page((notes.beside.empty() ? "Plan: " : "What if: ") + name,
                    notes.beside.empty()
                        ? fmt::format("{}: which dresspacks to replace, and when", name)
                        : fmt::format("What if {} were the fleet: which dresspacks to replace, and when, beside {}",
                                      name, notes.today),
                    body);
}

}  // namespace dresslife::pipeline
