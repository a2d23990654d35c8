#include "pipeline/advise/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "pipeline/advise/plan/doubtful_plan.h"
#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/advise/plan/value_of_checks.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/duties_run.h"
#include "pipeline/job/job.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/report/plan_page.h"
#include "pipeline/settings/problems.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct PlanOptions : RunOptions {
  std::string fleet, windows, today, what_if, what_if_from;
  std::optional<double> risk_percent;
};

/// Returns the day on which the duties of the other fleet table begin.
Day change_day(const PlanOptions& options, Day today) {
  const char* const option = "--what-if-from";
  if (options.what_if_from.empty()) return today;
  if (options.what_if.empty()) throw InputError({option}, "no table begins on this day", "add --what-if OTHER.csv");
  const Day from = day_of(option, options.what_if_from);
  if (from < today)
    throw InputError({option},
                     fmt::format("{} is before {}, the first day of the plan", day_text(from), day_text(today)),
                     "give a later day");
  return from;
}

std::vector<Warning> doubts_of(std::optional<double> risk_percent) {
  constexpr double least = 1, most = 50;  // per cent in one interval
  if (!risk_percent || (*risk_percent >= least && *risk_percent <= most)) return {};
  return {warning_of(WarningKind::motion, "--risk",
                     fmt::format("the risk is {:g} % (limit {:g} .. {:g})", *risk_percent, least, most),
                     *risk_percent == 0      ? "a plan without any failure: a new dresspack may fail, too"
                     : *risk_percent < least ? "a share instead of per cent"
                                             : "a dresspack is hardly ever replaced",
                     *risk_percent == 0      ? "--risk 1"
                     : *risk_percent < least ? fmt::format("--risk {:g} if that was a share", 100 * *risk_percent)
                                             : "--risk 10")};
}

constexpr std::size_t most_named = 3;  // duties or programs that are named; a plant may have hundreds

/// Returns "one, two, three, and 4 more".
std::string first_of(const std::vector<std::string>& all) {
  std::vector<std::string> named(all.begin(),
                                 all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_named)));
  if (all.size() > most_named) named.push_back(fmt::format("and {} more", all.size() - most_named));
  return joined(named, ", ");
}

/// Returns the duties whose programs have warnings that make a plan unreliable, then those with doubtful input.
std::vector<std::string> doubts(const std::vector<DutyResult>& duties) {
  std::vector<std::string> unreliable, unconfirmed;
  for (const DutyResult& duty : duties)
    if (!duty.doubtful.empty())
      unreliable.push_back(
          fmt::format("Do not plan with duty '{}': {} (see the warnings).\n", duty.name, first_of(duty.doubtful)));
    else if (!duty.unconfirmed.empty())
      unconfirmed.push_back(
          fmt::format("Before you use the plan of duty '{}', confirm or correct {} (see the warnings).\n", duty.name,
                      first_of(duty.unconfirmed)));
  const auto shorten = [](std::vector<std::string>& lines, const char* more) {
    if (lines.size() <= most_named) return;
    const std::size_t others = lines.size() - most_named;
    lines.resize(most_named);
    lines.push_back(fmt::format(fmt::runtime(more), others));
  };
  shorten(unreliable, "Do not plan with {} more duties that have such programs.\n");
  shorten(unconfirmed, "Confirm or correct the doubtful input of {} more duties.\n");
  unreliable.insert(unreliable.end(), unconfirmed.begin(), unconfirmed.end());
  return unreliable;
}

/// Returns the doubts with the first warnings behind them, each once, for the page.
std::vector<std::string> doubts_with_warnings(const std::vector<DutyResult>& duties) {
  std::vector<std::string> lines = doubts(duties);
  const std::size_t all = lines.size() + most_named;
  for (const DutyResult& duty : duties)
    for (const std::string& warning : duty.warnings)
      if (lines.size() < all && std::ranges::find(lines, warning) == lines.end()) lines.push_back(warning);
  return lines;
}

