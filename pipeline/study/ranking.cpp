#include "pipeline/study/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <tuple>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/base/readable.h"
#include "pipeline/cable/believable.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/mode_table.h"
#include "pipeline/study/ranking_columns.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

/// Root attributes of a life file: from its receipt, or from the file if the receipt has none.
class LifeRoot {
 public:
  explicit LifeRoot(const JobResult& result) : result_(result) {
    if (result.results.empty()) file_.emplace(result.life_file, life_format(), FileReader::Scope::attributes);
  }
  bool has_attribute(const std::string& name) const {
    return file_ ? file_->has_attribute(name) : find(name) != nullptr;
  }
  double number_attribute(const std::string& name) const {
    return file_ ? file_->number_attribute(name) : stored(name).number;
  }
  std::string text_attribute(const std::string& name) const {
    return file_ ? file_->text_attribute(name) : stored(name).text;
  }
  Where where() const { return {result_.life_file.string()}; }

 private:
  const ResultValue* find(const std::string& name) const { return find_in(result_.results, &ResultValue::name, name); }
  const ResultValue& stored(const std::string& name) const {
    if (const ResultValue* const found = find(name)) return *found;
    throw InputError(where(), fmt::format("attribute '{}' is missing", name),
                     "make the file again with dresslife-fatigue");
  }

  const JobResult& result_;
  std::optional<FileReader> file_;
};

void read_scatter(const LifeRoot& file, RankingRow& row) {
  const std::array<const char*, 3> ends{"p10", "p50", "p90"};
  const auto read = [&](const std::string& name, double& value) {
    if (file.has_attribute(name)) value = file.number_attribute(name);
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    read(fmt::format("life_hours_{}", ends[i]), row.planned_hours[i]);
    read(fmt::format("first_wire_life_hours_{}", ends[i]), row.first_wire_hours[i]);
    read(fmt::format("conductor_life_hours_{}", ends[i]), row.conductor_hours[i]);
  }
  if (!row.planned()) return;
  read("life_months_p10", row.planned_months);
  for (std::size_t i = 0; i < ends.size(); ++i)
    read(fmt::format("scatter_life_hours_{}", ends[i]), row.scatter_hours[i]);
  if (file.has_attribute("life_response")) {
    row.life_response = file.text_attribute("life_response");
    row.life_shares = file.text_attribute("life_shares");
    row.measure_next = file.text_attribute("measure_next");
    row.measure_next_share = file.number_attribute("measure_next_share");
  }
  if (file.has_attribute("failing_mode")) {
    row.failing_mode = file.text_attribute("failing_mode");
    row.failing_mode_share = file.number_attribute("failing_mode_share");
    for (std::size_t i = 0; i < ends.size(); ++i) {
      read(fmt::format("life_hours_{}_all_glued", ends[i]), row.glued_hours[i]);
      read(fmt::format("life_hours_{}_all_free", ends[i]), row.free_hours[i]);
    }
  }
  if (file.has_attribute("best_test")) {
    row.best_test = file.text_attribute("best_test");
    row.tested_p10 = file.number_attribute("best_test_life_hours_p10");
    row.tested_p90 = file.number_attribute("best_test_life_hours_p90");
  }
  for (std::size_t i = 0; i < ends.size(); ++i) read(fmt::format("life_error_{}", ends[i]), row.planned_errors[i]);
  row.failing_conductor = file.text_attribute("failing_conductor");
  row.failing_position_from_tool = file.number_attribute("failing_position_from_tool");
}

int count_attribute(const LifeRoot& file, const std::string& name) {
  constexpr double most = 1e9;
  const double value = file.number_attribute(name);
  if (!(std::abs(value) <= most))
    throw InputError(file.where(), fmt::format("attribute '{}' is {} (must be a count)", name, value),
                     "make the file again with dresslife-fatigue");
  return static_cast<int>(value);
}

