#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "pipeline/advise/improve/draft.h"
#include "pipeline/advise/improve/faults.h"
#include "pipeline/advise/improve/outcome.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/improve/story.h"
#include "pipeline/advise/improve/tolerance.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/progress.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/base/stage_failed.h"
#include "pipeline/base/text.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/pictures.h"
#include "pipeline/commands/results.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/job_folder.h"
#include "pipeline/study/mode_table.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr int trials = 3;  // number of routings of one search that are simulated through the whole chain
constexpr const char* another_job = "name another job with --job";
constexpr int further = 40;  // short runs for less bending and twisting: a third more time than a usual search

struct RouteOptions : RunOptions {
  RouteRequest request;
  std::string ring, job, scale = "1";
  bool keep = false;
  int tried = 400, short_runs = 160, seed = 1;
  std::optional<double> off_mm, off_deg, bracket_mm;
};

/// One search and the results of its routings.
struct Trial {
  double factor = 1;
  ScreenedList proposals;
  std::vector<Outcome> outcomes;  // (proposal) empty limits: the proposal was not run
  std::vector<RankingRow> rows;   // (proposal) empty: the proposal was not run
  std::optional<std::size_t>
      // index of the best proposal that ran: of feasible ones the best merit within the tolerance, else the smallest violation
      best;
  std::vector<ImprovementStory::Nudge> nudges{};      // runs of the best proposal within the tolerance
  std::optional<std::size_t> start{};                 // the job's own routing, if it has one
  std::optional<std::size_t> found{};                 // the best other routing, if the job's own one ran, too
  std::vector<ImprovementStory::Nudge> own_nudges{};  // runs of the job's own routing within the tolerance
  std::string ended{};  // message that a file changed and the search ended; empty: no file changed

  bool feasible() const { return best && outcomes[*best].feasible(); }
  /// Returns the reference for the merit of a routing: the outcome of the job's own routing, if it ran.
  Outcome as_it_is() const {
    if (start && !rows[*start].job.empty()) return outcomes[*start];
    Outcome none;
    none.failure = "the job has no routing";
    return none;
  }
};

/// Returns whether outcome a is better than outcome b.
bool better(const Outcome& a, const Outcome& b, const Outcome& as_it_is) {
  if (a.violation() != b.violation()) return a.violation() < b.violation();
  return merit_of(a, as_it_is) > merit_of(b, as_it_is);
}

ScreenedList proposed(const Draft& draft, const RouteOptions& options, double factor, const fs::path& folder) {
  Node document = parse_yaml(job_text(draft.job), "draft");
  if (factor != 1) document["dresspack"] = *routed(draft, "{}", "{}", factor).find("dresspack");
  const fs::path job = folder / "draft.yaml";
  write_text_if_changed(job, with_mark(to_yaml(document), Mark::yaml));
  const PassingFile passing("screening.h5");
  std::vector<std::string> arguments =
      parts_between(fmt::format("--propose {} --tried {} --short-runs {} --further {} --seed {}", trials, options.tried,
                                options.short_runs, further, options.seed),
                    " ");
  arguments.insert(arguments.end(), {job.string(), "-o", passing.path().string()});
  if (options.quiet) arguments.push_back("--quiet");
  if (draft.exercise) arguments.push_back("--exercise");
  if (!options.ring.empty()) arguments.insert(arguments.end(), {"--ring", options.ring});
  if (run_stage_program("dresslife-sim", arguments) != 0)
    throw StageFailed({draft.name}, "no routing can be proposed (see above)", "correct the errors above");
  return read_screening(passing.path());
}

/// Runs routings through the whole chain.
void run(Trial& trial, const std::vector<std::size_t>& of, const Draft& draft, const RunOptions& options,
         const StudyPlaces& places, const FilesAtStart& files) {
  Study study{draft.name, {}};
  for (const std::size_t k : of) {
    const Node document = routed(draft, trial.proposals.candidates[k].changes, trial.proposals.motion, trial.factor);
    study.jobs.push_back(
        {fmt::format("{:.0f}_percent_{}", 100 * trial.factor, k + 1), as_candidate(job_from(document)), ""});
  }
  const std::vector<RankingRow> rows = made_rows(study, places, options, files);
  for (std::size_t n = 0; n < of.size(); ++n) {
    const std::size_t k = of[n];
    const RankingRow& row = trial.rows[k] = *find_in(rows, &RankingRow::job, study.jobs[n].name);
    trial.outcomes[k] = outcome_of(row, places.job(row.job));
    if (trial.outcomes[k].failure.empty() &&
        (!trial.best || better(trial.outcomes[k], trial.outcomes[*trial.best], trial.as_it_is())))
      trial.best = k;
  }
}

