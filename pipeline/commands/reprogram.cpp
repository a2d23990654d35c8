#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/other_ways.h"
#include "pipeline/advise/improve/set_text.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/report/life_charts.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/stage_program.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t ways_shown = 12;  // on the terminal; the table contains all

struct ReprogramOptions : RunOptions {
  int lines = 4;
};

/// One alternative that was simulated.
struct TriedWay {
  OtherWay way;
  Outcome outcome;
  double seconds = 0;  ///< duration of a repeat [s]
  std::string doubt;   ///< kinds of the warnings that make its life wrong; empty: none
  std::string patch;   ///< unified diff of the program; empty: the motion is a list of steps
  fs::path file;       ///< file with the patch
  double error = 1;    ///< numerical error of the life, a factor
};

std::vector<double> cost_of_lines(const fs::path& life_file) {
  const LifeSummary life = read_life(life_file);
  std::vector<double> cost = life.step_damage;
  for (std::size_t k = 0; k < cost.size() && k < life.step_opened.size(); ++k) cost[k] += life.step_opened[k];
  return cost;
}

/// Returns the ratio of the life to the life before; 1 if both have no damage.
double times_as_long(const TriedWay& tried, const TriedWay& before) {
  return std::isinf(before.outcome.hours) && std::isinf(tried.outcome.hours)
             ? 1
             : tried.outcome.hours / before.outcome.hours;
}

/// Returns the merit with all lives in hours at the pace of the original program: a slower program lives longer in hours even if each
/// repeat does the same damage.
Merit merit_at_pace(const TriedWay& tried, const TriedWay& before) {
  Outcome at_pace = tried.outcome;
  const double pace = tried.seconds > 0 ? before.seconds / tried.seconds : 1;
  at_pace.hours *= pace;
  for (ModeLife& mode : at_pace.modes) mode.hours *= pace;
  return merit_of(at_pace, before.outcome);
}

bool helps(const TriedWay& tried, const TriedWay& before) {
  return tried.outcome.feasible() && (tried.doubt.empty() || !before.doubt.empty()) &&
         clearly_better(merit_at_pace(tried, before), merit_at_pace(before, before));
}

/// Returns "; bend radius violated by ..; abrasion from 1,080 h; not periodic": limits, the first mode, warnings.
/// before: doubts of the original program are not repeated.
std::string remarks(const TriedWay& tried, const TriedWay* before = nullptr) {
  std::string text = tried.outcome.feasible() ? "" : "; " + tried.outcome.words();
  if (const ModeLife mode = first_mode(tried.outcome); !mode.mode.empty())
    text += fmt::format("; {} from {}", mode.mode, hours_text(mode.hours));
  if (tried.outcome.feasible() && !tried.doubt.empty() && !(before && before->doubt == tried.doubt))
    text += "; do not plan with it: " + tried.doubt;
  return text;
}

std::string lines_words(const OtherWay& way) { return way.lines.empty() ? "all lines" : joined(way.lines, "; "); }

/// Returns the same with successive lines of a file as "welding.mod:45..54".
std::string spans_words(const OtherWay& way) {
  OtherWay spans = way;
  spans.lines.clear();
  std::string next;  // the line after the last one of the present span
  for (const std::string& line : way.lines) {
    const std::size_t number = line.rfind(':') + 1;
    const bool is_unnamed = line.find_first_not_of("0123456789", number) == std::string::npos;
    if (line == next)
      spans.lines.back() =
          spans.lines.back().substr(0, spans.lines.back().find("..", number)) + ".." + line.substr(number);
    else
      spans.lines.push_back(line);
    next = is_unnamed ? line.substr(0, number) + std::to_string(std::atoi(line.c_str() + number) + 1) : "";
  }
  return lines_words(spans);
}

std::string csv_of(const TriedWay& before, const std::vector<TriedWay>& ways) {
  std::string text =
      "lines,way,life_hours_p10,times_as_long,cycle_s,cycle_won_s,beyond,sets,patch,first_mode,first_mode_hours,doubt\n";
  for (const TriedWay& tried : ways) {
    const bool ran = tried.outcome.failure.empty();
    const ModeLife mode = first_mode(tried.outcome);
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(lines_words(tried.way)),
                        csv_cell(tried.way.what), ran ? shortest_text(tried.outcome.hours) : "",
                        ran ? shortest_text(times_as_long(tried, before)) : "", ran ? shortest_text(tried.seconds) : "",
                        ran ? shortest_text(before.seconds - tried.seconds) : "", csv_cell(tried.outcome.words()),
                        csv_cell(joined(tried.way.sets, "; ")), csv_cell(tried.file.filename().string()),
                        csv_cell(mode.mode), mode.mode.empty() ? "" : shortest_text(mode.hours), csv_cell(tried.doubt));
  }
  return text;
}