void read_unvalidated(const LifeRoot& file, RankingRow& row) {
  try {
    row.unvalidated = unvalidated_from(file.text_attribute("unvalidated_modes"));
  } catch (const std::logic_error& problem) {
    throw InputError(file.where(),
                     fmt::format("attribute 'unvalidated_modes' is no list of modes ({})", problem.what()),
                     "make the file again with dresslife-fatigue");
  }
  row.not_evaluated = file.text_attribute("not_evaluated");
}

RankingRow read_row(const JobResult& result) {
  RankingRow row;
  row.job = result.name;
  row.life_file = result.life_file;
  row.failure = result.failure;
  row.settings = result.settings, row.simulated = result.simulated;
  row.stale = result.stale;
  row.changed = result.changed;
  if (!row.has_result()) return row;
  try {
    const LifeRoot file(result);
    row.repeat_seconds = file.number_attribute("repeat_seconds");
    if (file.has_attribute("robot_life_hours")) row.robot_life_hours = file.number_attribute("robot_life_hours");
    read_unvalidated(file, row);
    if (file.has_attribute("largest_force_share")) {
      if (const double share = file.number_attribute("largest_force_share"); share > 0) row.largest_force_share = share;
      row.clamp_moment_share = file.number_attribute("clamp_moment_share");
    }
    if (file.has_attribute("strain_relief_share"))
      row.strain_relief_share = file.number_attribute("strain_relief_share");
    if (file.has_attribute("moving_places")) row.moving_places = file.number_attribute("moving_places");
    if (file.has_attribute("loose_mesh_error")) row.loose_mesh_error = file.number_attribute("loose_mesh_error");
    if (file.has_attribute("life_hours_mean_stress_kept")) {
      row.hours_mean_stress_kept = file.number_attribute("life_hours_mean_stress_kept");
      row.hours_without_mean_stress = file.number_attribute("life_hours_without_mean_stress");
    }
    if (file.has_attribute("estimates")) row.estimates = file.text_attribute("estimates");
    if (file.has_attribute("warnings")) row.warnings = warnings_from(file.text_attribute("warnings"));
    if (file.number_attribute("worst_site") < 0) return row;
    row.life_repeats = file.number_attribute("life_repeats");
    row.life_hours = file.number_attribute("life_hours");
    row.life_months = file.number_attribute("life_months");
    row.life_repeats_all_stick = file.number_attribute("life_repeats_all_stick");
    row.life_repeats_all_free = file.number_attribute("life_repeats_all_free");
    row.damage_per_repeat = file.number_attribute("damage_per_repeat");
    read_scatter(file, row);
    row.worst_segment_from_tool = count_attribute(file, "worst_segment_from_tool");
    row.worst_position_from_tool = file.number_attribute("worst_position_from_tool");
    row.worst_time = file.number_attribute("worst_time");
    if (file.has_attribute("worst_component")) row.worst_component = file.text_attribute("worst_component");
    if (file.has_attribute("worst_dresspack")) row.worst_dresspack = file.text_attribute("worst_dresspack");
    if (file.has_attribute("worst_step")) row.worst_step = file.text_attribute("worst_step");
    if (file.has_attribute("worst_shear_range")) row.worst_shear_range = file.number_attribute("worst_shear_range");
    if (file.has_attribute("worst_joint")) row.worst_joint = file.text_attribute("worst_joint");
    if (!row.worst_joint.empty()) row.worst_joint_share = file.number_attribute("worst_joint_share");
  } catch (const InputError& problem) {
    row.failure = problem.what();
    row.stale = false;
  }
  return row;
}

/// Returns log10 hours of a row, (sample); empty: not known. A response that cannot be read makes a failed row. moved_as: the first
/// job with the same simulation.
std::vector<double> lives_of(RankingRow& row, const std::string& moved_as, std::size_t samples) {
  if (!row.done() || row.life_response.empty()) return {};
  try {
    std::vector<double> lives = compared_failures(modes_from_text(row.life_response), row.job, moved_as, samples);
    for (double& life : lives) life += std::log10(row.repeat_seconds / 3600);
    return lives;
  } catch (const std::invalid_argument& problem) {
    row.failure =
        fmt::format("{}: attribute 'life_response' is no response ({}); make the file again with dresslife-fatigue",
                    row.life_file.string(), problem.what());
    return {};
  }
}

