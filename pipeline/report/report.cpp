#include "pipeline/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/damage_tables.h"
#include "pipeline/report/life_charts.h"
#include "pipeline/report/life_matrix.h"
#include "pipeline/report/marked_place.h"
#include "pipeline/report/motion_checks.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/scene.h"
#include "pipeline/report/table_page.h"
#include "pipeline/settings/document.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

/// The charts of a job take about 60 kB, so in a larger study only the best and the worst jobs have charts.
constexpr std::size_t most_detailed = 40;
constexpr std::size_t most_compared = 40;
constexpr double least_shear_told = 5e-5;  // smallest value that is not 0 with two decimals of a per cent

/// Returns the hours by which the first wire breaks in 10 to 90 % of such dresspacks.
std::string first_break_cell(const RankingRow& row) {
  if (std::isnan(row.first_wire_hours[0])) return "";
  return std::isinf(row.first_wire_hours[0])
             ? printed_life(row.first_wire_hours[0])
             : fmt::format("{} .. {}", printed(row.first_wire_hours[0]), printed_life(row.first_wire_hours[2]));
}

std::string place_words(const RankingRow& row) {
  return fmt::format("segment {} from the tool ({:.2f} m){}", row.worst_segment_from_tool, row.worst_position_from_tool,
                     row.worst_dresspack.empty() ? "" : " of the " + escaped(row.worst_dresspack));
}

/// Returns the address of a page beside the job's results, relative to the study's page; empty if it does not exist.
std::string page_address(const RankingRow& row, const std::string& page) {
  if (row.life_file.empty() || kind_of(row.life_file.parent_path() / page) != FileKind::file) return "";
  std::string address;
  for (const char c : row.job)
    address += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.'
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return address + "/" + page;
}

std::string page_link(const RankingRow& row, const std::string& page, const std::string& words) {
  const std::string address = page_address(row, page);
  return address.empty() ? "" : fmt::format("<p><a href=\"{}\">{}</a></p>\n", address, words);
}

// ---- ranking ----------------------------------------------------------------------------------------------

/// Returns the kinds of the warnings, and on request each warning in full.
std::string warning_cell(const RankingRow& row) {
  constexpr bool with_other_values = true;
  const std::string kinds = warning_kinds(row, with_other_values);
  if (kinds.empty()) return row.warnings ? "" : "<span class=\"soft\">not known</span>";
  std::string list;
  for (const Warning& warning : warnings_of(row)) list += fmt::format("<li>{}</li>", escaped(warning.text()));
  return fmt::format("<details><summary class=\"{}\">{}</summary><ul>{}</ul></details>",
                     warning_kinds(row).empty() ? "soft" : "failed", escaped(kinds), list);
}

/// Returns the begin of a table row, with data for sorting and comparing.
std::string row_begin(const RankingRow& row, std::size_t rank) {
  return fmt::format("<tr data-rank=\"{}\" data-job=\"{}\" data-warnings=\"{}\">", rank, escaped(row.job),
                     warnings_of(row).size());
}

/// Returns the 50 and 90 % lives, and below them the certainty of the job's rank.
std::string certainty_cell(const RankingRow& row) {
  if (std::isnan(row.scatter_hours[0])) return "";
  std::string text = fmt::format("<br><span class=\"soft\">half failed {}<br>90 % failed {}",
                                 shown_life(row, row.planned_hours[1]), shown_life(row, row.planned_hours[2]));
  if (row.outlives_next) text += fmt::format("<span class=\"certainty\">{}</span>", escaped(order_words(row)));
  return text + "</span>";
}

/// Returns a note that a result belongs to other settings, with the changes.
std::string stale_note(const RankingRow& row) {
  if (!row.stale) return "";
  return fmt::format("<br><span class=\"failed\">stale</span> <span class=\"soft\">{}</span>{}",
                     escaped(stale_words(row).substr(std::string_view("stale: ").size())),
                     page_link(row, "preview.html", "See where"));
}

