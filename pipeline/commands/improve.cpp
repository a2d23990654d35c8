#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "pipeline/commands/command.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/errors.h"
#include "pipeline/improve/improvement.h"
#include "pipeline/improve/nudges.h"
#include "pipeline/installation.h"
#include "pipeline/job/job_text.h"
#include "pipeline/progress.h"
#include "pipeline/readable.h"
#include "pipeline/report/improvement_page.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/stage_program.h"
#include "pipeline/whole_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t finalists = 6;  // whose lives are told over what is not known, too

struct Options : RunOptions {
  ImproveRequest request;
  std::string method = "surrogate", second = "none";
  double off_mm = 10;
};

/// What geometry says; nothing where the program refuses the job.
ScreenedList screened(const Job& job, const std::string& candidates, bool in_runs, const fs::path& folder) {
  const fs::path draft = folder / "screened.yaml", list = folder / "candidates.yaml";
  write_text_if_changed(draft, job_text(job), Sync::never);
  write_text_if_changed(list, candidates, Sync::never);
  const PassingFile told("screening.h5");
  std::vector<std::string> arguments{draft.string(), "--screen", list.string(), "-o", told.path().string(), "--quiet"};
  if (in_runs) arguments.push_back("--rehearse");
  const int status = run_stage_program("dresslife-sim", arguments);
  return status == 0 ? read_screening(told.path()) : ScreenedList{};
}

std::string hours_words(double hours) { return std::isinf(hours) ? "no damage" : readable(hours) + " h"; }

/// The jobs as they are, then the best of what was tried; the front of two aims whole.
std::vector<std::size_t> finalists_of(const Improvement& found) {
  if (found.front.size() > 1) return found.front;
  std::vector<std::size_t> best;
  for (std::size_t k = 1; k < found.trials.size(); ++k)
    if (found.trials[k].worst.feasible()) best.push_back(k);
  std::stable_sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) {
    return found.trials[a].worst.hours > found.trials[b].worst.hours;
  });
  if (best.size() > finalists) best.resize(finalists);
  return best;
}

/// Of the jobs with one set of changes, over all that is not known.
struct Final {
  std::vector<std::string> jobs;  ///< names
  double hours = 0;               ///< of the worst, p10
  std::size_t trial = 0;
};

struct Finals {
  Study study;
  std::vector<Final> of;  ///< the jobs as they are first
  std::vector<RankingRow> rows;
};

bool is_of(const RankingRow& row, const std::vector<std::string>& jobs) {
  return std::find(jobs.begin(), jobs.end(), row.job) != jobs.end();
}

Finals finals_of(const Improvement& found, const Options& options, const StudyPlaces& places) {
  Finals finals{{found.name, {}}, {}, {}};
  std::vector<std::size_t> trials = finalists_of(found);
  trials.insert(trials.begin(), 0);
  for (const std::size_t trial : trials) {
    const std::string prefix = trial == 0 ? "before" : fmt::format("trial_{:04}", trial);
    Final of{{}, HUGE_VAL, trial};
    for (StudyJob& job : changed_jobs(options.request, found.trials[trial].sets, prefix)) {
      of.jobs.push_back(job.name);
      finals.study.jobs.push_back(std::move(job));
    }
    finals.of.push_back(std::move(of));
  }
  finals.rows = made_rows(finals.study, places, options);
  for (Final& of : finals.of)
    for (const RankingRow& row : finals.rows)
      if (is_of(row, of.jobs)) of.hours = std::min(of.hours, row.done() ? row.headline_hours() : 0);
  return finals;
}

const Final* best_of(const Finals& finals) {
  if (finals.of.size() < 2) return nullptr;
  return &*std::max_element(finals.of.begin() + 1, finals.of.end(),
                            [](const Final& a, const Final& b) { return a.hours < b.hours; });
}

