#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "pipeline/advise/improve/draft.h"
#include "pipeline/advise/improve/finals.h"
#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/story.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/progress.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr const char* elsewhere = "run in another folder";  // the short job is written into the present one

struct ImproveOptions : RunOptions {
  ImproveRequest request;
  double off_mm = 10;
  std::optional<double> off_deg, bracket_mm;
};

/// Shows the progress of a search. The remaining time includes short runs, trials and the runs within the mounting tolerance.
class SearchProgress {
 public:
  SearchProgress(const std::string& name, const ImproveOptions& options)
      : progress_(name, options.quiet),
        trials_(options.request.trials),
        after_trials_(tolerance_of(options.off_mm, options.off_deg).none() ? 0 : usual_tolerance_time) {}
  void report(const Improvement& so_far) {
    const std::optional<std::size_t> best = so_far.best();
    best_words_ = best ? hours_text(so_far.trials[*best].worst.hours) : "none within the limits";
    jobs_ = so_far.jobs.size();
    done_ = static_cast<double>(so_far.trials.size());
    trials_ = std::max(trials_, static_cast<int>(done_));  // bend reliefs are tried after the requested trials
    short_runs_ = so_far.short_runs, most_short_runs_ = so_far.most_short_runs;
    if (first_trial_ == 0) first_trial_ = seconds();
    if (done_ <= 1) trials_from_ = seconds();
    show(0);
  }
  /// Returns options for the jobs of trials, whose runs this object shows. Precondition: this object is not moved.
  RunOptions shown_here(RunOptions options, const Study& study) {
    const double trials = static_cast<double>(study.jobs.size()) / static_cast<double>(std::max<std::size_t>(jobs_, 1));
    options.share_done = [this, trials](double share) { show(share * trials); };
    return options;
  }
  void clear() { progress_.clear(); }

 private:
  double seconds() const { return std::chrono::duration<double>(Progress::Clock::now() - begin_).count(); }
  /// running: trials that are done, but not reported.
  void show(double running) {
    if (done_ == 0) return progress_.show(fmt::format("trial 1 of {}", trials_));
    const double now = seconds();
    const bool short_runs = done_ == 1 && running == 0 && short_runs_ < most_short_runs_;
    double left = (first_trial_ + now - trials_from_) / (done_ + running) *
                  std::max(0.0, trials_ - done_ - running + after_trials_);
    if (short_runs) left += (now - first_trial_) / std::max(1, short_runs_) * (most_short_runs_ - short_runs_);
    const double share = now / (now + left);
    const std::string remaining = remaining_words(now, 0, share);
    const std::string words =
        short_runs ? fmt::format("short run {} of about {} before the second of {} trials", short_runs_,
                                 most_short_runs_, trials_)
                   : fmt::format("trial {:.0f} of {}, best {}", std::min(done_ + std::floor(running), 1.0 * trials_),
                                 trials_, best_words_);
    progress_.show(fmt::format("{:5.1f} %{}{}  {}{}", 100 * share, remaining.empty() ? "" : ", ", remaining, words,
                               after_trials_ > 0 ? ", then the mounting tolerance" : ""));
  }

  Progress progress_;
  int trials_, short_runs_ = 0, most_short_runs_ = 0;
  double after_trials_, done_ = 0, first_trial_ = 0, trials_from_ = 0;
  std::size_t jobs_ = 1;
  std::string best_words_;
  Progress::Clock::time_point begin_ = Progress::Clock::now();
};

FilesAtStart files_of(const Study& study) {
  std::vector<std::shared_ptr<const Job>> jobs;
  for (const StudyJob& job : study.jobs)
    if (job.job) jobs.push_back(job.job);
  return FilesAtStart(std::move(jobs));
}