std::vector<std::string> ranking_rows(const std::vector<RankingRow>& rows, const std::vector<bool>& detailed) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RankingRow& row = rows[i];
    const std::string name =
        detailed[i] ? fmt::format("<a href=\"#job-{}\">{}</a>", i + 1, escaped(row.job)) : escaped(row.job);
    if (!row.has_result()) {
      all.push_back(
          fmt::format("{}<td class=\"number\">-</td><td>{}</td><td colspan=\"7\"><span class=\"failed\">{}</span> "
                      "{}</td></tr>\n",
                      row_begin(row, i + 1), name, row.waits() ? escaped(row.failure) : "failed",
                      (row.waits() ? "" : escaped(row.failure)) + page_link(row, "preview.html", "See where")));
      continue;
    }
    const std::string worst =
        fmt::format("<span class=\"soft\">worst wire:</span> {}<br>{}", escaped(row.worst_component), place_words(row));
    const std::string failing = escaped(failing_place_words(row));  // the worst wire may be in another cable
    const std::string where = !row.has_wires()   ? "no wires"
                              : !failing.empty() ? failing
                              : row.damaged()    ? worst
                                                 : "no wire is damaged";
    const std::string moved =
        !row.damaged() ? ""
                       : fmt::format("{}{}<br><span class=\"soft\">at {:.1f} s of {:.0f} s</span>",
                                     failing.empty() ? "" : worst + "<br>", escaped(row.worst_step), row.worst_time,
                                     row.repeat_seconds) +
                             (row.worst_joint.empty()
                                  ? ""
                                  : fmt::format("<br><span class=\"soft\">{}</span>", escaped(joint_words(row))));
    const std::string fails_first =
        row.failing_mode.empty()
            ? ""
            : fmt::format("{} ({:.0f} %)<br>", escaped(row.failing_mode), 100 * row.failing_mode_share);
    const std::string unvalidated =
        !earlier_unvalidated(row)
            ? ""
            : fmt::format("<br><span class=\"soft\">not validated: {}</span>", escaped(earlier_words(row)));
    const bool planned = !std::isnan(row.glued_hours[0]);
    const auto bounds = std::pair(planned ? row.glued_hours[0] : row.hours_of(row.life_repeats_all_stick),
                                  planned ? row.free_hours[0] : row.hours_of(row.life_repeats_all_free));
    const auto count = static_cast<double>(warnings_of(row).size());
    all.push_back(fmt::format(
        "{}{}<td>{}</td>{}{}{}{}<td>{}</td><td>{}</td><td{}>{}</td></tr>\n", row_begin(row, i + 1),
        number_cell(static_cast<double>(i + 1), row.rank ? std::to_string(row.rank) : "-"), name + stale_note(row),
        number_cell(row.headline_hours(),
                    "<b>" + plan_mark(row) + shown_life(row, row.headline_hours()) + "</b>" + certainty_cell(row)),
        number_cell(bounds.first, shown_range(row, bounds.first, bounds.second)),
        number_cell(row.first_wire_hours[0], first_break_cell(row)),
        number_cell(row.headline_months(), shown_calendar(row)), fails_first + where + unvalidated, moved,
        sorted_by(count), warning_cell(row)));
  }
  return all;
}

/// Returns lives on one logarithmic axis: a dot, the bounds as a bar behind it, and the lives of 10 to 90 % of such dresspacks.
std::string comparison_chart(const std::vector<RankingRow>& rows) {
  std::vector<const RankingRow*> shown;
  double low = INFINITY, high = 0;
  for (const RankingRow& row : rows) {
    if (!row.done() || !row.damaged() || shown.size() == most_compared) continue;
    shown.push_back(&row);
    for (const double hours : {row.headline_hours(), row.hours_of(row.life_repeats_all_stick),
                               row.hours_of(row.life_repeats_all_free), row.planned_hours[0], row.planned_hours[2]}) {
      if (!(hours > 0) || std::isinf(hours)) continue;
      low = std::min(low, hours);
      high = std::max(high, hours);
    }
  }
  if (shown.size() < 2 || !(high > 0)) return "";
  constexpr double row_height = 24, names = 230, width = 960, half_a_label = 36;
  Panel panel{names,
              8,
              width - names - half_a_label,
              row_height * static_cast<double>(shown.size()),
              decades_axis("life [h of motion]", low, high),
              {"", 0, 1}};
  Picture picture(
      width, panel.bottom() + 44, "Lives compared",
      "Life in hours with everything in the cables glued and free, and the range of 10 to 90 percent of dresspacks.");
  panel.draw_upright_grid(picture);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const RankingRow& row = *shown[i];
    const double y = panel.top + row_height * (static_cast<double>(i) + 0.5);
    picture.text(names - 10, y + 4, row.job, "name", Picture::Anchor::end, names - 14);
    const auto x = [&](double repeats) { return panel.across(row.hours_of(repeats)); };
    picture.line(x(row.life_repeats_all_stick), y, x(row.life_repeats_all_free), y, "whisker");
    const std::array<double, 3>& spread = row.planned_hours;
    if (spread[0] > 0 && std::isfinite(spread[2]))
      picture.line(panel.across(spread[0]), y, panel.across(spread[2]), y, "scatter");
    picture.dot(panel.across(row.headline_hours()), y, 5, "dot",
                fmt::format("{}: {} h", row.job, printed_life(row.headline_hours())));
  }
  return picture.svg();
}

