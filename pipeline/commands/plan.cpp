#include "pipeline/advise/plan/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>

#include "pipeline/advise/plan/doubtful_plan.h"
#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/duties_run.h"
#include "pipeline/job/job.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/report/plan_page.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct Options : RunOptions {
  std::string fleet, windows, today, what_if;
  std::optional<double> risk_percent;
};

Day day_of(const std::string& text) {
  if (text.empty()) return today();
  if (const std::optional<Day> day = exported_day(text)) return *day;
  throw InputError({"--today"}, fmt::format("'{}' is no date", text), day_remedy(text));
}

std::vector<Warning> doubts_of(std::optional<double> risk_percent) {
  constexpr double least = 1, most = 50;  // per cent in one interval
  if (!risk_percent || (*risk_percent >= least && *risk_percent <= most)) return {};
  return {warning_of(
      WarningKind::motion, "--risk",
      fmt::format("the risk is {:g} % (limit {:g} .. {:g})", *risk_percent, least, most),
      *risk_percent < least ? "a share instead of per cent" : "a dresspack is hardly ever replaced",
      *risk_percent > 0 && *risk_percent < least ? fmt::format("--risk {:g} if that was a share", 100 * *risk_percent)
                                                 : "--risk 10")};
}

/// Duties whose programs have warnings that spoil a plan.
std::vector<std::string> doubts(const std::vector<DutyResult>& duties) {
  std::vector<std::string> lines;
  for (const DutyResult& duty : duties)
    if (!duty.doubtful.empty())
      lines.push_back(fmt::format("Do not plan with duty '{}': {} (see the warnings).\n", duty.name, fmt::join(duty.doubtful, ", ")));
  return lines;
}

std::vector<std::string> cautions(const std::vector<DutyResult>& duties) {
  std::vector<std::string> texts;
  for (const DutyResult& duty : duties)
    if (const std::string words = caution_words(duty); !words.empty()) texts.push_back(duty.name + ":\n" + words);
  return texts;
}

/// Whether the samples are of a calibration from a maintenance system's table.
bool knows_survivors(const Study& study) {
  return std::any_of(study.jobs.begin(), study.jobs.end(), [](const StudyJob& one) {
    return one.job && one.job->calibration && counts_survivors(*one.job->calibration);
  });
}

/// The texts one after the other, and an empty line where there are some.
std::string block(const std::vector<std::string>& texts) {
  return fmt::format("{}{}", fmt::join(texts, ""), texts.empty() ? "" : "\n");
}

