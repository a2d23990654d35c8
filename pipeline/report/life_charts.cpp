#include "pipeline/report/life_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/known_history.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr double in_percent = 100;
constexpr double narrow_span = 30;     // values with a smaller ratio use a linear axis
constexpr double widest_span = 1e6;    // values below the largest by more than this ratio are not shown
constexpr double smallest_cell = 0.5;  // narrower stretches of the program are invisible
// share of the largest damage that counts as the same place, because a technician cannot separate such places
constexpr double nearly_worst = 0.8;
constexpr std::size_t named_lines = 4;
constexpr double named_share = 0.03;  // smallest share of the damage with which a line is named

std::string line_name(const LifeSummary& life, std::int32_t step) {
  if (step < 0 || step >= static_cast<std::int32_t>(life.step_text.size())) return "no program line";
  return life.step_text[static_cast<std::size_t>(step)];
}

/// Returns an axis for damage or counts: logarithmic if the values span decades, else linear from zero.
PlotAxis axis_of_amounts(std::string title, const std::vector<double>& values) {
  double most = 0, least = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    most = std::max(most, value);
    least = least > 0 ? std::min(least, value) : value;
  }
  if (most > narrow_span * least)
    return decades_axis(std::move(title), std::max(least, most / widest_span) * 0.999, most);
  return linear_axis(std::move(title), 0, most, 5);
}

// ---- strain over time -------------------------------------------------------------------------------------

struct Label {
  double x;
  std::string words;
};

/// Returns the most damaging program lines, each at the time of its largest damage, in the order of time.
std::vector<Label> costly_lines(const LifeSummary& life, const std::vector<ProgramRun>& runs, const Panel& panel) {
  const double total = sum_of(life.step_damage);
  std::vector<Label> labels;
  for (const std::size_t line : largest_first(life.step_damage)) {
    if (labels.size() == named_lines || !(life.step_damage[line] > named_share * total)) break;
    const ProgramRun* const costliest = runs_of(line, runs).costliest;
    if (!costliest) continue;
    labels.push_back({panel.across((costliest->begin + costliest->end) / 2),
                      fmt::format("{:.0f} %: line {}, {}", in_percent * life.step_damage[line] / total, line + 1,
                                  life.step_text[line])});
  }
  std::ranges::stable_sort(labels, {}, &Label::x);
  return labels;
}

/// Draws labels above the panel, each with a leader. Labels that extend to the right step down from left to right. Labels that
/// must extend to the left stand above them and step up, so that no leader crosses a label.
void draw_labels(Picture& picture, const Panel& panel, const std::vector<Label>& labels, double top,
                 double row_height) {
  std::vector<const Label*> rows;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label)
    if (label->x + 6 + text_width(label->words) > chart_width) rows.push_back(&*label);
  const std::size_t reading_left = rows.size();
  for (const Label& label : labels)
    if (label.x + 6 + text_width(label.words) <= chart_width) rows.push_back(&label);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double y = top + row_height * static_cast<double>(row + 1) - 4;
    picture.line(rows[row]->x, y - 8, rows[row]->x, panel.bottom(), "leader");
    const bool left = row < reading_left;
    picture.text(rows[row]->x + (left ? -5 : 5), y, rows[row]->words, "note",
                 left ? Picture::Anchor::end : Picture::Anchor::start,
                 (left ? rows[row]->x : chart_width - rows[row]->x) - 6);
  }
}

/// Draws one cell per stretch of the program, alternately light and dark. Stretches with much damage are marked.
void draw_program(Picture& picture, const LifeSummary& life, const std::vector<ProgramRun>& runs, const Panel& panel,
                  double top, double height) {
  const double total = sum_of(life.damage_rate);
  bool dark = false;
  for (const ProgramRun& run : runs) {
    const double from = panel.across(run.begin), to = panel.across(run.end);
    const double share = total > 0 ? run.damage / total : 0;
    if (to - from < smallest_cell && share < named_share) continue;
    dark = !dark;
    const std::int64_t line = std::int64_t{run.step} + 1;
    picture.box(from, top, std::max(to - from, smallest_cell), height,
                share >= named_share ? "costly"
                : dark               ? "dark"
                                     : "light",
                fmt::format("{:.1f} .. {:.1f} s, line {}: {}; {:.1f} % of the damage", run.begin, run.end, line,
                            line_name(life, run.step), in_percent * share));
    const std::string number = std::to_string(line);
    if (run.step >= 0 && to - from > text_width(number) + 2)
      picture.text((from + to) / 2, top + height - 4.5, number, "cell", Picture::Anchor::middle);
  }
  picture.text(chart_left - 6, top + height - 4, "line", "tick", Picture::Anchor::end);
}