std::string ranking_section(const std::vector<RankingRow>& rows, const std::vector<bool>& detailed) {
  const std::string chart = comparison_chart(rows);
  const std::string matrix = life_matrix(rows, [&](std::size_t k) {
    return detailed[k] ? fmt::format("#job-{}", k + 1)
                       : page_address(rows[k], rows[k].has_result() ? "page.html" : "preview.html");
  });
  constexpr const char* heads =
      "<th>rank</th><th>job</th><th class=\"number\">replace after [h]</th>"
      "<th class=\"number\">replace if glued .. free inside [h]</th><th class=\"number\">first wire by scatter "
      "alone, 10 .. 90 % [h]</th><th class=\"number\">calendar</th>"
      "<th>fails first</th><th>what moved at the worst wire</th><th>warnings</th>";
  const std::string remarks = comparison_words(rows);
  return fmt::format(
      "{}{}{}{}"
      "<p class=\"soft\">Replace after: in so many hours of motion 1 of 10 such dresspacks has failed (p10), over everything "
      "that is uncertain and the scatter of wires. A dresspack has failed when a conductor has lost its share of wires "
      "(fatigue.failed_wires_percent) at one place. The calendar counts the job's operating hours per week. Two jobs "
      "share a rank unless one outlives the other in 90 of 100 samples. "
      "Parts inside a cable rub on each other. Glued .. free: the same p10 if they could not slip, and if they slipped "
      "without friction. First wire: by then a first single wire has broken, by the scatter of wires alone, in 10 .. 90 % "
      "of such dresspacks. {}{}</p>\n",
      sorted_table(heads, ranking_rows(rows, detailed), "jobs", "ranking.csv"), matrix,
      remarks.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(remarks)), escaped(unvalidated_legend(rows)),
      std::ranges::any_of(rows, [](const RankingRow& row) { return plan_mark(row) == "!"; })
          ? " ! marks jobs whose warnings forbid a plan with these hours."
          : "",
      chart.empty()
          ? ""
          : "<h3>Lives compared</h3>\n<p class=\"soft\">Dot: replace after. Blue bar: the median of the worst wire, glued to "
            "free inside (to the right end: no damage). Orange: 10 to 90 % of such dresspacks have failed.</p>\n" +
                chart_in_page(chart));
}

// ---- one job ----------------------------------------------------------------------------------------------

/// Returns the shortest life of each dresspack, if the job has several.
std::string dresspack_table(const LifeSummary& life, const RankingRow& row) {
  if (life.dresspack.size() < 2 || life.dresspack_damage.size() != life.dresspack.size()) return "";
  std::string rows;
  for (std::size_t d = 0; d < life.dresspack.size(); ++d) {
    const double damage = life.dresspack_damage[d];
    rows += damage > 0 ? fmt::format(
                             "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
                             "class=\"number\">{}</td></tr>\n",
                             escaped(life.dresspack[d]), printed(row.hours_of(1 / damage)), printed(1 / damage),
                             printed(damage))
                       : fmt::format("<tr><td>{}</td><td class=\"number\" colspan=\"3\">no wire is damaged</td></tr>\n",
                                     escaped(life.dresspack[d]));
  }
  return "<h3>Life by dresspack</h3>\n<p class=\"soft\">Of the worst wire in each; the charts below are about the worst of them.</p>\n" +
         wide_table({"dresspack", "#life [h]", "#repeats", "#damage per repeat"}, rows);
}