/// Of the worst of its jobs; null: none is done.
const RankingRow* worst_row(const Finals& finals, const Final& of) {
  const RankingRow* worst = nullptr;
  for (const RankingRow& row : finals.rows)
    if (is_of(row, of.jobs) && row.done() && (!worst || row.headline_hours() < worst->headline_hours())) worst = &row;
  return worst;
}

/// Share of draws in which the worst job lives longer than it did; absent where nothing is uncertain.
std::optional<double> share_longer(const Finals& finals, const Final& best, const StudyPlaces& places) {
  const RankingRow *before = worst_row(finals, finals.of.front()), *after = worst_row(finals, best);
  if (!before || !after) return std::nullopt;
  Study two{finals.study.name, {}};
  for (const StudyJob& job : finals.study.jobs)
    if (job.name == before->job || job.name == after->job) two.jobs.push_back(job);
  const std::vector<RankingRow> rows = ranking_of(two, places, states_of(two, places));
  if (rows.size() < 2 || !rows[0].outlives_next) return std::nullopt;
  return rows[0].job == after->job ? *rows[0].outlives_next : 1 - *rows[0].outlives_next;
}

/// The best with one thing off, as trials were run.
std::vector<ImprovementStory::Nudge> nudged(const Improvement& found, std::size_t trial, const Options& options,
                                            const StudyPlaces& places) {
  std::vector<ImprovementStory::Nudge> told;
  if (options.off_mm == 0) return told;
  const std::vector<std::string>& sets = found.trials[trial].sets;
  const std::vector<Nudge> nudges = nudges_of(trial_jobs(options.request, sets, "place"), options.off_mm / 1000);
  Study study{found.name, {}};
  std::vector<std::vector<std::string>> jobs;
  for (std::size_t k = 0; k < nudges.size(); ++k) {
    std::vector<std::string> all = sets;
    all.insert(all.end(), nudges[k].sets.begin(), nudges[k].sets.end());
    jobs.emplace_back();
    for (StudyJob& job : trial_jobs(options.request, all, fmt::format("off_{:02}", k + 1))) {
      jobs.back().push_back(job.name);
      study.jobs.push_back(std::move(job));
    }
  }
  if (study.jobs.empty()) return told;
  const std::vector<RankingRow> rows = made_rows(study, places, options);
  for (std::size_t k = 0; k < nudges.size(); ++k) {
    std::vector<Outcome> outcomes;
    for (const RankingRow& row : rows)
      if (is_of(row, jobs[k])) outcomes.push_back(outcome_of(row, places.job(row.job), found.limits));
    const Outcome worst = worst_of(outcomes);
    told.push_back({nudges[k].what, worst.failure.empty(), worst.hours / found.trials[trial].worst.hours, worst.words()});
  }
  return told;
}

ImprovementStory::Lives lives_of(const Finals& finals, const Final& of, const Outcome& outcome, const StudyPlaces& places) {
  ImprovementStory::Lives lives{"", outcome.feasible() ? "all kept" : outcome.words()};
  if (const RankingRow* row = worst_row(finals, of)) {
    std::error_code failure;
    if (fs::exists(places.job(row->job) / "page.html", failure)) lives.page = row->job + "/page.html";
    const std::array<double, 3> hours =
        row->planned() ? row->planned_hours : std::array{row->life_hours, row->life_hours, row->life_hours};
    lives.p10 = hours[0], lives.p50 = hours[1], lives.p90 = hours[2];
  }
  return lives;
}