/// Returns the cautions about the duties with the earliest modes that no test validates.
std::vector<std::string> cautions(const std::vector<DutyResult>& duties) {
  std::vector<std::pair<double, const DutyResult*>> order;
  for (const DutyResult& duty : duties) {
    const double first = smallest_of(duty.others, std::numeric_limits<double>::infinity(), &DutyMode::hours);
    if (!caution_words(duty).empty()) order.emplace_back(first, &duty);
  }
  const std::size_t named = std::min(order.size(), most_named);
  if (order.size() > most_named)
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < named; ++k)
    texts.push_back(order[k].second->name + ":\n" + caution_words(*order[k].second));
  if (order.size() > named)
    texts.push_back(
        fmt::format("{} more duties have such modes later, or other parts without a life; dresslife duty lists them.\n",
                    order.size() - named));
  return texts;
}

/// Returns whether the samples come from a calibration with the table of a maintenance system.
bool knows_survivors(const Study& study) {
  return std::ranges::any_of(study.jobs, [](const StudyJob& one) {
    return one.job && one.job.with(Piece::rest).calibration && counts_survivors(*one.job.with(Piece::rest).calibration);
  });
}

/// Returns, by duty, the life of the dresspack that abrasion ends first.
std::map<std::string, AbrasionLife> abrasion_lives(const std::vector<DutyResult>& duties) {
  std::map<std::string, AbrasionLife> lives;
  for (const DutyResult& duty : duties)
    for (const DutyMode& mode : duty.others) {
      if (mode.mode != UnvalidatedMode::abrasion || std::isnan(mode.visible_from)) continue;
      const auto [found, is_new] = lives.try_emplace(duty.name);
      if (is_new || mode.median < found->second.median)
        found->second = {mode.hours, mode.median, mode.visible_from, duty.inspection};
    }
  return lives;
}

/// Returns, by duty, the age limits of abrasion and jacket wear, which an inspection can see.
std::map<std::string, std::vector<AgeLimit>> age_limits(const std::vector<DutyResult>& duties) {
  std::map<std::string, std::vector<AgeLimit>> limits;
  for (const DutyResult& duty : duties)
    for (const DutyMode& mode : duty.others)
      if (mode.mode == UnvalidatedMode::abrasion || mode.mode == UnvalidatedMode::jacket ||
          mode.mode == UnvalidatedMode::wall)
        limits[duty.name].push_back(
            {mode.dresspack.empty() ? mode.mode : mode.mode + " of " + mode.dresspack, mode.hours});
  return limits;
}

std::map<std::string, double> week_hours_of(const std::vector<DutyResult>& duties) {
  std::map<std::string, double> hours;
  for (const DutyResult& duty : duties) hours[duty.name] = duty.hours_per_week;
  return hours;
}

/// Returns the joined texts, followed by an empty line if there are any.
std::string block(const std::vector<std::string>& texts) {
  return fmt::format("{}{}", joined(texts, ""), texts.empty() ? "" : "\n");
}