/// Returns, (job), the number of other jobs it outlives, mean over the samples; equal lives count half for each.
std::vector<double> outlived(std::span<const std::vector<double>> lives) {
  std::vector<double> count(lives.size(), 0.0);
  std::vector<std::size_t> order = indices_of(lives.size());
  const std::size_t samples = lives.front().size();
  for (std::size_t s = 0; s < samples; ++s) {
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return lives[a][s] < lives[b][s]; });
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
      while (end < order.size() && lives[order[end]][s] == lives[order[first]][s]) ++end;
      for (std::size_t k = first; k < end; ++k) count[order[k]] += double(first + end - 1) / 2 / double(samples);
    }
  }
  return count;
}

/// Orders the jobs whose p10 is longer than the robot's life. They need no replacement, and their p10 is not shown, so they
/// are ordered by the number of jobs that they outlive, mean over the samples. lives: (row, sample).
void order_beyond_robot(std::vector<RankingRow>& rows, std::vector<std::vector<double>>& lives) {
  std::size_t beyond = 0;
  while (beyond < rows.size() && !lives[beyond].empty() &&
         rows[beyond].headline_hours() > rows[beyond].robot_life_hours)
    ++beyond;
  if (beyond < 2) return;
  const std::vector<double> count = outlived(std::span(lives).first(beyond));
  std::vector<RankingRow> sorted_rows;
  std::vector<std::vector<double>> sorted_lives;
  for (const std::size_t k : largest_first(count))
    sorted_rows.push_back(std::move(rows[k])), sorted_lives.push_back(std::move(lives[k]));
  std::move(sorted_rows.begin(), sorted_rows.end(), rows.begin());
  std::move(sorted_lives.begin(), sorted_lives.end(), lives.begin());
}

/// Sets the order of the jobs beyond the robot's life, the ranks, and the share of samples in which each job outlives the next.
/// Parameters that jobs share have the same samples in all of them. A job shares the rank of the first job before it from
/// which it cannot be separated. More jobs have fewer samples each; more than `most` jobs are not compared.
void report_orders(std::vector<RankingRow>& rows) {
  // 500 samples: a share of 90 % is known to 1.3 %. 10,000 jobs then take 1.5 s for each failure mode.
  constexpr std::size_t most = 20'000, samples_in_all = 2'000'000, fewest = 500;
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].rank = rows[k].done() && rows[k].has_wires() ? k + 1 : 0;
  if (rows.empty() || rows.size() > most) return;
  const std::size_t samples = std::clamp(samples_in_all / rows.size(), fewest, life_samples);
  std::map<std::string_view, std::string_view> moved_as;  // the first job by the recipe of its simulation
  std::vector<std::vector<double>> lives = mapped(rows, [&](RankingRow& row) {
    const std::string_view first =
        row.simulated.empty() ? row.job : moved_as.try_emplace(row.simulated, row.job).first->second;
    return lives_of(row, std::string(first), samples);
  });
  order_beyond_robot(rows, lives);
  const std::vector<double>*before = nullptr, *leader = nullptr;
  std::size_t rank = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool known = !lives[k].empty();
    if (known && before) rows[k - 1].outlives_next = share_outliving(*before, lives[k]);
    const bool equal = k > 0 && rows[k].headline_hours() == rows[k - 1].headline_hours() &&
                       rows[k].life_hours == rows[k - 1].life_hours;
    const bool tied = known ? leader && share_outliving(*leader, lives[k]) < separated_share : equal;
    if (!tied) leader = known ? &lives[k] : nullptr, rank = k + 1;
    if (rows[k].rank) rows[k].rank = rank;
    before = known ? &lives[k] : nullptr;
  }
}

bool better(const RankingRow& one, const RankingRow& other) {
  if (one.done() != other.done()) return one.done();
  if (one.stale != other.stale) return one.stale;
  if (one.has_wires() != other.has_wires()) return one.has_wires();
  if (one.has_wires() && one.headline_hours() != other.headline_hours())
    return one.headline_hours() > other.headline_hours();
  if (one.has_wires() && one.life_hours != other.life_hours) return one.life_hours > other.life_hours;
  return one.job < other.job;
}