/// Returns the tolerance to verify. Without a program of the user 24 more runs of each routing have no value, so it is zero then.
MountingTolerance tolerance_for(const Draft& draft, const RouteOptions& options) {
  return tolerance_of(options.off_mm.value_or(draft.exercise ? 0 : 1e3 * MountingTolerance{}.off), options.off_deg);
}

/// Judges the feasible proposals within the mounting tolerance.
void judge(Trial& trial, const Draft& draft, const RouteOptions& options, const StudyPlaces& places,
           const FilesAtStart& files) {
  const Outcome as_it_is = trial.as_it_is();
  ToleranceRuns runs(draft.name, options);
  std::vector<std::size_t> best_first;
  for (std::size_t k = 0; k < trial.outcomes.size(); ++k)
    if (!trial.rows[k].job.empty() && trial.outcomes[k].feasible()) best_first.push_back(k);
  std::ranges::stable_sort(best_first, [&](std::size_t a, std::size_t b) {
    return merit_of(trial.outcomes[a], as_it_is) > merit_of(trial.outcomes[b], as_it_is);
  });
  std::vector<Finalist> finalists;
  for (const std::size_t k : best_first) {
    const Node document = routed(draft, trial.proposals.candidates[k].changes, trial.proposals.motion, trial.factor);
    finalists.push_back(finalist_of(
        trial.outcomes[k], tolerance_for(draft, options),
        [&, k, document](const std::vector<std::string>& sets, const std::string& name) {
          Node off = document;
          for (const std::string& set : sets) apply_set(off, set);
          return std::vector{
              StudyJob{fmt::format("{}_off_{}", trial.rows[k].job, name), as_candidate(job_from(off)), ""}};
        },
        [&](const std::vector<StudyJob>& jobs) {
          const std::vector<RankingRow> rows =
              made_rows({draft.name, jobs, Keep::lives}, places, runs.options(), files);
          return mapped(jobs, [&](const StudyJob& job) {
            return outcome_of(*find_in(rows, &RankingRow::job, job.name), places.job(job.name));
          });
        }));
  }
  const auto progress = [&](const ToleranceCount& count) { runs.begin(count); };
  std::optional<std::size_t> own;
  for (std::size_t k = 0; k < best_first.size(); ++k)
    if (best_first[k] == trial.start) own = k;
  std::vector<WithinTolerance> judged = within_tolerance(finalists, as_it_is, progress, own);
  const std::size_t best = best_within(judged);
  // The bound of a routing that keeps all limits so far may be too high.
  if (own && best != *own && !judged[*own].whole && judged[*own].worst.kept >= Kept::limits)
    judged[*own] = within_tolerance(
        finalists[*own], as_it_is, [&](const Merit& worst) { return clearly_better(judged[best].worst, worst); },
        {judged[best]}, progress);
  const std::size_t chosen = best_within(judged, own);
  trial.best = best_first[chosen];
  trial.nudges = judged[chosen].nudges;
  if (own && best != *own) trial.found = best_first[best], trial.own_nudges = judged[*own].nudges;
}

/// Takes the job's own routing if the best one is not clearly better than it.
void prefer_own(Trial& trial) {
  if (!trial.start || trial.best == trial.start || trial.rows[*trial.start].job.empty()) return;
  const Outcome& own = trial.outcomes[*trial.start];
  trial.found = trial.best;
  if (own.feasible() && !clearly_better(merit_of(trial.outcomes[*trial.best], own), merit_of(own, own)))
    trial.best = trial.start;
}

/// Refuses changes of keys that the search replaces.
void refuse_replaced_keys(const std::vector<std::string>& sets) {
  for (const std::string& set : sets) {
    const std::string key = set.substr(0, set.find('='));
    if (key == "routing" || (key.starts_with("routing.") && !is_kept_by_search(key.substr(8))))
      throw InputError({"--set " + set}, fmt::format("{} is replaced by the search", key),
                       "leave it out, or write it into the job, whose routing is compared with those that are found");
  }
}