/// Returns a sentence if all gains are smaller than the numerical error of the life; else an empty text.
std::string error_words(const TriedWay& before, const std::vector<TriedWay>& ways) {
  double gain = 0;
  for (const TriedWay& tried : ways)
    if (tried.outcome.failure.empty()) gain = std::max(gain, times_as_long(tried, before));
  if (!(gain > 0 && gain < before.error)) return "";
  return fmt::format(
      "  The largest gain ({:.3g} x) is below the numerical error of these lives (a factor of {}): it may be chance.\n",
      gain, readable(before.error, 2));
}

std::string table_of(const std::string& job, const TriedWay& before, const std::vector<TriedWay>& ways) {
  std::string text =
      fmt::format("{}: {} h, {:.1f} s{}\n", job, readable(before.outcome.hours), before.seconds, remarks(before));
  if (before.outcome.hours >= before.outcome.robot_life)
    text += fmt::format(
        "  The wires outlive the robot ({} h, fatigue.robot_life_hours): a longer life of the wires has no use. A mode that comes later has, and a shorter cycle may have.\n",
        readable(before.outcome.robot_life));
  text += fmt::format("  {:>10} {:>10}  {}\n", "life", "cycle", "way");
  for (std::size_t k = 0; k < std::min(ways_shown, ways.size()); ++k) {
    const TriedWay& tried = ways[k];
    if (!tried.outcome.failure.empty()) break;
    text +=
        fmt::format("  {:>8.3g} x {:>+8.2f} s  {}: {}{}\n", times_as_long(tried, before),
                    tried.seconds - before.seconds, spans_words(tried.way), tried.way.what, remarks(tried, &before));
    if (!tried.file.empty())
      text += fmt::format("  {:>24}patch: {}, {}\n", "", tried.file.string(),
                          tried.patch.substr(0, tried.patch.find('\n')));  // for patch -p1 in FOLDER
  }
  text +=
      "  life: of the wires, in hours of motion. The first way is the best by limits, lives in repeats, and modes that are not validated.\n";
  text += error_words(before, ways);
  if (const auto failed =
          std::ranges::count_if(ways, [](const TriedWay& tried) { return !tried.outcome.failure.empty(); });
      failed > 0)
    text += fmt::format("  {} of {} ways do not run (see the table).\n", failed, ways.size());
  if (!ways.empty() && std::ranges::none_of(ways, [](const TriedWay& tried) { return tried.outcome.feasible(); }))
    text += "  No way keeps all limits. Cure the job first: dresslife check names a remedy.\n";
  return text;
}

std::string doubt_of(const RankingRow& row) {
  std::vector<std::string> kinds;
  for (const Warning& warning : warnings_of(row))
    if (spoils_plan(warning.kind) && std::ranges::find(kinds, title(warning.kind)) == kinds.end())
      kinds.emplace_back(title(warning.kind));
  return joined(kinds, ", ");
}

TriedWay seen(const RankingRow& row, const StudyPlaces& places) {
  return {{},
          outcome_of(row, places.job(row.job)),
          row.done() ? row.repeat_seconds : 0,
          row.done() ? doubt_of(row) : "",
          {},
          {},
          row.done() && std::isfinite(row.planned_errors[0]) ? row.planned_errors[0] : 1};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  return lines;
}

/// Returns the alternatives for a job whose motion is a program, with the text of the patched program. Prints the
/// number of alternatives that the program cannot express.
std::vector<TriedWay> program_ways_of(const Job& job, const fs::path& life_file, const ReprogramOptions& options) {
  const PassingFile described("job.yaml"), noted("ways.h5");
  write_text_if_changed(described.path(), with_mark(job_text(job), Mark::yaml), Sync::never);
  if (run_stage_program("dresslife-import",
                        {described.path().string(), "--ways", fs::absolute(life_file).string(), "--lines",
                         std::to_string(options.lines), "-o", noted.path().string(), "--quiet"}) != 0)
    throw InputError({job.motion.program.string()}, "has no other ways (see above)", "correct the errors above");
  const FileReader file(noted.path(), ways_format());
  const auto what = file.read<std::string>("/way/what"), lines = file.read<std::string>("/way/lines"),
             motions = file.read<std::string>("/way/motion"), patches = file.read<std::string>("/way/patch");
  std::vector<TriedWay> ways;
  for (std::size_t k = 0; k < what.size(); ++k)
    ways.push_back({{what[k], lines_of(lines[k]), {"motion=" + set_text(parse_yaml(motions[k], noted.path()))}},
                    {},
                    0,
                    {},
                    patches[k],
                    {}});
  std::map<std::string, int> refused;
  for (const std::string& why : file.read<std::string>("/refusal/words")) ++refused[why];
  for (const auto& [why, count] : refused) write_stderr(fmt::format("{} ({} ways are not tried)\n", why, count));
  return ways;
}