ImprovementStory story_of(const Improvement& found, const Finals& finals, const Options& options,
                          const StudyPlaces& places) {
  ImprovementStory story;
  story.name = found.name;
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const Outcome& worst = found.trials[k].worst;
    story.looks.push_back({static_cast<int>(k), worst.failure.empty(), worst.feasible(), worst.hours, worst.words()});
  }
  const bool by_length = options.request.second == SecondAim::hose_length;
  story.second_title = by_length ? "free length [m]" : "cycle time [s]";
  for (std::size_t k = 0; options.request.second != SecondAim::none && k < found.front.size(); ++k) {
    const Trial& trial = found.trials[found.front[k]];
    story.front.emplace_back(by_length ? trial.hose_length : trial.cycle_seconds, trial.worst.hours);
  }
  if (found.trials.front().worst.failure.empty())
    story.before = lives_of(finals, finals.of.front(), found.trials.front().worst, places);
  const Final* best = best_of(finals);
  if (!best) return story;
  const Trial& trial = found.trials[best->trial];
  story.after = lives_of(finals, *best, trial.worst, places);
  story.longer_in = share_longer(finals, *best, places);
  for (std::size_t k = 0; k < trial.sets.size(); ++k)
    story.changes.push_back({found.freed[k], found.own[k], trial.sets[k].substr(trial.sets[k].find('=') + 1)});
  story.nudges = nudged(found, best->trial, options, places);
  return story;
}

/// How much the best forgives, in a line.
std::string forgives_words(const std::vector<ImprovementStory::Nudge>& nudges, double off_mm) {
  if (nudges.empty()) return "";
  double least = HUGE_VAL;
  int broken = 0;
  for (const ImprovementStory::Nudge& nudge : nudges) {
    broken += !nudge.words.empty();
    if (nudge.ran && std::isfinite(nudge.share)) least = std::min(least, nudge.share);
  }
  std::string text = fmt::format("With a clamp or the length off by {:.3g} mm", off_mm);
  if (std::isfinite(least)) text += fmt::format(" it lives at least {:.2g} times as long", least);
  return text + (broken ? fmt::format("{} {} of {} such jobs pass a limit\n", std::isfinite(least) ? ", and" : "", broken,
                                      nudges.size())
                        : std::string(std::isfinite(least) ? ", and" : "") + " all limits are kept\n");
}

std::string change_lines(const Trial& trial) {
  std::string text;
  for (const std::string& set : trial.sets) text += fmt::format("    --set '{}'\n", set);
  return text;
}

std::string words_of(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                     const Options& options, const StudyPlaces& places) {
  const Outcome& was = found.trials.front().worst;
  std::string text = fmt::format(
      "As it is: {}{}\n", was.failure.empty() ? hours_words(finals.of.front().hours) : "it does not run",
      was.feasible() ? ", all limits kept" : was.failure.empty() ? ", " + was.words() : ": " + was.failure);
  if (finals.of.size() == 1) {
    text += fmt::format("No feasible job was found in {} trials and {} short runs.\n", found.trials.size(), found.rehearsals);
    for (const std::string& line : found.obstacle) text += line + "\n";
    return text;
  }
  if (found.front.size() > 1) {
    text += fmt::format("Longest lives for their {}:\n", options.second);
    for (std::size_t k = 1; k < finals.of.size(); ++k) {
      const Trial& trial = found.trials[finals.of[k].trial];
      text += fmt::format("  trial {:4}  {:>12}  {:.3f} m  {:.1f} s\n", finals.of[k].trial, hours_words(finals.of[k].hours),
                          trial.hose_length, trial.cycle_seconds);
    }
    return text;
  }
  const Final& best = *best_of(finals);
  text += fmt::format("Trial {} of {}: {}, all limits kept", best.trial, found.trials.size(), hours_words(best.hours));
  if (story.longer_in) text += fmt::format("; it lives longer in {:.0f} % of draws", 100 * *story.longer_in);
  text += "\n" + change_lines(found.trials[best.trial]) + forgives_words(story.nudges, options.off_mm);
  if (best.hours <= finals.of.front().hours && was.feasible())
    text += "Nothing that was tried lives longer over all that is not known.\n";
  for (const std::string& job : best.jobs) text += fmt::format("Job: {}\n", (places.job(job) / "job.yaml").string());
  return text;
}