/// Ends a search whose files changed. Its trials so far belong to the old files.
int end_early(const Improvement& found, const StudyPlaces& places) {
  remove_trial_files(found, places, false);
  write_stderr(shown(found.ended) + "\n");
  print(shown(unfinished_words(found)));
  print(shown(fmt::format("Trials: {}\n", (places.folder / "improve.csv").string())));
  return 1;
}

/// Writes the best trial as a short job into the present folder. Writes none if no trial is better or the job has no robot.
/// verified: it was judged within the mounting tolerance, or no tolerance is given. written: this search has already written a
/// version that is not verified. Returns whether the file now contains the job of this search.
bool write_short_job(const ImproveRequest& request, const Improvement& found, const Finals& finals, const fs::path& job,
                     bool verified, bool written) {
  const Final* const best = finals.best();
  const Node document = read_document(request.file);
  check_replaceable(job, elsewhere);  // checked a second time, because the file may have changed during the search
  if (!best || !finals.is_gain(*best) || !document.find("robot") || !document.find("routing")) {
    if (written && remove_ours(job))
      print(shown(fmt::format("Removed: {}, the best as drawn, because nothing is clearly better.\n", job.string())));
    return false;
  }
  RouteRequest route{.of = request.file.string()};
  route.sets = request.sets;
  const std::vector<std::string>& sets = found.trials[best->trial].sets;
  route.sets.insert(route.sets.end(), sets.begin(), sets.end());
  const Draft draft = draft_of(route);
  const Node whole = routed(draft, to_yaml(*draft.document.find("routing")), "", 1, ".");
  write_text_if_changed(job,
                        with_mark(fmt::format("# Proposed by dresslife improve {}\n{}{}", shown(request.file.string()),
                                              verified ? "" : not_verified, to_yaml(whole)),
                                  Mark::yaml));
  if (verified) print(shown(fmt::format("Short job: {}\n", job.string())));
  return true;
}

/// Runs the best trials again, in full and with offsets of clamps and length, and writes the results.
int judge_the_best(const ImproveOptions& options, const StudyPlaces& places, const Improvement& found,
                   const FilesAtStart& files, const fs::path& job) {
  Finals finals =
      finals_of(found, options.request, [&](const Study& study) { return made_rows(study, places, options, files); });
  remove_trial_files(found, places, false);
  renew_receipts(finals.study, places,
                 states_of(finals.study, places));  // removed links changed the times of the files
  const bool all_written = write_results(finals.study, places, finals.rows).empty();
  const MountingTolerance tolerance = tolerance_of(options.off_mm, options.off_deg);
  bool written = false;
  if (!tolerance.none() && finals.of.size() > 1) {
    written = write_short_job(options.request, found, finals, job, false, false);
    if (!options.quiet)
      write_stderr(shown(fmt::format(
          "The trials are done. The jobs of the best are in {}{}. Next the best run again with {}, which most often takes as long as nine trials. --off 0 leaves that out.\n",
          places.folder.string(), written ? fmt::format(", the best as drawn also in {}", job.string()) : "",
          tolerance_text(tolerance))));
    ToleranceRuns runs(found.name, options);
    judge(
        finals, found, options.request, tolerance, places,
        [&](const Study& study) { return made_rows(study, places, runs.options(), files); },
        [&](const ToleranceCount& count) { runs.begin(count); });
  }
  const ImprovementStory story = story_of(found, finals, options.request.second, places);
  write_text_if_changed(places.folder / "improve.html", with_mark(improvement_page(story), Mark::page));
  print(shown(improvement_words(found, finals, story, options.request.second, tolerance, places)));
  write_short_job(options.request, found, finals, job, true, written);
  print(shown(fmt::format("Trials: {}\nReport: {}\n", (places.folder / "improve.csv").string(),
                          (places.folder / "improve.html").string())));
  const int failed = say_failures(options.study, finals.rows);
  return failed != 0 || finals.of.size() == 1 || !all_written ? 1 : 0;
}