/// Returns the routing of the given job as YAML; absent: the job has no complete routing, or not on the links that are asked for.
/// Errors: InputError for a complete routing that is not valid.
std::optional<std::string> own_routing(const Draft& draft, const RouteOptions& options) {
  const Node* const routing = draft.document.find("routing");
  if (draft.exercise || !routing) return {};
  const auto is_on = [](const Node* of, const std::string& asked) {
    const Node* const link = of ? of->find("link") : nullptr;
    return asked.empty() || (link && link->text == asked);
  };
  const Node* const rings = routing->find("rings");
  if (!is_on(routing->find("base_clamp"), options.request.base_link) ||
      !is_on(routing->find("tool_clamp"), options.request.tool_link) ||
      !is_on(rings && rings->items.size() == 1 ? &rings->items.front() : nullptr, options.ring))
    return {};
  for (const char* key : {"base_clamp", "tool_clamp"})
    if (const Node* const clamp = routing->find(key); !clamp || (clamp->is_map() && clamp->entries.size() < 2))
      return {};
  if (!routing->find("free_length_m")) return {};
  job_from(draft.document);
  return to_yaml(*routing);
}

/// Writes the best routing of a search, or the first if none ran. head: comment lines, or empty.
void write_job(const Trial& of, const Draft& draft, const RouteOptions& options, const fs::path& job,
               const std::string& head) {
  check_replaceable(job, another_job);  // checked a second time, because the file may have changed during the search
  const Node document = routed(draft, of.proposals.candidates[of.best.value_or(0)].changes, of.proposals.motion,
                               of.factor, job.has_parent_path() ? job.parent_path() : fs::path("."));
  const std::string of_tool = tool_space_words(draft);
  write_text_if_changed(
      job, with_mark(fmt::format("# Proposed by dresslife route {}\n{}{}{}", shown(options.request.of), head,
                                 of_tool.empty() ? "" : "# " + of_tool + "\n", to_yaml(document)),
                     Mark::yaml));
}

/// Runs the proposals that kept all limits in their short run, and the job's own routing. With a tolerance all of them are run,
/// because the tolerance decides; else until one keeps all limits in the whole chain. own: own_routing().
Trial tried(const Draft& draft, const RouteOptions& options, double factor, const StudyPlaces& places,
            const FilesAtStart& files, const fs::path& job, const std::optional<std::string>& own) {
  Trial trial{factor, proposed(draft, options, factor, places.folder), {}, {}, {}};
  if (own && factor == 1) {
    trial.start = trial.proposals.candidates.size();
    ScreenedCandidate& candidate = trial.proposals.candidates.emplace_back();
    candidate.changes = *own;
    candidate.beyond.assign(trial.proposals.limits.size(), 0.0);
  }
  trial.outcomes.resize(trial.proposals.candidates.size());
  trial.rows.resize(trial.proposals.candidates.size());
  const bool tolerance = !tolerance_for(draft, options).none();
  const std::size_t found = trial.start.value_or(trial.outcomes.size());
  std::vector<std::size_t> to_run;
  for (std::size_t k = 0; k < found; ++k)
    if (!trial.proposals.candidates[k].rejected && trial.proposals.candidates[k].violation() == 0) to_run.push_back(k);
  if (trial.start) to_run.push_back(*trial.start);
  Progress progress(fmt::format("{} at {:.0f} %", draft.name, 100 * factor), options.quiet);
  const auto run_next = [&](const std::vector<std::size_t>& of, std::size_t before) {
    RunOptions with_progress = options;
    with_progress.share_done = [&](double share) {
      const double likely = static_cast<double>(to_run.size()) + (tolerance ? usual_tolerance_time : 0);
      progress.show((static_cast<double>(before) + share * static_cast<double>(of.size())) / likely,
                    fmt::format("full runs of {}{} routings{}", tolerance ? "" : "at most ", to_run.size(),
                                tolerance ? ", then the mounting tolerance" : ""));
    };
    run(trial, of, draft, with_progress, places, files);
  };
  try {
    if (tolerance && !to_run.empty()) run_next(to_run, 0);
    for (std::size_t n = 0; n < to_run.size() && !tolerance; ++n)
      if (to_run[n] == trial.start || !trial.feasible()) run_next({to_run[n]}, n);
    progress.clear();
    if (tolerance && trial.feasible()) {
      write_job(trial, draft, options, job, not_verified);
      if (!options.quiet)
        write_stderr(shown(fmt::format(
            "The best routing so far is in {}, not yet verified within the mounting tolerance.\n", job.string())));
      judge(trial, draft, options, places, files);
    } else if (trial.feasible()) {
      prefer_own(trial);
    }
  } catch (const FilesChanged& change) {
    trial.ended = change.what();
  }
  return trial;
}