/// Returns "by 3 h in 10 %, 5 h in half, 9 h in 90 % of such dresspacks", without infinite lives.
std::string shares_words(const std::array<double, 3>& lives) {
  constexpr std::array shares{"10 %", "half", "90 %"};
  std::string words;
  for (std::size_t i = 0; i < shares.size() && std::isfinite(lives[i]); ++i)
    words += fmt::format("{} {} in {}", i == 0 ? "by" : ",", printed_hours(lives[i]), shares[i]);
  return (words.empty() ? "in fewer than 10 %" : words) + " of such dresspacks";
}

std::string facts(const RankingRow& row) {
  std::string list;
  const auto fact = [&](const std::string& name, const std::string& value) {
    list += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  };
  if (row.planned()) {
    const std::array<double, 3>& lives = row.planned_hours;
    fact("life",
         std::isinf(lives[0])
             ? "in more than 90 % of the samples no conductor fails"
             : fmt::format("<b>{} h</b> of motion = {} by the calendar until 10 % of such dresspacks have a "
                           "conductor that has lost its share of wires at one place{}{}{}",
                           printed(lives[0]), calendar_words(row.planned_months),
                           std::isinf(lives[1]) ? "" : fmt::format("; {} until half have", printed_hours(lives[1])),
                           std::isinf(lives[2]) ? "" : fmt::format(", {} until 90 %", printed_hours(lives[2])),
                           row.failing_conductor.empty() ? "" : "; likeliest " + escaped(failing_place_words(row))));
  }
  fact(row.planned() ? "worst wire" : "life",
       !row.has_wires() ? "no wires"
       : std::isinf(row.life_hours)
           ? "no damage"
           : fmt::format("{}{} h{} of motion = {} repeats of {:.1f} s = {} by the calendar, median of the "
                         "worst wire",
                         row.planned() ? "" : "<b>", printed(row.life_hours), row.planned() ? "" : "</b>",
                         printed(row.life_repeats), row.repeat_seconds, calendar_words(row.life_months)));
  if (!std::isnan(row.scatter_hours[0]))
    fact("by the scatter of wires alone",
         shares_words(row.scatter_hours) + ", everything else with the job's own values");
  if (!row.life_shares.empty()) fact("its causes", escaped(row.life_shares));
  if (const std::string words = order_words(row); !words.empty()) fact("beside the next job", escaped(words));
  if (!row.failing_mode.empty())
    fact("fails first", fmt::format("{}, in {:.0f} % of the samples that fail{}{}", escaped(row.failing_mode),
                                    100 * row.failing_mode_share, row.failing_conductor.empty() ? "" : ", likeliest ",
                                    escaped(failing_place_words(row))));
  if (row.relative) fact("relative life", escaped(relative_words(*row.relative)));
  const auto bounds = [&](const char* name, double glued, double free, const char* endless) {
    const auto text = [&](double hours) { return std::isinf(hours) ? endless : printed_hours(hours); };
    fact(name, fmt::format("{} if everything inside the cables were glued, {} if it slipped without friction",
                           text(glued), text(free)));
  };
  const std::array<const char*, 3> shares{"bounds of 10 % failed", "bounds of half failed", "bounds of 90 % failed"};
  for (std::size_t i = 0; i < shares.size() && !std::isnan(row.glued_hours[0]); ++i)
    bounds(shares[i], row.glued_hours[i], row.free_hours[i], "never");
  if (row.has_wires())
    bounds("bounds of the worst wire", row.hours_of(row.life_repeats_all_stick),
           row.hours_of(row.life_repeats_all_free), "no damage");
  if (!row.estimates.empty()) fact("ESTIMATE, not in the dresspack", escaped(row.estimates));
  if (row.hours_mean_stress_kept)
    fact("mean stress",
         fmt::format("{} if none of it relaxed, {} without any, median of the same wire",
                     printed_hours(*row.hours_mean_stress_kept), printed_hours(*row.hours_without_mean_stress)));
  if (const std::string held = held_words(row); !held.empty()) fact("comparable", escaped(held));
  if (!row.settings.empty()) fact("settings", row.settings + " in ranking.csv");
  for (const Warning& warning : warnings_of(row)) fact("warning", "<b>" + escaped(warning.text()) + "</b>");
  if (row.clamp_moment_share) {
    const std::string tears =
        row.largest_force_share
            ? fmt::format("at most {:.2f} of the force that breaks a cable", *row.largest_force_share)
            : "strength not known (tensile_strength_MPa of its wires' material)";
    fact("forces of cables", fmt::format("{}; at the clamps {:.2g} times the moment that the hose carries{}", tears,
                                         *row.clamp_moment_share,
                                         row.force_ok() ? ""
                                                        : ". <b>Above a fifth of either, the forces are unrealistic: "
                                                          "check slack, play and grips</b>"));
  }
  if (row.strain_relief_share)
    fact("pull at clamps",
         fmt::format("{:.2g} of what a strain relief of type A has to hold (EN 50262){}", *row.strain_relief_share,
                     *row.strain_relief_share > 1 ? ". <b>Check that the clamps hold the cables</b>" : ""));
  if (row.loose_mesh_error)
    fact("mesh of loose cables", fmt::format("discretisation error of their curvature: {:.2g} % (a warning above 1 %)",
                                             100 * *row.loose_mesh_error));
  const auto scatter = [&](const std::string& name, const std::array<double, 3>& lives) {
    if (std::isnan(lives[0])) return;
    fact(name, shares_words(lives) + ", by the scatter of wires alone");
  };
  scatter("first broken wire", row.first_wire_hours);
  scatter("share of a conductor broken anywhere in it", row.conductor_hours);
  if (!row.not_evaluated.empty()) fact("not evaluated", escaped(row.not_evaluated));
  if (row.damaged()) {
    fact("breaks first",
         escaped(row.worst_component) +
             (row.worst_shear_range >= least_shear_told
                  ? fmt::format(" (its surface is sheared by {:.2f} % to and fro)", 100 * row.worst_shear_range)
                  : ""));
    fact("where", place_words(row));
    fact("when",
         fmt::format("at {:.1f} s, {}", row.worst_time,
                     row.worst_step.empty() ? "outside any program line" : "during '" + escaped(row.worst_step) + "'"));
  }
  return failure_table(row) + "<dl>\n" + list + "</dl>\n";
}