int improve_study(ImproveOptions options) {
  options.request.file = named_study(options.study);
  options.request.sets = options.sets;
  check_sets(options.request.file, options.sets, options.quiet);
  if (options.bracket_mm) options.request.longest_bracket = *options.bracket_mm / 1000;
  const std::string name = study_name(options.request.file);
  const OwnFolder own(options, name + "_improve", options.request.file);
  const StudyPlaces& places = own.places;
  const fs::path job = name + "_improved.yaml";
  check_replaceable(job, elsewhere);
  const Study study = read_study(options.request.file, options.sets);
  const FilesAtStart files = files_of(study);
  if (const MountingTolerance by = tolerance_of(options.off_mm, options.off_deg);
      !by.none() && std::ranges::all_of(study.jobs, [](const StudyJob& of) { return of.job != nullptr; }) &&
      nudges_of(study.jobs, by).empty()) {
    write_stderr(
        "note: the mounting tolerance is not tried, because an offset is that of one routing, and the routings of the jobs "
        "differ. --off 0 leaves out this note.\n");
    options.off_mm = 0, options.off_deg.reset();
  }
  SearchProgress progress(name, options);
  const TrialMakers makers{
      [&](const Study& trials) { return made_rows(trials, places, progress.shown_here(options, trials), files); },
      [&](const Improvement& so_far) {
        progress.report(so_far);
        remove_trial_files(so_far, places, true);
      }};
  Improvement found = improve(options.request, places, makers);
  progress.clear();
  write_text_if_changed(places.folder / "improve.csv", improvement_csv(found));
  if (!found.ended.empty()) return end_early(found, places);
  try {
    return judge_the_best(options, places, found, files, job);
  } catch (const FilesChanged& change) {
    found.ended = change.what();
    return end_early(found, places);
  }
}

}  // namespace

Command improve_command() {
  const auto options = std::make_shared<ImproveOptions>();
  ImproveRequest& request = options->request;
  return {
      "improve", "search values of free keys, such as clamps and length, for a longer life within the limits",
      joined(
          {{{"study",
             "",
             "STUDY.yaml with `free`, or JOB.yaml whose clamps and length are then free",
             &options->study,
             {.required = true}},
            {"--free", "KEY.PATH=RANGE",
             "free a key: 'LOW .. HIGH', 'SPREAD around', 'ANGLE deg around', 'LOW .. HIGH along LINK' or '[A, "
             "B]'; may be repeated",
             &request.frees},
            number_option(
                "--trials", "COUNT",
                "jobs to try, or sets of all the study's jobs; then a few with bend reliefs, where a bend at a clamp decides",
                &request.trials, 2, 100'000),
            number_option("--at-a-time", "COUNT", "trials proposed together; the search depends on it",
                          &request.at_a_time, 1, 1024),
            number_option("--seed", "NUMBER", "start of the random numbers", &request.seed, 0, 1'000'000'000),
            number_option("--short-runs", "COUNT",
                          "short runs before the first trial, at most; each trial adds a few; 0: none; -1: 40 for each "
                          "variable",
                          &request.short_runs, -1, 100'000),
            choice_option("--second", "a second aim, to be small: the answer is the front of both", request.second,
                          {SecondAim::none, SecondAim::hose_length, SecondAim::cycle_time}),
            number_option(
                "--off", "MM",
                "mounting tolerance of clamps and lengths; also tilts clamps by MM over 100 mm; the best job within it wins; 0: none",
                &options->off_mm, 0, 1000),
            number_option(
                "--off-deg", "DEG",
                "mounting tolerance of the turn of the hose's end about its axis; 0: none; else 10, or none with --off 0",
                &options->off_deg, 0, 180),
            number_option("--bracket", "MM",
                          "instead of routing.longest_bracket_mm; a bracket that the job has already may be longer",
                          &options->bracket_mm, 0, 10'000)},
           run_options(*options),
           {launcher_option(*options)},
           study_options(*options)}),
      [options] { return improve_study(*options); }};
}

}  // namespace dresslife::pipeline