/// Returns, (limit), how far the best routing exceeds each limit, by its run, else by its short run; empty: it cannot run.
std::vector<double> beyond(const Trial& trial) {
  if (trial.best) return trial.outcomes[*trial.best].beyond;
  const ScreenedCandidate& first = trial.proposals.candidates.front();
  return limits_of_short_run(trial.proposals.limits, first.beyond);
}

/// The limit that the best routing of a search exceeds most, and its remedy.
struct DecidingLimit {
  std::string by, remedy;
};
/// Returns the remedy of other links. The next one toward the tool is named: a shorter dresspack follows the wrist with less bending.
std::string other_links(const Trial& trial, const Draft& draft) {
  const Node routing = parse_yaml(trial.proposals.candidates[trial.best.value_or(0)].changes, "proposal");
  const std::vector<Link>& links = draft.job.robot.links;
  const auto place = [&](const char* name) {
    const Node* const clamp = routing.find(name);
    const Node* const link = clamp ? clamp->find("link") : nullptr;
    return std::ranges::find(links, link ? link->text : "", &Link::name) - links.begin();
  };
  const auto next = place("base_clamp") + 1;
  return next < place("tool_clamp")
             ? fmt::format("--from {} or another link (--from, --to)", links[static_cast<std::size_t>(next)].name)
             : "another link (--from, --to)";
}

DecidingLimit decided(const Trial& trial, const Draft& draft) {
  std::vector<double> passed = beyond(trial);
  for (double& g : passed)
    if (!(g > 0)) g = 0;  // NaN: not known
  // A remedy for repeats that differ cures no other limit.
  if (const auto repeats = static_cast<std::size_t>(std::ranges::find(outcome_limit_names(), "repeatability") -
                                                    outcome_limit_names().begin());
      repeats < passed.size() && std::ranges::count(passed, 0.0) + 1 < std::ssize(passed))
    passed[repeats] = 0;
  const auto most = static_cast<std::size_t>(std::ranges::max_element(passed) - passed.begin());
  const std::string other = other_links(trial, draft) + ", more --tried and --short-runs, or a gentler program";
  if (passed.empty() || passed[most] == 0) return {"no routing runs", other};
  const std::string& limit = outcome_limit_names()[most];
  if (limit != "bend radius") {
    // The warning of the run contains the amount, the reason and the remedy.
    static const std::map<std::string, WarningKind> kinds{{"twist", WarningKind::twist},
                                                          {"too short", WarningKind::slack},
                                                          {"too long", WarningKind::slack},
                                                          {"tension", WarningKind::tension},
                                                          {"retraction's stroke", WarningKind::slack},
                                                          {"forces in cables", WarningKind::force},
                                                          {"repeatability", WarningKind::periodic}};
    const auto kind = kinds.find(limit);
    for (const Warning& warning : trial.best ? warnings_of(trial.rows[*trial.best]) : std::vector<Warning>{})
      if (const WarningParts parts = parts_of(warning.words);
          kind != kinds.end() && warning.kind == kind->second && !parts.remedy.empty()) {
        const std::string rest = remedy_after_search(parts.remedy);
        return {fmt::format("the limit that decides: {}. Likely cause: {}", parts.problem, parts.cause),
                (rest.empty() ? "" : rest + "; or ") + other};
      }
    return {fmt::format("the limit that decides: {}, violated by {}", limit, passed_text(most, passed[most])), other};
  }
  // The limit shrinks with the hose, but a thinner hose is also bent more: abb_irb2600_12_165 with `hard` exceeds the limit by
  // 0.14 at 100 % and by 0.033 at 78 %, and keeps all limits at 70 %. Short runs give a bend to some percent.
  constexpr double margin = 0.95,
                   smallest = 0.5;  // of half the size, cables have a quarter of the copper: other cables
  const Dresspack& dresspack = draft.job.dresspacks.front().dresspack;
  const double least = least_bend_radius(dresspack) * trial.factor, share = std::exp(-passed[most]);
  const double scale = std::floor(100 * trial.factor * share * share * margin) / 100, allowed = least * share * margin;
  const std::string smaller =
      scale < smallest ? "" : fmt::format("--scale {:.2g} (a dresspack of the same make in that size), ", scale);
  const std::string tighter = allowed < tightest_bend_radius(dresspack) * trial.factor
                                  ? ""
                                  : fmt::format(", or dresspack.least_bend_radius_mm: {:.0f} if its maker allows it",
                                                std::floor(1e3 * allowed));
  const std::string by = fmt::format("the limit that decides: bend radius, {:.0f} mm of at least {:.0f} mm",
                                     1e3 * least * share, 1e3 * least);
  if (dresspack.least_bend_radius) return {by, smaller + other + tighter};
  return {fmt::format("{} (dresspack.least_bend_radius_mm is not given, so that {})", by, bend_rule(dresspack)),
          "the maker's dresspack.least_bend_radius_mm, " + smaller + other + tighter};
}