std::vector<TriedWay> ways_of(const Job& job, const fs::path& life_file, const ReprogramOptions& options) {
  if (!job.motion.program.empty()) return program_ways_of(job, life_file, options);
  std::vector<TriedWay> ways;
  for (OtherWay& way : other_ways(job, cost_of_lines(life_file), static_cast<std::size_t>(options.lines)))
    ways.push_back({std::move(way), {}, 0, {}, {}, {}});
  return ways;
}

/// Writes a patch beside the table for each alternative that helps, and removes the patches of an earlier run.
void write_patches(const StudyPlaces& places, const std::string& job, const TriedWay& before,
                   std::vector<TriedWay>& ways) {
  const auto name = [&](int number) { return places.folder / fmt::format("{}_{:02}.patch", job, number); };
  int number = 0;
  for (TriedWay& tried : ways) {
    if (tried.patch.empty() || !helps(tried, before)) continue;
    tried.file = name(++number);
    write_text_if_changed(tried.file, with_mark(tried.patch, Mark::yaml));
  }
  while (fs::exists(name(++number)) && remove_ours(name(number))) {
  }
}

/// Returns the simulated alternatives for one job of the study, best first.
std::vector<TriedWay> tried_ways(const ImproveRequest& request, std::size_t job, const StudyJob& base,
                                 const TriedWay& before, const StudyPlaces& places, const ReprogramOptions& options) {
  const std::vector<TriedWay> ways = ways_of(*base.job, places.life(base.name), options);
  Study study{base.name, {}};
  std::map<std::string, std::size_t> way_of;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    StudyJob changed = changed_jobs(request, ways[k].way.sets, "way").at(job);
    changed.name = fmt::format("{}_way_{:02}", base.name, k + 1);
    way_of[changed.name] = k;
    study.jobs.push_back(std::move(changed));
  }
  std::vector<TriedWay> tried;
  if (study.jobs.empty()) return tried;
  for (const RankingRow& row : made_rows(study, places, options)) {
    TriedWay way = seen(row, places);
    way.way = ways[way_of.at(row.job)].way;
    way.patch = ways[way_of.at(row.job)].patch;
    if (!way.patch.empty()) way.way.sets.clear();  // the patch contains these changes
    tried.push_back(std::move(way));
  }
  std::ranges::stable_sort(
      tried, [&](const TriedWay& a, const TriedWay& b) { return merit_at_pace(a, before) > merit_at_pace(b, before); });
  return tried;
}

int reprogram(const ReprogramOptions& options) {
  ImproveRequest request;
  request.file = named_study(options.study);
  request.sets = options.sets;
  check_sets(request.file, options.sets, options.quiet);
  const std::string name = study_name(request.file);
  const OwnFolder own(options, name + "_reprogram", request.file);
  const StudyPlaces& places = own.places;
  Study study{name, changed_jobs(request, {}, "as_it_is")};
  require_wires(study, {request.file.string()});
  int failed = 0;
  const std::vector<RankingRow> rows = made_rows(study, places, options);
  for (std::size_t k = 0; k < study.jobs.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    const TriedWay before = seen(*find_in(rows, &RankingRow::job, job.name), places);
    if (!before.outcome.failure.empty()) {
      write_stderr(fmt::format("{}: error: it does not run: {}\n", job.name, before.outcome.failure));
      ++failed;
      continue;
    }
    std::vector<TriedWay> ways = tried_ways(request, k, job, before, places, options);
    write_patches(places, job.name, before, ways);
    const fs::path table = places.folder / (job.name + ".csv");
    write_text_if_changed(table, csv_of(before, ways));
    print(shown(table_of(job.name, before, ways) + fmt::format("Ways: {}\n", table.string())));
  }
  return failed ? 1 : 0;
}

}  // namespace

Command reprogram_command() {
  const auto options = std::make_shared<ReprogramOptions>();
  return {"reprogram",
          "try what the program could do instead: the lines that cost most by other turns of wrist and arm, by "
          "a point, or slower; of a robot program, patches in its own language are written for the ways that help",
          joined({{study_or_job(*options),
                   number_option("--lines", "COUNT", "of the program that are tried, those first that cost most",
                                 &options->lines, 0, 1000)},
                  run_options(*options),
                  {launcher_option(*options)},
                  study_options(*options)}),
          [options] { return reprogram(*options); }};
}

}  // namespace dresslife::pipeline
