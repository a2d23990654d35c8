#include "pipeline/report/duty_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/table_page.h"

namespace dresslife::pipeline {
namespace {

constexpr double duty_width = 960, duty_names = 190, duty_row = 40;

/// Returns a chart with two bars per program: its share of the time, and of the damage.
std::string shares_chart(const DutyResult& duty) {
  constexpr double top = 8, legend = 300;
  const double height = duty_row * double(duty.parts.size());
  const Panel panel{duty_names, top, duty_width - duty_names - 60, height, linear_axis("share [%]", 0, 100), {}};
  Picture picture(duty_width, panel.bottom() + 44, "Shares", "Share of the time and of the damage of each program.");
  panel.draw_upright_grid(picture);
  picture.box(panel.right() - legend, panel.bottom() + 27, 14, 10, "dark");
  picture.text(panel.right() - legend + 20, panel.bottom() + 36, "of the time", "tick");
  picture.box(panel.right() - legend / 2, panel.bottom() + 27, 14, 10, "bar-hot");
  picture.text(panel.right() - legend / 2 + 20, panel.bottom() + 36, "of the damage", "tick");
  for (std::size_t k = 0; k < duty.parts.size(); ++k) {
    const double y = top + duty_row * double(k), time = 100 * duty.parts[k].share_of_time,
                 damage = 100 * duty.lives.share[k];
    picture.text(duty_names - 8, y + duty_row / 2 + 4, duty.parts[k].job, "name", Picture::Anchor::end,
                 duty_names - 12);
    picture.box(panel.left, y + 5, panel.across(time) - panel.left, 14, "dark");
    picture.text(panel.across(time) + 5, y + 16, fmt::format("{:.1f} %", time), "tick");
    picture.box(panel.left, y + 20, panel.across(damage) - panel.left, 14, "bar-hot");
    picture.text(panel.across(damage) + 5, y + 31, fmt::format("{:.1f} %", damage), "tick");
  }
  return picture.svg();
}

/// Returns a chart of lives over the time share of one program. The horizontal line is the robot's life.
std::string life_chart(const DutyResult& duty, const DutyPart& part) {
  constexpr double chart = 460, height = 250;
  double low = duty.robot_life_hours, high = low;
  for (const LifeAtShare& at : part.over_share)
    for (const std::size_t p : {0, 1})
      if (std::isfinite(at.hours[p])) low = std::min(low, at.hours[p]), high = std::max(high, at.hours[p]);
  high = std::min(high, 1e3 * duty.robot_life_hours);  // longer lives are not relevant for a plan
  const Panel panel{84,
                    10,
                    chart - 104,
                    height - 70,
                    linear_axis("share of the time [%]", 0, 100 * part.over_share.back().share_of_time),
                    decades_axis("life [h]", low * 0.999, high)};
  Picture picture(chart, height, part.job,
                  "Hours until 1 of 10 and half have failed, over the share of the time of this program.");
  panel.draw_axes(picture);
  picture.line(panel.left, panel.down(duty.robot_life_hours), panel.right(), panel.down(duty.robot_life_hours),
               "leader");
  for (const auto& [p, style, words] : {std::tuple(0, "curve-hot", "1 of 10"), std::tuple(1, "curve", "half")}) {
    std::vector<std::pair<double, double>> points;
    for (const LifeAtShare& at : part.over_share)
      if (at.hours[std::size_t(p)] <= panel.y.high)
        points.emplace_back(panel.across(100 * at.share_of_time), panel.down(at.hours[std::size_t(p)]));
    picture.curve(points, style);
    for (const LifeAtShare& at : part.over_share)
      if (at.hours[std::size_t(p)] <= panel.y.high)
        picture.dot(panel.across(100 * at.share_of_time), panel.down(at.hours[std::size_t(p)]), 2.5,
                    p ? "dot" : "bar-hot",
                    fmt::format("{:.1f} % of the time: {} have failed after {}", 100 * at.share_of_time, words,
                                printed_hours(at.hours[std::size_t(p)])));
  }
  const double today = panel.across(100 * part.share_of_time);
  picture.line(today, panel.top, today, panel.bottom(), "mark");
  return picture.svg();
}

std::string section(const DutyResult& duty) {
  std::string text = fmt::format("<h3>{}</h3>\n<p><b>{}</b> {}</p>\n", escaped(duty.name), escaped(duty_action(duty)),
                                 escaped(percentile_words(duty)));
  for (const std::string& warning : duty.warnings) text += "<p class=\"failed\">" + escaped(warning) + "</p>\n";
  text += chart_in_page(shares_chart(duty));
  std::string charts;
  for (const DutyPart& part : duty.parts)
    if (!part.over_share.empty())
      charts += fmt::format("<figure><figcaption class=\"soft\">{}</figcaption>{}</figure>\n", escaped(part.job),
                            life_chart(duty, part));
  if (!charts.empty())
    text +=
        "<p class=\"soft\">Life of a new dresspack over the share of one program, all others as often as today. Orange: 1 of 10 has failed. Blue: half. "
        "Upright line: today. Dashed: the life of the robot.</p>\n<div class=\"pairs\">\n" +
        charts + "</div>\n";
  if (const std::string caution = caution_words(duty); !caution.empty())
    text += "<p class=\"soft\">" + escaped(caution) + "</p>\n";
  if (const std::string mixture = mixture_words(duty); !mixture.empty())
    text += "<p class=\"soft\">" + escaped(mixture) + "</p>\n";
  return text;
}

std::string programs_table(const std::vector<DutyResult>& results, const std::string& table) {
  std::vector<std::string> rows;
  for (const DutyResult& duty : results)
    for (std::size_t k = 0; k < duty.parts.size(); ++k) {
      const DutyPart& part = duty.parts[k];
      const auto percent = [](double share) { return number_cell(share, fmt::format("{:.1f} %", 100 * share)); };
      const auto life = [&](double hours) {
        return number_cell(hours, escaped(shown_hours(duty.robot_life_hours, hours)));
      };
      rows.push_back(fmt::format(
          "<tr data-rank=\"{0}\"><td>{1}</td><td>{2}</td>{3}{4}{5}{6}{7}{8}</tr>\n", rows.size() + 1,
          escaped(duty.name), escaped(part.job), number_cell(part.repeats_per_hour, printed(part.repeats_per_hour)),
          percent(part.share_of_time), percent(duty.lives.share[k]), life(duty.lives.percentiles[0]),
          number_cell(part.without[0], without_text(duty, part)),
          number_cell(part.as_twice[0], as_twice_text(duty, part))));
    }
  return sorted_table(
      "<th>duty</th><th>program</th><th class=\"number\">repeats per h</th><th class=\"number\">time</th><th class=\"number\">damage</th>"
      "<th class=\"number\">p10 [h]</th><th class=\"number\">p10 without it [h]</th><th class=\"number\">p10 if twice as often [h]</th>",
      rows, "programs", table);
}

}  // namespace

std::string duty_page(const std::string& name, const std::vector<DutyResult>& results, const std::string& table) {
  std::string body =
      "<style>.pairs { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr)); gap: 0 1rem; } .pairs figure { margin: .4rem 0; } "
      "@media print { figure { break-inside: avoid; } .pairs { grid-template-columns: 1fr 1fr; } }</style>\n"
      "<p class=\"soft\">p10: 1 of 10 new dresspacks has failed by then. A click on a head sorts.</p>\n" +
      programs_table(results, table);
  for (const DutyResult& duty : results) body += section(duty);
  return table_page("Duties: " + name, fmt::format("{}: several programs on one dresspack", name), body);
}

}  // namespace dresslife::pipeline