/// Returns the reason why the best routing of a search is not feasible.
std::string obstacle(const Trial& trial) {
  if (trial.best) return trial.outcomes[*trial.best].words();
  const ScreenedCandidate& first = trial.proposals.candidates.front();
  return first.refusal.empty() ? trial.proposals.words(first) : first.refusal;
}

/// Returns the violation of the best routing by its short run; infinite: it cannot run.
double violation(const Trial& trial) {
  const ScreenedCandidate& first = trial.proposals.candidates.front();
  return first.refusal.empty() ? first.violation() : std::numeric_limits<double>::infinity();
}

std::vector<double> factors_of(const RouteOptions& options) {
  if (options.scale == "auto") return {1, 0.8, 0.65, 0.5, 0.4, 0.3};
  const auto factor = whole_number_in<double>(options.scale);
  if (!factor || !(*factor >= 0.05 && *factor <= 2))
    throw InputError({"--scale"}, fmt::format("'{}' is neither auto nor a number from 0.05 to 2", options.scale),
                     "write one");
  return {*factor};
}

void write_page(const fs::path& job, const fs::path& page) {
  const PassingFile passing("preview.h5");
  if (print_preview(job, {}, {}, passing.path()) == 0)
    write_text_if_changed(page, preview_page(passing.path(), job.stem().string(), xxh3(shell_digest())));
}

/// Returns "1 of 10 has failed after 347,000 h; jacket wear from 24,400 h; keeps all limits".
std::string outcome_words(const Outcome& outcome) {
  const std::string modes = mode_words(outcome);
  return fmt::format("1 of 10 has failed after {}; {}{}", hours_text(outcome.hours), modes.empty() ? "" : modes + "; ",
                     outcome.feasible() ? "keeps all limits" : outcome.words());
}

/// Returns a comparison of the best routing with the job's own routing.
std::string comparison_words(const Trial& trial, const MountingTolerance& tolerance) {
  if (!trial.start || trial.rows[*trial.start].job.empty()) return "";  // no own routing, or the search ended early
  const Outcome& own = trial.outcomes[*trial.start];
  if (!own.failure.empty()) return fmt::format("The job's own routing does not run: {}\n", own.failure);
  if (trial.best == trial.start && !trial.found)
    return "It is the job's own routing: none that was found is better in limits, modes and life.\n";
  const Outcome& other = trial.outcomes[trial.found.value_or(*trial.best)];
  const std::string both = fmt::format("{}: {}\n  the job's own: {}\n",
                                       trial.best == trial.start ? "the best of the others" : "this routing",
                                       outcome_words(other), outcome_words(own));
  if (trial.best == trial.start)
    return "It is the job's own routing, because no other is better in life, limits and modes together.\n  " + both;
  std::string text = "It is better than the job's own routing.\n  " + both;
  if (!trial.own_nudges.empty()) text += "  The job's own: " + tolerance_words(trial.own_nudges, tolerance);
  return text;
}

