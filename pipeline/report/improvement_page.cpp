#include "pipeline/report/improvement_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "pipeline/base/readable.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr const char* improvement_style = R"(
body { margin: 0 auto; max-width: 90rem; padding: 1.5rem 1rem 4rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; } h2 { font-size: 1.3rem; margin: 2rem 0 .3rem; }
p { max-width: 46rem; } .soft { color: var(--soft); font-size: .9rem; } .failed { color: var(--hot); }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .3rem 1.2rem .3rem 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
th { color: var(--soft); font-weight: 600; } .number { text-align: right; white-space: nowrap; }
.beside { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 1rem; }
.beside iframe { width: 100%; height: 46rem; border: 1px solid var(--rule); } .wide { overflow-x: auto; }
h1, td code { overflow-wrap: anywhere; } div.narrow { display: none; } .figure { max-width: 60rem; }
@media screen and (max-width: 45rem) { .broad { display: none; } div.narrow { display: block; } .beside iframe { height: 32rem; } }
@media print { body { max-width: none; padding: 0; font-size: 12px; } iframe { display: none; } .wide { overflow: visible; }
  h2, h2 + p { break-after: avoid; } .figure, tr { break-inside: avoid; } }
)";

std::string lives_section(const ImprovementStory& story) {
  const auto row = [](const char* name, const ImprovementStory::Lives& of) {
    return fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        name, printed_life(of.p10), printed_life(of.p50), printed_life(of.p90), escaped(of.words), escaped(of.modes));
  };
  std::string text =
      "<h2>Lives</h2>\n" +
      wide_table({"", "#p10 [h]", "#p50 [h]", "#p90 [h]", "limits", "modes that are not validated"},
                 (story.before ? row("before", *story.before) : "") +
                     (story.after ? row(story.keep.empty() ? "after" : "best of the trials", *story.after) : ""));
  if (!story.keep.empty()) text += fmt::format("<p><b>{}</b></p>\n", escaped(story.keep));
  if (!story.gain.empty()) text += fmt::format("<p>{}</p>\n", escaped(story.gain));
  std::istringstream lines(story.choice);
  for (std::string line; std::getline(lines, line);) text += fmt::format("<p>{}</p>\n", escaped(line));
  return text;
}

std::string changes_section(const ImprovementStory& story) {
  std::string rows;
  for (const ImprovementStory::Change& change : story.changes)
    rows += fmt::format("<tr><td><code>{}</code></td><td>{}</td><td>{}</td></tr>\n", escaped(change.key),
                        escaped(change.before), escaped(change.after));
  return "<h2>What was changed</h2>\n" + wide_table({"key", "before", "after"}, rows);
}

std::string beside_section(const ImprovementStory& story) {
  if (!story.before || !story.after || story.before->page.empty() || story.after->page.empty()) return "";
  const auto half = [](const char* name, const std::string& page) {
    return fmt::format(
        "<div><p><a href=\"{0}\">{1}</a></p><iframe src=\"{0}\" title=\"{1}\" loading=\"lazy\"></iframe></div>\n",
        escaped(page), name);
  };
  return "<h2>Side by side</h2>\n<div class=\"beside\">\n" + half("before", story.before->page) +
         half("after", story.after->page) + "</div>\n";
}

std::string nudges_section(const ImprovementStory& story) {
  if (story.nudges.empty()) return "";
  std::string rows;
  for (const ImprovementStory::Nudge& nudge : story.nudges)
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td{}>{}</td><td>{}</td></tr>\n", escaped(nudge.what),
        nudge.ran && std::isfinite(nudge.share) ? fmt::format("{}× {:.2f}", nudge.estimated ? "≈ " : "", nudge.share)
                                                : "–",
        nudge.words.empty() ? "" : " class=\"failed\"", nudge.words.empty() ? "kept" : escaped(nudge.words),
        nudge.first_mode.empty()
            ? "–"
            : fmt::format("{}: {}", escaped(nudge.first_mode), escaped(hours_text(nudge.first_hours))));
  return "<h2>Mounting tolerance</h2>\n<p>The same job with one clamp, ring, length or the turn of its end off. The life is the p10 of the "
         "wires over that of the job as drawn. ≈: lives estimated by runs without uncertain inputs.</p>\n" +
         wide_table({"off by", "#life", "limits", "first of the modes that are not validated"}, rows);
}

/// Width of a chart on a page, width on a phone, and height [px].
constexpr double broad = 940, narrow = 350, chart_height = 370;

/// Returns a chart in both widths: text keeps its size, so the narrow chart has less of it.
template <typename Draw>
std::string at_both_widths(const Draw& draw) {
  return fmt::format("<div class=\"figure\"><div class=\"broad\">{}</div><div class=\"narrow\">{}</div></div>\n",
                     draw(broad), draw(narrow));
}