std::vector<RankingRow> sorted_rows(const std::vector<JobResult>& results) {
  std::vector<RankingRow> rows = mapped(results, read_row);
  std::ranges::stable_sort(rows, better);
  return rows;
}

std::string bounds_text(const RankingRow& row) {
  const bool planned = !std::isnan(row.glued_hours[0]);
  return shown_range(row, planned ? row.glued_hours[0] : row.hours_of(row.life_repeats_all_stick),
                     planned ? row.free_hours[0] : row.hours_of(row.life_repeats_all_free));
}

std::string planned_text(const RankingRow& row, std::size_t share) {
  return row.planned() ? shown_life(row, row.planned_hours[share]) : "-";
}

/// Returns the paragraphs below the table of one job.
std::vector<std::string> paragraphs(const RankingRow& row) {
  std::vector<std::string> all;
  if (row.stale)
    all.push_back(stale_words(row));
  else if (!(row.done() || row.waits()))
    all.push_back(row.failure);
  if (!row.has_result()) return all;
  if (row.done())
    if (const std::string kinds = warning_kinds(row); !kinds.empty()) all.push_back("WARNING: " + kinds);
  all.insert(all.end(), {held_words(row), uncapped_words(row), repeat_words(row), uncertainty_words(row),
                         failure_words(row), own_values_words(row)});
  if (!row.not_evaluated.empty() && action_words(row).find(row.not_evaluated) == std::string::npos)
    all.push_back(fmt::format("Not evaluated: {}.", row.not_evaluated));
  if (row.done() && row.relative) all.push_back(relative_words(*row.relative));
  if (row.done()) all.push_back(order_words(row));
  std::erase(all, "");
  return all;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char letter) { return letter == '\n' || letter == '\r' || letter == '\t'; }, ' ');
  return text;
}

}  // namespace

bool RankingRow::force_ok() const {
  return largest_force_share.value_or(0) <= believable_share && clamp_moment_share.value_or(0) <= believable_share;
}

const UnvalidatedMode* RankingRow::unvalidated_mode(std::string_view mode) const {
  // Most kinks and corkscrews never occur at the median, so the early hours and the share decide.
  const auto order = [](const UnvalidatedMode& of) { return std::tuple(of.hours[1], of.hours[0], -of.first_share); };
  const UnvalidatedMode* first = nullptr;
  for (const UnvalidatedMode& one : unvalidated)
    if (one.mode == mode && (!first || order(one) < order(*first))) first = &one;
  return first;
}

std::string relative_words(const RelativeLife& relative) {
  const double hours = relative.hours();
  return fmt::format("one hour does the damage of {} rated cycles of {}; {} rated: {} ({})",
                     readable(relative.cycles_per_hour), relative.cable, readable(relative.rated_cycles),
                     hours_text(hours), relative.rig);
}

std::vector<RankingRow> read_ranking(const std::vector<JobResult>& results) {
  std::vector<RankingRow> rows = sorted_rows(results);
  report_orders(rows);
  return rows;
}

std::vector<RankingRow> ranking_of(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states) {
  std::vector<RankingRow> rows = results_of(study, places, states);
  report_orders(rows);
  return rows;
}

std::vector<RankingRow> results_of(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states) {
  std::vector<JobResult> results;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    JobResult result{job.name,          places.life(job.name), first_problem(job), states[k].settings,
                     states[k].results, states[k].has_last,    states[k].changed};
    if (states[k].done()) result.simulated = states[k].recipes[0];
    const bool found = states[k].done() || states[k].has_last;
    if (found && states[k].keep == Keep::lives && !state_of(result.life_file).exists()) result.life_file.clear();
    if (job.failure.empty() && !states[k].done())
      result.failure = !states[k].failure.empty() ? states[k].failure
                       : states[k].has_last       ? "stale"
                                                  : states[k].words().line();
    results.push_back(std::move(result));
  }
  std::vector<RankingRow> rows = sorted_rows(results);
  std::map<std::string_view, const StudyJob*> jobs;
  for (const StudyJob& job : study.jobs) jobs.emplace(job.name, &job);
  for (RankingRow& row : rows) {
    const auto job = jobs.find(row.job);
    if (job == jobs.end()) continue;
    if (job->second->job) row.held_joint = job->second->job.with(Piece::motion).motion.hold_joint;
    if (job->second->values.size() != study.varied.size()) continue;
    for (std::size_t k = 0; k < study.varied.size(); ++k)
      row.varied.emplace_back(study.varied[k], job->second->values[k]);
  }
  return rows;
}