int plan(const Options& options) {
  const Day day = day_of(options.today);
  note_input(options.fleet);
  const Fleet fleet = read_fleet(options.fleet, day);
  const std::vector<Window> windows = windows_from(options.windows, day);
  const DutyFile file = read_duties(named_file(options.study, "duties"));
  std::set<std::string> needed;
  std::optional<Fleet> changed;
  if (!options.what_if.empty()) {
    note_input(options.what_if);
    changed = read_fleet(options.what_if, day);
    if (changed->has_costs != fleet.has_costs)
      throw InputError({options.what_if, 1, 1}, fmt::format("has {}costs, but {} has {}", fleet.has_costs ? "no " : "", options.fleet, fleet.has_costs ? "some" : "none"),
                       "give both tables the columns planned_cost and unplanned_cost, or none");
    for (const Installed& row : changed->rows) needed.insert(duty_named(file, row.duty, row.where).name);
  }
  for (const Installed& row : fleet.rows) needed.insert(duty_named(file, row.duty, row.where).name);
  for (const Warning& warning :
       joined(doubts_of(options.risk_percent), joined(doubtful_fleet(fleet, day), doubtful_duties(file))))
    tell(shown(warning.line() + "\n"));
  const DutiesRun made = run_duties(file, options);
  std::map<std::string, LifeTable> tables = life_tables(file, made.study, made.rows, needed);
  for (const auto& [name, table] : tables)
    if (const double half = table.median(); half < table.hours_per_week)
      throw InputError({options.study}, fmt::format("half of the dresspacks under duty '{}' fail within {}", name, hours_text(half)),
                       "no plan helps; see dresslife improve");
  const std::vector<DutyResult> duties = outlines(file, made.study, made.rows, needed);
  const PlanRule rule{options.risk_percent.value_or(10) / 100, fleet.has_costs && !options.risk_percent, knows_survivors(made.study)};
  if (effective_worlds(fleet, tables, day, rule) < enough_worlds) {  // many survivors leave few worlds
    constexpr std::size_t times = 8;                                 // some seconds for 500 dresspacks
    tables = life_tables(file, made.study, made.rows, needed, times * usual_worlds);
  }
  const Plan found = plan_of(fleet, tables, windows, day, rule);
  if (found.effective_worlds < fewest_worlds)
    throw InputError({options.fleet},
                     fmt::format("the ages of these dresspacks contradict the model: {:.1f} of {} samples explain them",
                                 found.effective_worlds, tables.begin()->second.worlds),
                     "learn from them first: dresslife calibrate");
  std::optional<Plan> other;
  std::string what_if;
  if (changed) {
    keep_ages(*changed, fleet, tables, day);
    PlanRule same = rule;
    same.weights = found.weights;  // of the plant as it is
    other = plan_of(*changed, tables, windows, day, same);
    what_if = "\n" + what_if_words(fleet, found, *changed, *other);
  }
  const std::string stem = "plan_" + fs::path(options.fleet).stem().string(), csv = plan_csv(fleet, found);
  const fs::path table = made.places.folder / (stem + ".csv"), calendar = made.places.folder / (stem + ".ics");
  const fs::path weeks = made.places.folder / (stem + "_weeks.csv"), page = made.places.folder / (stem + ".html");
  write_text_if_changed(table, csv);
  write_text_if_changed(weeks, plan_weeks_csv(fleet, found));
  const std::string tests = rule.by_cost ? test_words(values_of_tests(fleet, tables, found), found) : "";
  std::vector<std::string> notes = doubts(duties);
  for (const std::string& caution : cautions(duties)) notes.push_back(caution);
  if (!tests.empty()) notes.push_back(tests);
  if (const std::string kept = kept_words(fleet, found); !kept.empty()) notes.push_back(kept);
  write_text_if_changed(page, with_mark(plan_page(fs::path(options.fleet).stem().string(), fleet, found, notes, table.filename().string()),
                                        Mark::page));
  if (other) {
    const fs::path beside = made.places.folder / (stem + "_what_if.csv"), its_page = made.places.folder / (stem + "_what_if.html");
    write_text_if_changed(beside, plan_csv(*changed, *other));
    write_text_if_changed(its_page, with_mark(plan_page(fs::path(options.what_if).stem().string(), *changed, *other, notes, beside.filename().string()),
                                              Mark::page));
    what_if += fmt::format("Table: {}\nPage: {}\n", beside.string(), its_page.string());
  }
  write_text_if_changed(calendar, plan_calendar(fleet, found));
  const auto json = [&] {
    const std::string now = json_of_csv(csv).text;
    return other ? fmt::format("{{\"plan\":{},\"what_if\":{}}}\n", now, json_of_csv(plan_csv(*changed, *other)).text) : now + "\n";
  };
  print(options.json ? json()
                     : shown(fmt::format("{}{}{}\n{}Table: {}\nWeeks: {}\nCalendar: {}\nPage: {}\n", block(doubts(duties)),
                                         plan_words(fleet, found), tests, block(cautions(duties)), table.string(), weeks.string(),
                                         calendar.string(), page.string()) + what_if));
  tell(warning_lines(rows_of(file, made.rows)));
  return 0;
}

}  // namespace

Command plan_command() {
  const auto options = std::make_shared<Options>();
  return {"plan",
          "plan which dresspacks of a plant to replace in which maintenance window, and the spare parts",
          joined({{{"fleet", "", "FLEET.csv", &options->fleet, {.required = true}},
                   {"--duties", "DUTIES.yaml", "the duties that the table names", &options->study, {.required = true}},
                   {"--windows", "DATES", "the maintenance windows: 2027-07-12..2027-08-01,2027-12-20..2028-01-02",
                    &options->windows, {.required = true}},
                   {"--risk", "PERCENT",
                    "replace a dresspack when its probability of failure before the next window is larger; default: 10, or by "
                    "the costs of the table",
                    &options->risk_percent, {.range = {{0, 100}}}},
                   {"--what-if", "OTHER.csv", "a changed table of the same plant: its plan beside that of the first", &options->what_if},
                   {"--today", "DATE", "the first day of the plan; default: the computer's date", &options->today},
                   json_option(options->json)},
                  run_options(*options), study_options(*options)}),
          [options] { return plan(*options); }};
}

}  // namespace dresslife::pipeline
