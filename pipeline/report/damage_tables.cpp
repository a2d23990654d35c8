#include "pipeline/report/damage_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"
#include "pipeline/study/mode_table.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t listed_lines = 10, listed_layers = 12;

/// Returns a share with a bar, which has full length for the largest share of the table.
std::string meter(double share, double largest) {
  return fmt::format(
      "<span class=\"metered\"><span class=\"meter\"><span style=\"width:{:.1f}%\"></span></span>{:.1f} %</span>",
      100 * share / largest, 100 * share);
}

/// Returns the indices of the largest values above 0.
std::vector<std::size_t> largest_above_zero(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> order = largest_first(values);
  std::erase_if(order, [&](std::size_t i) { return !(values[i] > 0); });
  if (order.size() > most) order.resize(most);
  return order;
}

/// Returns the joints that cause most of a line's damage: "joint 5 60 %, joint 6 31 %".
std::string main_causes(const LifeSummary& life, std::size_t line) {
  constexpr std::size_t most_named = 2;
  constexpr double least_named = 0.1;
  const std::size_t causes = life.cause.size();
  if (causes == 0 || !(life.step_damage[line] > 0)) return "";
  const auto first = life.line_cause_damage.begin() + static_cast<std::ptrdiff_t>(line * causes);
  const std::vector<double> of_line(first, first + static_cast<std::ptrdiff_t>(causes));
  std::string text;
  for (const std::size_t cause : largest_above_zero(of_line, most_named)) {
    const double share = of_line[cause] / life.step_damage[line];
    if (share < least_named && !text.empty()) break;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", escaped(life.cause[cause]), 100 * share);
  }
  return text;
}

/// Returns the table of the joints that moved between opening and closing of the worst wire's cycles.
std::string cause_table(const LifeSummary& life) {
  const double total = sum_of(life.cause_damage);
  if (!(total > 0)) return "";
  const double largest = *std::ranges::max_element(life.cause_damage);
  std::string rows;
  for (std::size_t cause = 0; cause < life.cause.size(); ++cause) {
    const double damage = life.cause_damage[cause];
    const bool last = cause + 1 == life.cause.size();
    if (damage == 0 && !last) continue;
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td></tr>\n",
        last ? "carrying: gravity, swinging, and what the joints do not explain" : escaped(life.cause[cause]),
        damage < 0 ? fmt::format("{:.1f} %{}", 100 * damage / total, last ? "" : ": moves against the others, relieves")
                   : meter(damage / total, largest / total));
  }
  return fmt::format(
      "<h3>What moved while the damage was done: a correlation</h3>\n<p class=\"soft\">Damage of the worst wire by the "
      "joints "
      "that move the two clamps against each other, by how much each changed the wire's strain while a cycle "
      "ran. This is no cause: motion.hold_joint tries what a joint costs. {} % of the strain's variance follows from these joints{}.</p>\n{}",
      printed(100 * life.explained), life.explained < 0.8 ? ": the shares are rough" : "",
      wide_table({"moved", "share of the damage"}, rows));
}

/// Returns, (line), half of the damage of the cycles that a line opens plus half of the damage of those that it closes.
std::vector<double> damage_of_lines(const LifeSummary& life) {
  std::vector<double> damage = life.step_damage;
  for (std::size_t line = 0; line < life.step_opened.size(); ++line)
    damage[line] = (damage[line] + life.step_opened[line]) / 2;
  return damage;
}

std::string program_table(const LifeSummary& life) {
  constexpr double least_listed = 5e-4;  // share of the damage that rounds to 0.1 %
  const std::vector<double> damage = damage_of_lines(life);
  const double total = sum_of(damage);
  const std::vector<ProgramRun> runs = program_runs(life);
  const auto share = [&](const std::vector<double>& of, std::size_t line) {
    return of.empty() ? "" : fmt::format("{:.1f} %", 100 * of[line] / total);
  };
  std::string rows;
  double largest = 0;
  for (const std::size_t line : largest_above_zero(damage, listed_lines)) {
    largest = std::max(largest, damage[line]);
    if (damage[line] < least_listed * total) break;
    const LineRuns of = runs_of(line, runs);
    rows += fmt::format(
        "<tr><td class=\"number\">{}</td><td>{}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td><td "
        "class=\"number\">{}</td><td class=\"number\">{}</td><td>{}</td><td class=\"number\">{}</td></tr>\n",
        line + 1, escaped(life.step_text[line]), of.times,
        of.costliest ? fmt::format("{:.1f} .. {:.1f}&nbsp;s", of.costliest->begin, of.costliest->end) : "",
        meter(damage[line] / total, largest / total), share(life.step_opened, line), share(life.step_damage, line),
        main_causes(life, line), printed(damage[line]));
  }
  if (rows.empty()) return "";
  return "<h3>Program lines that cost most</h3>\n<p class=\"soft\">It takes two lines to make a cycle of "
         "strain: "
         "one in which it opens and one in which its range is reached. Each is blamed for half of its "
         "damage.</p>\n" +
         wide_table({"#line", "program", "#runs", "costliest at", "share of the damage", "#opened here",
                     "#reached here", "reached mostly by", "#damage per repeat"},
                    rows);
}