std::vector<double> shares_so_far(const std::vector<double>& rates) {
  std::vector<double> shares;
  double so_far = 0;
  for (const double rate : rates) shares.push_back(so_far += rate);
  for (double& share : shares) share *= so_far > 0 ? in_percent / so_far : 0;
  return shares;
}

/// Returns a step curve: the share is constant until the next cycle closes.
std::vector<std::pair<double, double>> stair(const Panel& panel, const std::vector<double>& time,
                                             const std::vector<double>& values) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < std::min(time.size(), values.size()); ++k) {
    const double x = panel.across(time[k]), y = panel.down(values[k]);
    const bool last = k + 1 == time.size();
    if (!points.empty() && points.back().second == y && !last) continue;
    if (!points.empty()) points.emplace_back(x, points.back().second);
    points.emplace_back(x, y);
  }
  return points;
}

// ---- cycles -----------------------------------------------------------------------------------------------

constexpr int bins_per_decade = 10;

struct Bin {
  double low = 0, high = 0;  ///< strain range [%]
  double count = 0, damage = 0;
};

std::vector<Bin> bins_of(const std::vector<WorstCycle>& cycles) {
  std::map<int, Bin> bins;
  for (const WorstCycle& cycle : cycles) {
    if (!(cycle.range > 0)) continue;
    const int index = static_cast<int>(std::floor(std::log10(in_percent * cycle.range) * bins_per_decade));
    Bin& bin = bins[index];
    bin.low = std::pow(10, static_cast<double>(index) / bins_per_decade);
    bin.high = std::pow(10, static_cast<double>(index + 1) / bins_per_decade);
    bin.count += cycle.count;
    bin.damage += cycle.damage;
  }
  return mapped(bins, &std::pair<const int, Bin>::second);
}

/// Returns the axis over all ranges, with margins for the outer bins.
PlotAxis range_axis(const std::vector<Bin>& bins) {
  PlotAxis axis{"strain range of a cycle [%]", bins.front().low, bins.back().high, true};
  // An axis of less than a decade has too few round ticks, so it is widened to whole decades.
  if (axis.high < 8 * axis.low) axis = decades_axis(axis.title, axis.low, axis.high);
  return axis;
}

struct PlaceInFile {
  std::size_t dresspack = 0, first_segment = 0;
};

/// Reads names and lives of all dresspacks, and the data along the dresspack with the worst wire.
PlaceInFile read_worst_dresspack(const FileReader& file, LifeSummary& life) {
  life.dresspack = dresspack_names(file);
  if (file.has("/dresspack/damage")) life.dresspack_damage = file.read<double>("/dresspack/damage");
  const std::string worst = file.has_attribute("worst_dresspack") ? file.text_attribute("worst_dresspack") : "";
  const auto found = std::ranges::find(life.dresspack, worst);
  PlaceInFile place;
  if (found != life.dresspack.end()) place.dresspack = static_cast<std::size_t>(found - life.dresspack.begin());
  const std::vector<std::size_t> of_segment = dresspack_of_segments(file);
  const auto range = std::equal_range(of_segment.begin(), of_segment.end(), place.dresspack);
  const auto first = range.first - of_segment.begin(), end = range.second - of_segment.begin();
  place.first_segment = static_cast<std::size_t>(first);
  const auto own = [&](const char* dataset) {
    const std::vector<double> all = file.read<double>(dataset);
    return std::vector<double>(all.begin() + first, all.begin() + end);
  };
  life.segment_length = own("/segment/length");
  life.segment_damage = own("/segment/damage");
  if (!file.has("/clamp/damage") || !file.has("/clamp/name")) return place;
  const auto names = file.read<std::string>("/clamp/name");
  const auto damage = file.read<double>("/clamp/damage");
  const std::string before = worst.empty() ? "" : worst + ", ";
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k].starts_with(before)) {
      life.clamps.push_back(names[k].substr(before.size()));
      life.clamp_damage.push_back(damage[k]);
    }
  return place;
}

}  // namespace