int improve_study(Options options) {
  options.request.file = named_file(options.study, "studies");
  options.request.sets = options.sets;
  const std::string name = study_name(options.request.file);
  const StudyPlaces places{fs::path(options.out) / (name + "_improve"), program_folder()};
  const FolderLock lock(places.folder);
  RunOptions quiet = options;
  quiet.quiet = true;
  Progress progress(name, options.quiet);
  const TrialMakers makers{
      [&](const Study& study) { return made_rows(study, places, quiet); },
      [&](const Job& job, const std::string& candidates, bool in_runs) {
        return screened(job, candidates, in_runs, places.folder);
      },
      [&](const Improvement& so_far) {
        const std::optional<std::size_t> best = so_far.best();
        progress.show(fmt::format("{}/{}  best {}", so_far.trials.size(), options.request.trials,
                                  best ? hours_words(so_far.trials[*best].worst.hours) : "none within the limits"));
      }};
  const Improvement found = improve(options.request, places, makers);
  progress.clear();
  write_text_if_changed(places.folder / "improve.csv", improvement_csv(found));
  const Finals finals = finals_of(found, options, places);
  write_results(finals.study, places, finals.rows);
  const ImprovementStory story = story_of(found, finals, options, places);
  write_text_if_changed(places.folder / "improve.html", improvement_page(story));
  print(shown(words_of(found, finals, story, options, places)));
  print(shown(fmt::format("Trials: {}\nReport: {}\n", (places.folder / "improve.csv").string(),
                          (places.folder / "improve.html").string())));
  return finals.of.size() > 1 ? 0 : 1;
}

template <class Enum>
Enum value_of(const std::string& text, std::initializer_list<Enum> values) {
  for (const Enum value : values)
    if (text == word(value)) return value;
  throw std::logic_error("the command line let '" + text + "' through");
}

}  // namespace

Command add_improve(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* words = program.add_subcommand(
      "improve", "search for jobs that live longer: keys that are freed, under the limits of the checks");
  words->add_option("study", options->study, "STUDY.yaml with `free`, or JOB.yaml whose clamps and length are then free")
      ->required()
      ->type_name("");
  words
      ->add_option("--free", options->request.frees,
                   "free a key: 'LOW .. HIGH', 'SPREAD around', 'ANGLE deg around', 'LOW .. HIGH along LINK' or '[A, B]'; "
                   "may be repeated")
      ->type_name("KEY.PATH=RANGE")
      ->allow_extra_args(false);
  words->add_option("--trials", options->request.trials, "jobs to try, or sets of all the study's jobs")
      ->check(CLI::Range(2, 100'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words->add_option("--at-a-time", options->request.at_a_time, "trials that are thought of together; another number, another search")
      ->check(CLI::Range(1, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  words->add_option("--seed", options->request.seed, "of the search's chances")
      ->check(CLI::Range(0, 1'000'000'000))
      ->type_name("NUMBER")
      ->capture_default_str();
  words
      ->add_option("--rehearsals", options->request.rehearsals,
                   "short runs before the first trial, at most; each trial adds a few; 0: none; -1: 25 for each variable")
      ->check(CLI::Range(-1, 100'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words->add_option("--method", options->method, "models of lives and limits, or chance alone to hold against it")
      ->check(CLI::IsMember({"surrogate", "random"}))
      ->type_name("surrogate|random")
      ->capture_default_str();
  words->add_option("--second", options->second, "a second aim, to be small: the answer is the front of both")
      ->check(CLI::IsMember({"none", "hose_length", "cycle_time"}))
      ->type_name("none|hose_length|cycle_time")
      ->capture_default_str();
  words
      ->add_option("--off", options->off_mm, "what a clamp or the length may be off by: told of the best job; 0: not asked")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  add_run_options(*words, *options);
  add_launcher(*words, *options);
  add_study_options(*words, *options);
  return {words, [options] {
            options->request.method = value_of(options->method, {SearchMethod::surrogate, SearchMethod::random});
            options->request.second =
                value_of(options->second, {SecondAim::none, SecondAim::hose_length, SecondAim::cycle_time});
            return improve_study(*options);
          }};
}

}  // namespace dresslife::pipeline