/// job: the file that is written.
std::string words_of(const Trial& trial, const Draft& draft, const MountingTolerance& tolerance, const fs::path& job) {
  const Outcome& best = trial.outcomes[*trial.best];
  const Dresspack& dresspack = draft.job.dresspacks.front().dresspack;
  std::string text;
  if (trial.factor != 1)
    text += fmt::format(
        "This is not for {} as it is but for one of the same make at {:.0f} % of its size, {:.0f} mm wide\n",
        dresspack.name, 100 * trial.factor, 1e3 * dresspack.diameter * trial.factor);
  if (draft.exercise)
    text += fmt::format("No program was given: the wrist was only moved about{}. Look again with yours.\n",
                        tolerance.none() ? ", and no mounting tolerance was tried" : "");
  if (best.feasible()) {
    const std::string at_other_values = left_at_other_values(trial.rows[*trial.best]);
    text += !at_other_values.empty() ? "It keeps all limits in a run with its own values.\n" + at_other_values
                                     : "It keeps all limits in a run.\n";
  } else {
    const DecidingLimit by = decided(trial, draft);
    text += fmt::format("It runs, but no routing was found that keeps all limits ({}): {}. Remedy: {}\n", best.words(),
                        by.by, by.remedy);
  }
  text += comparison_words(trial, tolerance) + tolerance_words(trial.nudges, tolerance);
  RankingRow row = trial.rows[*trial.best];
  name_file(row, job);
  for (const std::string& words : {action_words(row), uncertainty_words(row), failure_words(row)})
    text += words + (words.empty() ? "" : "\n");
  text = trial.proposals.candidates[*trial.best].changes + wrapped_lines(text, screen_columns());
  return text + mode_table(row, screen_columns(), "") + mode_legend({row}, screen_columns(), "");
}

/// Removes the runs of a search except that of the best routing.
void remove_others(const fs::path& folder, const std::string& winner) {
  for (const fs::path& entry : entries_of(folder))
    if (entry.filename() != winner && is_job_folder(entry)) remove_job(entry);
}

int route(const RouteOptions& options) {
  RouteRequest request = options.request;
  refuse_replaced_keys(request.sets);
  if (options.bracket_mm) request.sets.push_back(fmt::format("routing.longest_bracket_mm={:.6g}", *options.bracket_mm));
  Draft draft = draft_of(request);
  const std::optional<std::string> own = own_routing(draft, options);
  for (const Warning& fault : dresspack_faults(draft.job, true)) write_stderr(fault.paragraph());
  fill_tool_space(draft);
  if (draft.tool_space && !options.quiet)
    write_stderr(shown(paragraph(
        tool_space_words(draft) + " " +
        fmt::format(
            "dresslife route added it: {} does not have it. All hours here, also those of the job's own routing, "
            "are computed with it. dresslife run {} computes other hours without it; with it: --set {}=...",
            shown(options.request.of), shown(options.request.of), draft.tool_space->key))));
  const fs::path job = options.job.empty() ? fs::path(draft.name + "_routed.yaml") : fs::path(options.job);
  const fs::path page = job.parent_path() / (job.stem().string() + "_preview.html");
  check_replaceable(job, another_job);
  check_replaceable(page, another_job);  // its name follows that of the job
  const StudyPlaces places{fs::path(options.out) / (draft.name + "_route"), program_folder()};
  const FolderLock lock(places.folder);
  const std::vector<double> factors = factors_of(options);
  if (!options.quiet)
    write_stderr(fmt::format(
        "Checks {} routings by geometry and the best of them in {} short runs, for each size. Full runs follow{}. "
        "The remaining time of the short runs does not include them.\n",
        options.tried, options.short_runs,
        tolerance_for(draft, options).none()
            ? ""
            : " of the best three, then runs with a clamp or length off, which most often take as long as nine full runs (--off 0 leaves them out)"));
  if (kind_of(options.request.of) == FileKind::file) claim_folder(places.folder, options.request.of);
  const FilesAtStart files({std::make_shared<const Job>(draft.job)});
  std::optional<Trial> chosen, nearest;
  std::string ended;
  for (const double factor : factors) {
    Trial trial = tried(draft, options, factor, places, files, job, own);
    const bool feasible = trial.feasible();
    ended = trial.ended;
    if (!ended.empty())
      write_stderr(shown(ended) + "\n");
    else if (!feasible)
      write_stderr(fmt::format("note: at {:.0f} % of the dresspack's size: {}\n", 100 * factor, obstacle(trial)));
    const bool nearer = !nearest || violation(trial) < violation(*nearest);
    if (trial.best &&
        (!chosen || better(trial.outcomes[*trial.best], chosen->outcomes[*chosen->best], chosen->as_it_is())))
      chosen = std::move(trial);
    else if (nearer)
      nearest = std::move(trial);
    if (feasible || !ended.empty()) break;
  }
  const bool may_run = !chosen && std::isfinite(violation(*nearest));
  if (may_run && ended.empty()) {
    try {
      run(*nearest, {0}, draft, options, places, files);
    } catch (const FilesChanged& change) {
      ended = change.what();
      write_stderr(shown(ended) + "\n");
    }
    if (nearest->best) chosen = std::move(nearest);
  }
  if (!chosen && (ended.empty() || !may_run)) {
    const DecidingLimit by = decided(*nearest, draft);
    throw InputError({options.request.of}, "no routing was found that runs; " + by.by, by.remedy);
  }
  const Trial& of = chosen ? *chosen : *nearest;
  const std::string& routing = of.proposals.candidates[of.best.value_or(0)].changes;
  write_job(of, draft, options, job, ended.empty() ? "" : not_verified);
  write_page(job, page);
  if (of.best && !options.keep) remove_others(places.folder, of.rows[*of.best].job);
  print(shown(of.best ? words_of(of, draft, tolerance_for(draft, options), job)
                      : routing + "Only short runs tried it.\n"));
  print(shown(fmt::format("Job: {}\nPreview: {}\n", job.string(), page.string())));
  return of.feasible() && ended.empty() ? 0 : 1;
}

}  // namespace