LifeSummary read_life(const std::filesystem::path& life_file, const std::filesystem::path& strain_file) {
  const FileReader file(life_file, life_format());
  LifeSummary life;
  std::optional<FileReader> strain;
  if (kind_of(strain_file) != FileKind::absent) strain.emplace(strain_file, strain_format());
  const KnownHistory history = known_history(file, strain ? &*strain : nullptr);
  life.strain = history.strain;
  life.strain_of = history.words();
  life.time = file.read<double>("/time");
  life.step = file.read<std::int32_t>("/program/step");
  life.step_text = file.read<std::string>("/program/text");
  life.step_damage = file.read<double>("/program/damage");
  if (file.has("/program/damage_opened")) life.step_opened = file.read<double>("/program/damage_opened");
  const PlaceInFile place = read_worst_dresspack(file, life);
  life.layer = file.read<std::string>("/layer/component");
  life.layer_damage = file.read<double>("/layer/damage");
  life.job = file.text_attribute("job");
  life.history = file.text_attribute("history");
  if (file.has("/joint/name")) {
    life.cause = file.read<std::string>("/joint/name");
    life.cause_damage = file.read<double>("/joint/damage");
    life.line_cause_damage = file.read<double>("/program/joint_damage");
    life.explained = file.number_attribute("joint_explained");
  }
  const double worst = file.number_attribute("worst_site");
  const auto segments = static_cast<double>(life.segment_length.size());
  const double row = segments - file.number_attribute("worst_segment_from_tool");
  if (worst < 0 || row < 0 || row >= segments) return life;
  file.read_rows("/damage_rate", place.first_segment + static_cast<std::size_t>(row), 1, life.damage_rate);
  const auto site = file.read<std::uint32_t>("/cycles/site");
  const auto range = file.read<double>("/cycles/range"), count = file.read<double>("/cycles/count"),
             damage = file.read<double>("/cycles/damage");
  for (std::size_t k = 0; k < site.size(); ++k)
    if (site[k] == static_cast<std::uint32_t>(worst)) life.cycles.push_back({range[k], count[k], damage[k]});
  return life;
}

std::vector<ProgramRun> program_runs(const LifeSummary& life) {
  std::vector<ProgramRun> runs;
  for (std::size_t k = 0; k < life.time.size(); ++k) {
    if (runs.empty() || runs.back().step != life.step[k]) {
      if (!runs.empty()) runs.back().end = life.time[k];
      runs.push_back({life.step[k], life.time[k], life.time[k]});
    }
    runs.back().end = life.time[k];
    if (!life.damage_rate.empty()) runs.back().damage += life.damage_rate[k];
  }
  return runs;
}

LineRuns runs_of(std::size_t line, const std::vector<ProgramRun>& runs) {
  LineRuns of;
  for (const ProgramRun& run : runs) {
    if (run.step != static_cast<std::int32_t>(line)) continue;
    ++of.times;
    if (!of.costliest || run.damage > of.costliest->damage) of.costliest = &run;
  }
  return of;
}

std::string strain_chart(const LifeSummary& life) {
  if (life.time.size() < 2) return "";
  constexpr double label_row = 17, strain_height = 230, strip_height = 17, share_height = 76, gap = 7;
  const auto [low, high] = std::ranges::minmax_element(life.strain);
  if (*low == *high) return "";  // no wire is strained
  const std::vector<ProgramRun> runs = program_runs(life);
  PlotAxis time{"time [s]", life.time.front(), life.time.back()};
  Panel strain{chart_left,    0,    chart_panel,
               strain_height, time, linear_axis("strain [%]", in_percent * *low, in_percent * *high)};
  const std::vector<Label> labels = costly_lines(life, runs, strain);
  strain.top = 8 + label_row * static_cast<double>(labels.size());
  const double strip = strain.bottom() + gap;
  const Panel share{chart_left, strip + strip_height + gap, chart_panel, share_height, time, {"share [%]", 0, 100}};
  const bool damaged = sum_of(life.damage_rate) > 0;
  const double bottom = damaged ? share.bottom() : strip + strip_height;
  Picture picture(chart_width, bottom + x_axis_height, "Strain of the worst wire over time",
                  fmt::format("Strain between {:.3g} and {:.3g} percent over {:.0f} seconds.", in_percent * *low,
                              in_percent * *high, life.time.back() - life.time.front()));
  strain.draw_axes(picture, false);
  if (strain.y.low < 0 && strain.y.high > 0)
    picture.line(strain.left, strain.down(0), strain.right(), strain.down(0), "mark");
  draw_labels(picture, strain, labels, 4, label_row);
  std::vector<std::pair<double, double>> points =
      thinned(life.time, life.strain, static_cast<std::size_t>(chart_panel));
  for (auto& [x, y] : points) {
    x = strain.across(x);
    y = strain.down(in_percent * y);
  }
  picture.curve(points, "curve");
  picture.text(strain.left + 6, strain.bottom() - 7, life.strain_of, "note");
  draw_program(picture, life, runs, strain, strip, strip_height);
  if (damaged) {
    share.draw_axes(picture);
    picture.curve(stair(share, life.time, shares_so_far(life.damage_rate)), "curve-hot");
    picture.text(chart_left + 6, share.top + 13, "damage so far", "note");
  } else {
    for (const Tick& tick : time.ticks(9))
      picture.text(strain.across(tick.value), bottom + 17, tick.label, "tick", Picture::Anchor::middle);
    picture.text(chart_left + chart_panel / 2, bottom + 36, time.title, "axis-title", Picture::Anchor::middle);
  }
  return picture.svg();
}