Panel panel_of(double width, PlotAxis x, PlotAxis y) {
  constexpr double left = 80, top = 10, right = 20, below = 60;
  return {left, top, width - left - right, chart_height - top - below, std::move(x), std::move(y)};
}

/// Returns a chart of lives over trials: trials within the limits, trials beyond them, and the best trial so far.
std::string history_chart(const std::vector<ImprovementStory::TrialPoint>& points, double low, double high,
                          double width) {
  const Panel panel = panel_of(width, linear_axis("trial", 0, static_cast<double>(points.size())),
                               decades_axis("life of the worst job, p10 [h]", low, high));
  Picture picture(width, chart_height, "The search",
                  "Life over trials, with those that keep all limits and the best of them so far.");
  panel.draw_axes(picture);
  double best = 0;
  std::vector<std::pair<double, double>> stairs;
  for (const ImprovementStory::TrialPoint& point : points) {
    if (!point.ran || !(point.hours > 0)) continue;
    const double x = panel.across(point.trial);
    const double y = panel.down(std::min(point.hours, panel.y.high));
    picture.dot(x, y, point.feasible ? 4 : 2.5, point.feasible ? "dot" : "bar-hot",
                fmt::format("trial {}: {} h{}", point.trial, printed_life(point.hours),
                            point.feasible ? "" : "; " + point.words));
    if (!point.feasible || point.hours <= best) continue;
    if (best > 0) stairs.emplace_back(x, panel.down(std::min(best, panel.y.high)));
    best = point.hours;
    stairs.emplace_back(x, y);
  }
  if (!stairs.empty()) stairs.emplace_back(panel.right(), stairs.back().second);
  picture.curve(stairs, "curve");
  return picture.svg();
}

std::string history_charts(const std::vector<ImprovementStory::TrialPoint>& points) {
  double low = HUGE_VAL, high = 0;
  for (const ImprovementStory::TrialPoint& point : points)
    if (point.ran && point.hours > 0 && std::isfinite(point.hours)) {
      low = std::min(low, point.hours);
      high = std::max(high, point.hours);
    }
  if (!(high > 0)) return "";
  return at_both_widths([&](double width) { return history_chart(points, low, high, width); });
}

std::string front_charts(const ImprovementStory& story) {
  if (story.front.size() < 2) return "";
  double low = HUGE_VAL, high = 0, least = HUGE_VAL, most = -HUGE_VAL;
  for (const auto& [second, hours] : story.front) {
    if (std::isfinite(hours)) low = std::min(low, hours), high = std::max(high, hours);
    least = std::min(least, second), most = std::max(most, second);
  }
  if (!(high > 0) || !(least < most)) return "";
  const PlotAxis across{story.second_title, least, most};
  return "<h2>Between the two aims</h2>\n" + at_both_widths([&](double width) {
           const Panel panel = panel_of(width, across, decades_axis("life of the worst job, p10 [h]", low, high));
           Picture picture(width, chart_height, "The front", "Longest life for each value of the second aim.");
           panel.draw_axes(picture);
           for (const auto& [second, hours] : story.front)
             picture.dot(panel.across(second), panel.down(std::min(hours, panel.y.high)), 4, "dot",
                         fmt::format("{:.4g}: {} h", second, printed_life(hours)));
           return picture.svg();
         });
}

std::string history_section(const ImprovementStory& story) {
  const auto failed =
      std::ranges::count_if(story.points, [](const ImprovementStory::TrialPoint& point) { return !point.ran; });
  const auto feasible = std::ranges::count_if(story.points, &ImprovementStory::TrialPoint::feasible);
  return fmt::format(
             "<h2>The search</h2>\n<p>{} trials, of which {} keep all limits (blue), {} break some (orange) and {} do not "
             "run; the line is the longest life so far. A longer life that makes another mode worse, or that exceeds the robot's, is not better.</p>\n",
             story.points.size(), feasible, static_cast<std::ptrdiff_t>(story.points.size()) - feasible - failed,
             failed) +
         history_charts(story.points);
}

}  // namespace

std::string improvement_page(const ImprovementStory& story) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}: improved</title>\n<style>{1}{2}</style></head>\n<body>\n<h1>{0}: improved</h1>\n"
      "<p class=\"soft\">All trials stand in improve.csv, the last jobs in <a href=\"report.html\">their report</a>.</p>\n"
      "{3}{4}{5}{6}{7}{8}</body></html>\n",
      escaped(story.name), chart_style(), improvement_style, lives_section(story),
      story.after ? changes_section(story) : "", front_charts(story), beside_section(story), nudges_section(story),
      history_section(story));
}

}  // namespace dresslife::pipeline