Command route_command() {
  const auto options = std::make_shared<RouteOptions>();
  RouteRequest& request = options->request;
  return {
      "route",
      "propose a routing from nothing: clamps on two links and a length, tried in a run, as a job with its "
      "preview",
      joined(
          {{{"of", "", "JOB.yaml, or a ROBOT", &request.of, {.required = true}},
            {"--dresspack", "NAME", "instead of the job's; of a robot spot_welding", &request.dresspack},
            {"--motion", "NAME", "instead of the job's; for a robot alone: a motion of its wrist", &request.motion},
            {"--from", "LINK", "link of the base clamp; else the job's, or the one that axis 3 moves",
             &request.base_link},
            {"--to", "LINK", "link of the tool clamp; else the job's, or the last", &request.tool_link},
            {"--ring", "LINK", "also a guide ring on this link", &options->ring},
            {"--scale", "auto|FACTOR", "of the dresspack's size; auto: as it is, then smaller until one fits",
             &options->scale},
            number_option("--tried", "COUNT", "routings to check by geometry, for each size", &options->tried, 1,
                          1'000'000),
            number_option("--short-runs", "COUNT", "short runs that improve the best of them, for each size",
                          &options->short_runs, 1, 100'000),
            number_option("--seed", "NUMBER", "start of the random numbers", &options->seed, 0, 1'000'000'000),
            number_option("--bracket", "MM",
                          "longest bracket, written into the job as routing.longest_bracket_mm; else the job's",
                          &options->bracket_mm, 0, 10'000),
            number_option(
                "--off", "MM",
                "mounting tolerance of clamps and lengths; also tilts clamps by MM over 100 mm; the best routing within it wins; 0: none; else 10, or none without a program",
                &options->off_mm, 0, 1000),
            number_option(
                "--off-deg", "DEG",
                "mounting tolerance of the turn of the hose's end about its axis; 0: none; else 10, or none with --off 0",
                &options->off_deg, 0, 180),
            {"--keep", "", "keep the runs of all routings, not only of the best", &options->keep},
            {"--job", "FILE.yaml", "job to write; else NAME_routed.yaml here", &options->job},
            folder_option("the runs that try it", options->out)},
           run_options(*options),
           {sets_option("override a key of the job", request.sets)}}),
      [options] { return route(*options); }};
}

}  // namespace dresslife::pipeline