std::string charts(const RankingRow& row) {
  // A stage that ran again since may have replaced the strains of the last result.
  const LifeSummary life = read_life(row.life_file, row.stale ? "" : row.life_file.parent_path() / "strain.h5");
  return dresspack_table(life, row) +
         chart_section(
             "Strain of the worst wire over time",
             "Where its history was not kept whole, of a wire of that segment of which it was. Below the strain, the lines of "
             "the program (rest the pointer on one for its text); those that cost most are marked and named.",
             strain_chart(life)) +
         damage_along(life, row) +
         chart_section("Cycles of the worst wire",
                       "How often each strain range occurs in a repeat, and its share of the damage.",
                       cycle_chart(life)) +
         damage_tables(life, row) +
         fmt::format(
             "<details><summary>Settings</summary>\n<pre class=\"settings\">{}</pre></details>\n<details><summary>History</"
             "summary>\n<pre>{}</pre></details>\n",
             escaped(life.job), escaped(life.history));
}

/// Returns the picture of the moment that damages the marked place most; empty if the motion file was removed.
std::string scene(const RankingRow& row) {
  const std::filesystem::path motion = row.life_file.parent_path() / "motion.h5";
  if (!row.damaged() || kind_of(motion) == FileKind::absent) return "";
  const std::optional<MarkedPlace> place = marked_place(FileReader(row.life_file, life_format()));
  if (!place) return "";
  const std::string picture = scene_picture(motion, place->time, place->from_tool, place->dresspack);
  return picture.empty()
             ? ""
             : fmt::format(
                   "<h3>The moment</h3>\n<p class=\"soft\">Robot and dresspack when the most damaging cycle closes at the marked "
                   "place, that of the {}.</p>\n",
                   place->fails_first ? "conductor that fails first" : "worst wire") +
                   picture_in_page(picture);
}