std::string stale_words(const RankingRow& row) {
  if (row.waits())
    return "stale: since this result " +
           (row.changed.empty() ? "its settings, a file or a program changed" : row.changed);
  return fmt::format("stale: with the present settings it failed: {}{}", row.failure,
                     row.changed.empty() ? "" : "; since this result " + row.changed);
}

std::string force_words(const RankingRow& row) {
  if (row.force_ok()) return "";
  std::vector<std::string> parts;
  if (row.largest_force_share.value_or(0) > believable_share)
    parts.push_back(fmt::format("cables carry {:.2f} of their breaking force", *row.largest_force_share));
  if (row.clamp_moment_share.value_or(0) > believable_share)
    parts.push_back(fmt::format("bend the clamps {:.2g} times as much as the hose does", *row.clamp_moment_share));
  return joined(parts, " and ");
}

std::string ranking_csv(const std::vector<RankingRow>& rows) {
  std::string text = joined(mapped(ranking_columns(), &RankingColumn::name), ",") + '\n';
  for (const RankingRow& row : rows) {
    const auto cell = [&](const RankingColumn& column) { return csv_cell(column.text(row)); };
    text += fmt::format("{}\n", joined(mapped(ranking_columns(), cell), ","));
  }
  return text;
}

std::string ranking_table(const std::vector<RankingRow>& rows, std::size_t width) {
  constexpr std::size_t shown_at_length = 3;  // number of jobs of a long ranking that have sentences on the terminal
  std::array<Column, 7> columns{{{"", true, {}},
                                 {"job", false, {}},
                                 {"replace after [h]", true, {}},
                                 {"calendar", true, {}},
                                 {"half failed [h]", true, {}},
                                 {"90 % failed [h]", true, {}},
                                 {"replace if glued .. free [h]", true, {}}}};
  const ShownRows selected = shown_rows(rows);
  for (const std::size_t k : selected.indices) {
    const RankingRow& row = rows[k];
    const std::array<std::string, 7> cells =
        row.has_result()
            ? std::array<std::string, 7>{row.rank ? std::to_string(row.rank) : "-",
                                         one_line(row.job),
                                         std::string(row.stale ? "stale " : "") + plan_mark(row) +
                                             shown_life(row, row.headline_hours()),
                                         shown_calendar(row),
                                         planned_text(row, 1),
                                         planned_text(row, 2),
                                         bounds_text(row)}
            : std::array<std::string, 7>{"-", one_line(row.job), row.waits() ? row.failure : "failed", "", "", "", ""};
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].cells.push_back(cells[i]);
  }
  // A name that does not fit into the table is printed on its own line above the job's numbers.
  std::size_t numbers = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) numbers += i == 1 ? 0 : columns[i].width() + 2;
  std::vector<std::string> above(selected.indices.size());
  for (std::size_t k = 0; k < above.size(); ++k)
    if (std::string& name = columns[1].cells[k]; numbers + columns_of(name) > width) above[k].swap(name);
  const std::string indent(columns[0].width() + 2, ' ');
  const auto below = [&](const std::string& words) { return wrapped(one_line(words), width, indent); };
  std::string text, details;
  std::vector<RankingRow> detailed;  // rows with a table of modes
  if (rows.size() == 1 && rows[0].done()) {
    const std::string action = action_words(rows[0]);
    const bool can_move = action.starts_with("Plan") && !rows[0].worst_joint.empty();
    const std::string longer =
        can_move
            ? fmt::format(
                  " dresslife improve {0} searches for better clamps and lengths, dresslife reprogram {0} for gentler moves.",
                  job_file(rows[0]))
            : "";
    text += wrapped(action + longer, width, "") + '\n';
  }
  text += table_line(columns, [](const Column& column) { return column.title; });
  for (std::size_t i = 0; i < selected.indices.size(); ++i) {
    const RankingRow& row = rows[selected.indices[i]];
    if (i > 0 && selected.indices[i] != selected.indices[i - 1] + 1) text += indent + "(more)\n";
    if (!above[i].empty()) text += indent + above[i] + '\n';
    text += table_line(columns, [i](const Column& column) { return column.cells[i]; });
    if (row.done() && selected.indices[i] >= shown_at_length && !selected.summary.empty()) continue;
    std::string words;
    if (const std::string action = action_words(row); rows.size() > 1 && row.done() && !action.starts_with("Plan"))
      words += below(action);
    if (const std::string modes = row.has_result() ? mode_table(row, width, indent) : ""; !modes.empty())
      words += modes + '\n', detailed.push_back(row);
    for (const std::string& paragraph : paragraphs(row)) words += below(paragraph);
    if (!words.empty()) details += '\n' + (rows.size() > 1 ? one_line(row.job) + '\n' : "") + words;
  }
  if (const std::string note = rows.size() > 1 ? marks_note(rows) : ""; !note.empty())
    text += wrapped(one_line(note), width, indent);
  text += wrapped(
      "h: hours of motion. glued .. free: 'replace after' if the parts inside the cables cannot slide, and if they slide "
      "without friction.",
      width, indent);
  text += details;
  if (const std::string legend = mode_legend(detailed, width, indent); !legend.empty()) text += '\n' + legend;
  std::string estimates;
  for (const std::string& one : estimate_words(rows)) estimates += wrapped(one_line(one), width, "");
  if (!estimates.empty()) text += '\n' + shown(estimates);
  if (const std::string remarks = comparison_words(rows); !remarks.empty()) text += '\n' + wrapped(remarks, width, "");
  return selected.summary.empty() ? text : text + '\n' + selected.summary;
}