std::string segment_chart(const LifeSummary& life, int worst_from_tool) {
  const std::size_t segments = life.segment_damage.size();
  if (segments == 0 || !(sum_of(life.segment_damage) > 0)) return "";
  PlotAxis x{"base clamp   \u2190   distance to the tool clamp along the dresspack [m]   \u2192   tool clamp", 0,
             sum_of(life.segment_length)};
  x.reversed = true;
  const Panel panel{chart_left, 26, chart_panel, 180, x, axis_of_amounts("damage per repeat", life.segment_damage)};
  Picture picture(chart_width, panel.bottom() + x_axis_height, "Damage along the dresspack",
                  fmt::format("The worst segment is number {} from the tool.", worst_from_tool));
  panel.draw_axes(picture);
  double to_tool = sum_of(life.segment_length);
  for (std::size_t k = 0; k < segments; ++k) {
    const double from = panel.across(to_tool), to = panel.across(to_tool -= life.segment_length[k]);
    const int from_tool = static_cast<int>(segments - k);
    const bool worst = from_tool == worst_from_tool;
    if (!(life.segment_damage[k] > 0)) continue;
    const double top = panel.down(life.segment_damage[k]), margin = std::min(1.0, (to - from) / 8);
    picture.box(from + margin, top, to - from - 2 * margin, panel.bottom() - top, worst ? "bar-hot" : "bar",
                fmt::format("segment {} from the tool: damage {} per repeat, life {} repeats", from_tool,
                            printed(life.segment_damage[k]), printed(1 / life.segment_damage[k])));
    if (!worst) continue;
    const double middle = (from + to) / 2;
    const std::string words = fmt::format("worst: segment {} from the tool", from_tool);
    const bool left = middle + 5 + text_width(words) > chart_width;
    picture.line(middle, 4, middle, top, "leader");
    picture.text(middle + (left ? -5 : 5), 13, words, "note", left ? Picture::Anchor::end : Picture::Anchor::start);
  }
  return picture.svg();
}

double nearly_worst_share(const LifeSummary& life) {
  double most = 0, nearly = 0;
  for (const double damage : life.segment_damage) most = std::max(most, damage);
  for (std::size_t k = 0; k < life.segment_damage.size(); ++k)
    if (life.segment_damage[k] >= nearly_worst * most) nearly += life.segment_length[k];
  return most > 0 ? nearly / sum_of(life.segment_length) : 0;
}

std::string cycle_chart(const LifeSummary& life) {
  const std::vector<Bin> bins = bins_of(life.cycles);
  if (bins.empty()) return "";
  const std::vector<double> counts = mapped(bins, &Bin::count);
  std::vector<double> shares = mapped(bins, &Bin::damage);
  const double total = sum_of(shares);
  for (double& share : shares) share *= total > 0 ? in_percent / total : 0;
  const PlotAxis x = range_axis(bins);
  const Panel count{chart_left, 10, chart_panel, 130, x, axis_of_amounts("cycles per repeat", counts)};
  const Panel share{chart_left,  count.bottom() + 16,
                    chart_panel, 130,
                    x,           linear_axis("share of damage [%]", 0, *std::ranges::max_element(shares), 5)};
  Picture picture(chart_width, share.bottom() + x_axis_height, "Cycles of the worst wire",
                  fmt::format("{} cycles per repeat.", printed(sum_of(counts))));
  count.draw_axes(picture, false);
  share.draw_axes(picture);
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const double from = count.across(bins[k].low) + 0.5, to = count.across(bins[k].high) - 0.5;
    const std::string hint = fmt::format("range {} .. {} %: {} cycles, {} % of the damage", printed(bins[k].low),
                                         printed(bins[k].high), printed(bins[k].count), printed(shares[k]));
    picture.box(from, count.down(counts[k]), to - from, count.bottom() - count.down(counts[k]), "bar", hint);
    picture.box(from, share.down(shares[k]), to - from, share.bottom() - share.down(shares[k]), "bar-hot", hint);
  }
  return picture.svg();
}

}  // namespace dresslife::pipeline