int plan(const PlanOptions& options) {
  const Day day = options.today.empty() ? today() : day_of("--today", options.today), from = change_day(options, day);
  note_input(options.fleet);
  Fleet fleet = read_fleet(options.fleet, day);
  const std::vector<Window> windows = windows_from(options.windows, day);
  if (const Day end = end_of(windows, day); from >= end)
    throw InputError({"--what-if-from"},
                     fmt::format("{} is not before {}, the end of the plan", day_text(from), day_text(end)),
                     "give an earlier day, or later windows");
  const DutyFile file = read_duties(named_file(options.study, "duties"), day);
  std::set<std::string> needed;
  std::optional<Fleet> changed;
  Problems problems;
  const auto need_duties = [&](const Fleet& of) {
    for (const Installed& row : of.rows)
      problems.attempt("", row.where, [&] { needed.insert(duty_named(file, row.duty, row.where).name); });
  };
  if (!options.what_if.empty()) {
    note_input(options.what_if);
    changed = read_fleet(options.what_if, day);
    if (changed->has_costs != fleet.has_costs)
      throw InputError({options.what_if, 1, 1},
                       fmt::format("has {}costs, but {} has {}", fleet.has_costs ? "no " : "", options.fleet,
                                   fleet.has_costs ? "some" : "none"),
                       "give both tables the columns planned_cost and unplanned_cost, or none");
    need_duties(*changed);
  }
  need_duties(fleet);
  problems.finish(options.fleet);
  if (!fleet.renamed.empty())
    write_stderr(shown(fmt::format("note: {}: columns {}\n", options.fleet, joined(fleet.renamed, ", "))));
  if (!fleet.unused.empty())
    write_stderr(shown(
        fmt::format("note: {}: a plan does not use the columns {}\n", options.fleet, joined(fleet.unused, ", "))));
  if (!fleet.comments.empty())
    write_stderr(shown(fmt::format("note: {}: comments, because they begin with #: lines {}\n", options.fleet,
                                   fmt::join(fleet.comments, ", "))));
  const std::set<std::string> planned = needed;
  bool has_changes = changed.has_value();  // whether the duty of a dresspack changes
  for (const Duty& duty : file.duties)
    for (const PastDuty& past : duty.history)
      if (planned.contains(duty.name)) needed.insert(past.duty), has_changes = true;
  for (const Warning& warning :
       joined(doubts_of(options.risk_percent), joined(doubtful_fleet(fleet, day), doubtful_duties(file))))
    write_stderr(shown(warning.paragraph()));
  const DutiesRun made = run_duties(file, options);
  const PlantLives lives_of_plant(file, made.study, made.rows, needed);
  std::map<std::string, LifeTable> tables = lives_of_plant.in(usual_worlds, usual_draws, has_changes);
  for (const auto& [name, table] : tables)
    if (planned.contains(name) && table.half_end_before(table.hours_per_week))
      throw InputError(
          {options.study},
          fmt::format("half of the dresspacks under duty '{}' fail within {}", name, hours_text(table.median())),
          "no plan helps; see dresslife improve");
  const std::vector<DutyResult> with_past = outlines(file, made.study, made.rows, needed);
  std::vector<DutyResult> duties = with_past;
  std::erase_if(duties, [&](const DutyResult& duty) { return !planned.contains(duty.name); });
  const auto add_past = [&](Fleet& of) {
    for (const Warning& warning : add_histories(of, file, tables, day)) write_stderr(shown(warning.paragraph()));
  };
  add_past(fleet);
  PlanRule rule{options.risk_percent.value_or(10) / 100,
                fleet.has_costs && !options.risk_percent,
                knows_survivors(made.study),
                {},
                enough_worlds};
  Plan found = plan_of(fleet, tables, windows, day, rule);
  // ages of many survivors leave few worlds with weight
  if (found.effective_worlds < enough_worlds) {
    // The estimate from few worlds is exact to a tenth. Few effective worlds need more dresspacks in each.
    constexpr double spare = 1.2, most = 4;
    const auto times =
        static_cast<std::size_t>(std::clamp(std::ceil(spare * enough_worlds / found.effective_worlds), 2.0, most));
    tables = lives_of_plant.in(times * usual_worlds, 2 * usual_draws, has_changes);
    rule.enough_worlds = fewest_worlds;
    found = plan_of(fleet, tables, windows, day, rule);
  }
  if (found.effective_worlds < fewest_worlds)
    throw InputError({options.fleet},
                     fmt::format("the ages of these dresspacks contradict the model: {:.1f} of {} samples explain them",
                                 found.effective_worlds, tables.begin()->second.worlds),
                     "learn from them first: dresslife calibrate");
  for (const Warning& warning : doubtful_hours(fleet, found, tables)) write_stderr(shown(warning.paragraph()));
  if (!rule.knows_survivors)
    for (const Warning& warning : doubtful_evidence(made.study, options.fleet))
      write_stderr(shown(warning.paragraph()));
  for (const Warning& warning : doubtful_ages(fleet, found)) write_stderr(shown(warning.paragraph()));
  std::optional<Plan> other;
  std::string what_if;
  const std::string what_if_name =
      fs::path(options.what_if).stem().string() + (from > day ? " from " + day_text(from) : "");
  if (changed) {
    add_past(*changed);
    keep_ages(*changed, fleet, tables, day, from);
    PlanRule same = rule;
    same.weights = found.weights;  // the weights of the present plant
    other = plan_of(*changed, tables, windows, day, same);
    what_if = "\n" + what_if_words(what_if_name, fleet, found, *changed, *other);
  }
  std::optional<std::vector<CheckValue>> checks;
  std::string tests;
  if (rule.by_cost) {
    tests = test_words(values_of_tests(fleet, tables, found), found);
    if (const std::map<std::string, AbrasionLife> lives = abrasion_lives(duties); !lives.empty()) {
      checks = values_of_checks(fleet, tables, abrasion_lives(with_past), found);
      tests += check_words(checks, lives.begin()->second.inspection, fleet, found);
    }
  }
  tests += age_words(fleet, found, age_limits(with_past), week_hours_of(duties));
  const std::string stem = "plan_" + fs::path(options.fleet).stem().string();
  const CsvTable rows = plan_table(fleet, found, checks);
  const fs::path table = made.places.folder / (stem + ".csv"), calendar = made.places.folder / (stem + ".ics");
  const fs::path weeks = made.places.folder / (stem + "_weeks.csv"), page = made.places.folder / (stem + ".html");
  write_text_if_changed(table, csv_text(rows));
  write_text_if_changed(weeks, plan_weeks_csv(fleet, found));
  const PlanNotes notes{doubts_with_warnings(duties), tests, cautions(duties)};
  write_text_if_changed(page, with_mark(plan_page(fs::path(options.fleet).stem().string(), fleet, found, notes,
                                                  table.filename().string()),
                                        Mark::page));
  if (other) {
    const fs::path beside = made.places.folder / (stem + "_what_if.csv"),
                   its_page = made.places.folder / (stem + "_what_if.html");
    write_text_if_changed(beside, csv_text(plan_table(*changed, *other)));
    write_text_if_changed(
        its_page, with_mark(plan_page(what_if_name, *changed, *other,
                                      {notes.doubts, "", notes.paragraphs, fs::path(options.fleet).stem().string(),
                                       beside_rows(fleet, found, *changed, *other)},
                                      beside.filename().string()),
                            Mark::page));
    what_if += fmt::format("Table: {}\nPage: {}\n", beside.string(), its_page.string());
  }
  write_text_if_changed(calendar, plan_calendar(fleet, found));
  const auto json = [&] {
    Json all{{"plan", json_of(rows)}, {"windows", json_of_windows(fleet, found)}};
    if (other)
      all.add(
          {{"what_if", json_of(plan_table(*changed, *other))}, {"what_if_windows", json_of_windows(*changed, *other)}});
    return all.text + "\n";
  };
  print(options.json
            ? json()
            : shown(fmt::format(
                        "{}{}{}\n{}Table: {} (columns: comma, decimals: point)\nWeeks: {}\nCalendar: {}\nPage: {}\n",
                        block(doubts(duties)), plan_words(fleet, found), wrapped_lines(tests, screen_columns()),
                        block(cautions(duties)), table.string(), weeks.string(), calendar.string(), page.string()) +
                    what_if));
  write_stderr(warning_lines(rows_of(file, made.rows)));
  return 0;
}

}  // namespace

Command plan_command() {
  const auto options = std::make_shared<PlanOptions>();
  return {
      "plan", "plan which dresspacks of a plant to replace in which maintenance window, and the spare parts",
      joined(
          {{{"fleet", "", "FLEET.csv", &options->fleet, {.required = true}},
            {"--duties", "DUTIES.yaml", "the duties that the table names", &options->study, {.required = true}},
            {"--windows",
             "DATES",
             "the maintenance windows: 2027-07-12..2027-08-01,2027-12-20..2028-01-02",
             &options->windows,
             {.required = true}},
            number_option(
                "--risk", "PERCENT",
                "replace a dresspack when its probability of failure before the next window is larger; default: 10, or by "
                "the costs of the table",
                &options->risk_percent, 0, 100),
            {"--what-if", "OTHER.csv", "a changed table of the same plant: its plan beside that of the first",
             &options->what_if},
            {"--what-if-from", "DATE",
             "the day on which the other duties of OTHER.csv begin; default: the first day of the plan",
             &options->what_if_from},
            {"--today", "DATE", "the first day of the plan; default: the computer's date", &options->today},
            json_option(options->json)},
           run_options(*options),
           study_options(*options)}),
      [options] { return plan(*options); }};
}

}  // namespace dresslife::pipeline