/// Returns the table of checks for a cell designer; empty if the motion file was removed.
std::string checks(const RankingRow& row) {
  const std::filesystem::path motion = row.life_file.parent_path() / "motion.h5";
  if (kind_of(motion) == FileKind::absent) return "";
  const std::string table = check_table(motion);
  return table.empty() ? "" : "<h3>Checks of the motion</h3>\n" + table;
}

/// problems: receives the reason if a section cannot be written.
std::string job_section(const RankingRow& row, std::size_t rank, std::vector<ReportProblem>& problems) {
  std::string body;
  try {
    const std::string action = row.done() ? action_words(row) : "";
    if (!action.empty()) body += fmt::format("<p><b>{}</b> {}</p>\n", escaped(action), escaped(uncertainty_words(row)));
    body += page_link(row, "page.html", "See it move, and where and when the damage comes about") + facts(row);
    // A stage that ran again since may have replaced the motion of the last result.
    if (!row.stale) body += scene(row) + checks(row);
    body += charts(row);
  } catch (const InputError& problem) {
    body += fmt::format("<p class=\"failed\">{}</p>\n", escaped(problem.what()));
    problems.push_back({row.job, problem.what()});
  }
  const std::string stale = row.stale ? fmt::format("<p class=\"failed\">{}</p>\n", escaped(stale_words(row))) : "";
  return fmt::format("<section id=\"job-{}\">\n<h2>{}. {}</h2>\n{}{}</section>\n", rank,
                     row.rank ? std::to_string(row.rank) : "-", escaped(row.job), stale, body);
}

std::string summary(const std::vector<RankingRow>& rows) {
  const auto count = [&](const auto& counts) { return static_cast<std::size_t>(std::ranges::count_if(rows, counts)); };
  const std::size_t done = count([](const RankingRow& row) { return row.done(); });
  const std::size_t stale = count([](const RankingRow& row) { return row.stale; });
  const std::size_t waiting = count([](const RankingRow& row) { return !row.stale && row.waits(); });
  std::string text = fmt::format("{} of {} jobs done", done, rows.size());
  if (stale > 0) text += fmt::format(", <span class=\"failed\">{} stale</span>: their last results stand below", stale);
  if (waiting > 0) text += fmt::format(", {} to do", waiting);
  if (const std::size_t failed = rows.size() - done - stale - waiting; failed > 0)
    text += fmt::format(", <span class=\"failed\">{} failed</span>", failed);
  if (done + stale > most_detailed)
    text += fmt::format("; charts for the {} best and the {} worst of them", most_detailed / 2, most_detailed / 2);
  return "<p>" + text + ".</p>\n";
}

}  // namespace

std::vector<bool> detailed_jobs(const std::vector<RankingRow>& rows) {
  const auto done =
      static_cast<std::size_t>(std::ranges::count_if(rows, [](const RankingRow& row) { return row.has_result(); }));
  std::vector<bool> detailed(rows.size(), false);
  for (std::size_t i = 0; i < done; ++i)
    detailed[i] = (done <= most_detailed || i < most_detailed / 2 || i >= done - most_detailed / 2) &&
                  !rows[i].life_file.empty();  // rows without a life file belong to a study that keeps only lives
  return detailed;
}

std::string report_page(const std::string& study, const std::vector<RankingRow>& rows,
                        std::vector<ReportProblem>& problems) {
  const std::vector<bool> detailed = detailed_jobs(rows);
  std::string body = summary(rows) + ranking_section(rows, detailed);
  if (std::ranges::any_of(rows, has_paths))
    body += fmt::format("<p class=\"soft\">Paths in warnings are relative to the folder of this report, {}.</p>\n",
                        escaped(study));
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (detailed[i]) body += job_section(rows[i], i + 1, problems);
  return table_page(study + ": dresspack life", study + ": dresspack life by motion", body);
}

std::vector<ReportProblem> write_report(const std::filesystem::path& file, const std::string& study,
                                        const std::vector<RankingRow>& rows) {
  std::vector<ReportProblem> problems;
  write_text_if_changed(file, with_mark(report_page(study, rows, problems), Mark::page));
  return problems;
}

}  // namespace dresslife::pipeline