std::string layer_table(const LifeSummary& life, const RankingRow& row) {
  std::string rows;
  for (const std::size_t i : largest_above_zero(life.layer_damage, listed_layers)) {
    const double repeats = 1 / life.layer_damage[i];
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td></tr>\n",
        escaped(life.layer[i]), printed(row.hours_of(repeats)), printed(repeats), printed(life.layer_damage[i]));
  }
  if (rows.empty()) return "";
  return "<h3>Life by layer of wires</h3>\n" +
         wide_table({"layer", "#life [h]", "#repeats", "#damage per repeat"}, rows);
}

std::string place_remark(const LifeSummary& life) {
  std::string text = "Of the worst wire in each segment; 1 means broken after one repeat.";
  const double share = nearly_worst_share(life);
  if (share > 0.5)
    text += fmt::format(
        " On {:.0f} % of the length it is within a fifth of the worst, as when cables slip freely from clamp "
        "to clamp: "
        "do not expect the break in one place.",
        100 * share);
  const double total = sum_of(life.clamp_damage);
  std::string shares;
  for (std::size_t k = 0; total > 0 && k < life.clamps.size(); ++k)
    shares += fmt::format("{}{} {:.0f} %", shares.empty() ? " By the nearest clamp: " : "; ", escaped(life.clamps[k]),
                          100 * life.clamp_damage[k] / total);
  return shares.empty() ? text : text + shares + ".";
}

}  // namespace

std::string chart_section(const std::string& heading, const std::string& remark, const std::string& chart) {
  if (chart.empty()) return "";
  return fmt::format("<h3>{}</h3>\n<p class=\"soft\">{}</p>\n{}", heading, remark, chart_in_page(chart));
}

std::string failure_table(const RankingRow& row) {
  if (row.unvalidated.empty()) return "";
  std::string rows;
  for (const ModeLine& line : mode_lines(row)) {
    rows += "<tr><td>" + escaped(line.mode) + "</td>";
    const auto& [tenth, half, most] = line.hours;
    for (const std::string& number : {tenth, half, most, line.before_wires, line.with_it, line.from_tool, line.time})
      rows += "<td class=\"number\">" + escaped(number) + "</td>";
    rows += fmt::format("<td>{}{}<span class=\"soft\">{}</span></td></tr>\n", escaped(line.step),
                        line.step.empty() ? "" : "<br>", escaped(line.note));
  }
  return "<div class=\"wide\"><table class=\"modes\">\n<thead><tr><th>fails by</th><th class=\"number\">10 % [h]</th>"
         "<th class=\"number\">half [h]</th><th class=\"number\">90 % [h]</th><th class=\"number\">before the wires</th><th class=\"number\">replace after, with it [h]</th>"
         "<th class=\"number\">from tool [m]</th><th class=\"number\">at [s]</th><th>during</th></tr></thead>\n<tbody>\n" +
         rows +
         "</tbody></table></div>\n<p class=\"soft\">† No test confirms the law of this mode: 'replace after' leaves it out. h: hours of "
         "motion until so many of such dresspacks have failed by it." +
         cell_legend(mode_lines(row)) + "</p>\n";
}

std::string damage_along(const LifeSummary& life, const RankingRow& row) {
  const std::string along = row.worst_dresspack.empty() ? "the dresspack" : "the " + escaped(row.worst_dresspack);
  return chart_section("Damage along " + along, place_remark(life), segment_chart(life, row.worst_segment_from_tool));
}

std::string damage_tables(const LifeSummary& life, const RankingRow& row) {
  return program_table(life) + cause_table(life) + layer_table(life, row);
}

}  // namespace dresslife::pipeline