namespace {

constexpr std::size_t short_ranking = 40;  // jobs of two to four lines each: a reader still reads them all
constexpr std::size_t best = 3, worst = 10, failed = 10, warned = 10;

/// Returns the number of rows in [begin, end) for which `counts` is true; appends the first `most` of them to `shown`.
template <class Counts>
std::size_t take(const std::vector<RankingRow>& rows, std::size_t begin, std::size_t end, std::size_t most,
                 std::set<std::size_t>& shown, const Counts& counts) {
  std::size_t found = 0;
  for (std::size_t k = begin; k < end; ++k)
    if (counts(rows[k]) && ++found <= most) shown.insert(k);
  return found;
}

}  // namespace

ShownRows shown_rows(const std::vector<RankingRow>& rows) {
  if (rows.size() <= short_ranking) return {indices_of(rows.size()), ""};
  const auto first_failed = std::partition_point(rows.begin(), rows.end(), [](const auto& row) { return row.done(); });
  const auto done = static_cast<std::size_t>(first_failed - rows.begin());
  const auto any = [](const RankingRow&) { return true; };
  std::set<std::size_t> shown;
  take(rows, 0, done, best, shown, any);
  take(rows, done - std::min(done, worst), done, worst, shown, any);
  const std::size_t of_warning =
      take(rows, 0, done, warned, shown, [](const RankingRow& row) { return !warnings_of(row).empty(); });
  take(rows, done, rows.size(), failed, shown, any);
  return {{shown.begin(), shown.end()},
          fmt::format(
              "{} jobs: {} done, {} of them warned of, {} not done; shown are the best {}, the worst {} and the first "
              "{} warned of and {} not done, all are in ranking.csv and the report\n",
              rows.size(), done, of_warning, rows.size() - done, best, worst, warned, failed)};
}

}  // namespace dresslife::pipeline
