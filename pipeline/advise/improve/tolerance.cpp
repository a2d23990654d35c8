#include "pipeline/advise/improve/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "pipeline/base/readable.h"
#include "pipeline/job/job.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t usually_judged = 3;  // 24 jobs for each

/// Returns the smallest remaining share of the life with a nudge, over the other finalists; 0: it does not run or violates a
/// limit.
double kept_share(std::size_t number, const std::vector<WithinTolerance>& others) {
  double least = 1;  // a nudge without result comes after all nudges with a loss
  for (const WithinTolerance& other : others)
    for (std::size_t k = 0; k < other.numbers.size(); ++k)
      if (const ImprovementStory::Nudge& nudge = other.nudges[k]; other.numbers[k] == number) {
        const double share = std::isnan(nudge.share) ? 1 : nudge.share;  // NaN: no damage with and without the offset
        least = std::min(least, nudge.words.empty() ? share : 0);
      }
  return least;
}

WithinTolerance none_evaluated(const Finalist& of, const Outcome& as_it_is) {
  return {{}, {}, merit_of(of.drawn, as_it_is), of.drawn, of.nudges.empty()};
}

/// Returns the nudges with estimated lives that have the least merit, the shortest life or the earliest first mode.
std::vector<std::size_t> worst_estimated(const WithinTolerance& judged, const Outcome& as_it_is) {
  const auto life = [](const Outcome& of) { return of.failure.empty() ? of.hours : HUGE_VAL; };
  const auto mode = [](const Outcome& of) { return of.failure.empty() ? first_mode(of).hours : HUGE_VAL; };
  const auto merit = [&](const Outcome& of) { return merit_of(of, as_it_is); };
  std::set<std::size_t> numbers;
  const auto add_least = [&](const auto& value) {
    const auto least = std::ranges::min_element(judged.outcomes, {}, value);
    const std::size_t k = static_cast<std::size_t>(least - judged.outcomes.begin());
    if (least != judged.outcomes.end() && judged.nudges[k].estimated) numbers.insert(judged.numbers[k]);
  };
  add_least(merit), add_least(life), add_least(mode);
  return {numbers.begin(), numbers.end()};
}

/// Returns how many runs are done and how many follow if the finalist stays the best.
std::pair<std::size_t, std::size_t> runs_of(const WithinTolerance& judged, const Finalist& of,
                                            const Outcome& as_it_is) {
  const std::size_t left = of.nudges.size() - judged.numbers.size();
  std::size_t in_full = worst_estimated(judged, as_it_is).size();
  if (of.run_fully && left > 0) in_full = std::max<std::size_t>(in_full, 1);
  return {judged.numbers.size() + judged.full_runs, left + in_full};
}

/// Returns the next few of the remaining nudges.
std::vector<std::size_t> next_of(const Finalist& of, const WithinTolerance& judged,
                                 const std::vector<WithinTolerance>& others) {
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < of.nudges.size(); ++k)
    if (!std::binary_search(judged.numbers.begin(), judged.numbers.end(), k)) left.push_back(k);
  std::stable_sort(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
    return kept_share(a, others) < kept_share(b, others);
  });
  left.resize(std::min(left.size(), tolerance_runs_at_once));
  return left;
}

void put(WithinTolerance& judged, const Finalist& of, std::size_t number, const Outcome& outcome, bool estimated) {
  const bool ran = outcome.failure.empty();
  const ModeLife mode = first_mode(outcome);
  const auto found = std::lower_bound(judged.numbers.begin(), judged.numbers.end(), number);
  const auto at = found - judged.numbers.begin();
  if (found == judged.numbers.end() || *found != number) {
    judged.numbers.insert(found, number);
    judged.nudges.emplace(judged.nudges.begin() + at);
    judged.outcomes.emplace(judged.outcomes.begin() + at);
  }
  judged.nudges[static_cast<std::size_t>(at)] = {
      of.nudges[number].what, ran, ran ? outcome.hours / of.drawn.hours : 0, outcome.words(), ran ? mode.mode : "",
      ran ? mode.hours : 0, estimated};
  judged.outcomes[static_cast<std::size_t>(at)] = outcome;
}

void evaluate(WithinTolerance& judged, const Finalist& of, const std::vector<std::size_t>& numbers, bool in_full,
              const Outcome& as_it_is) {
  if (in_full) judged.full_runs += numbers.size();
  const std::vector<Outcome> outcomes = in_full ? of.run_fully(numbers) : of.run(numbers);
  // A job that does not run fails in the simulation, and a quick run simulates like a full run.
  for (std::size_t k = 0; k < numbers.size(); ++k)
    put(judged, of, numbers[k], outcomes[k], of.run_fully && !in_full && outcomes[k].failure.empty());
  judged.worst = merit_of(of.drawn, as_it_is);
  judged.worst_outcome = of.drawn;
  for (const Outcome& outcome : judged.outcomes)
    if (const Merit merit = merit_of(outcome, as_it_is); merit < judged.worst)
      judged.worst = merit, judged.worst_outcome = outcome;
  judged.whole = judged.numbers.size() == of.nudges.size() && worst_estimated(judged, as_it_is).empty();
}

/// Evaluates the next nudges. After all of them, or if no more are needed, runs the worst estimated ones in full.
void go_on(WithinTolerance& judged, const Finalist& of, bool enough, const std::vector<WithinTolerance>& others,
           const Outcome& as_it_is) {
  const bool in_full = enough || judged.numbers.size() == of.nudges.size();
  evaluate(judged, of, in_full ? worst_estimated(judged, as_it_is) : next_of(of, judged, others), in_full, as_it_is);
}

/// Returns the life of a quick run of a nudge as that of a full run.
double in_full(double quick, double quick_drawn, double drawn) {
  const double ratio = drawn / quick_drawn;
  return std::isfinite(ratio) && ratio > 0 ? quick * ratio : quick;
}

}  // namespace

WithinTolerance within_tolerance(const Finalist& of, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others,
                                 const ToleranceProgress& progress) {
  WithinTolerance judged = none_evaluated(of, as_it_is);
  while (!judged.whole) {
    const bool is_enough = enough(judged.worst);
    if (is_enough && worst_estimated(judged, as_it_is).empty()) break;
    const auto [done, left] = runs_of(judged, of, as_it_is);
    if (progress) progress({done, done + left, done + left});
    go_on(judged, of, is_enough, others, as_it_is);
  }
  return judged;
}

std::vector<std::string> quick_settings() { return {"uncertainty.slack=1", "uncertainty.friction_hose=1"}; }

std::string off_name(const std::string& prefix, std::size_t number, const std::vector<std::string>& settings) {
  return fmt::format("{}_{:02}{}", prefix, number + 1, settings.empty() ? "" : "_quick");
}

Finalist finalist_of(const Outcome& drawn, const std::vector<Nudge>& nudges, const std::vector<StudyJob>& jobs,
                     const NudgeRuns& run) {
  Finalist finalist{drawn, nudges, [run](const std::vector<std::size_t>& numbers) { return run(numbers, {}); }};
  if (std::none_of(jobs.begin(), jobs.end(), [](const StudyJob& of) { return of.job && of.job->uncertainty.enabled; }))
    return finalist;
  finalist.run_fully = std::exchange(finalist.run, {});
  const auto quick_drawn = std::make_shared<std::optional<Outcome>>();
  finalist.run = [=, count = nudges.size()](std::vector<std::size_t> numbers) {
    const bool first = !*quick_drawn;
    if (first) numbers.push_back(count);
    std::vector<Outcome> outcomes = run(numbers, quick_settings());
    if (first) *quick_drawn = outcomes.back(), outcomes.pop_back();
    for (Outcome& of : outcomes) {
      of.hours = in_full(of.hours, (*quick_drawn)->hours, drawn.hours);
      for (ModeLife& mode : of.modes)
        mode.hours = in_full(mode.hours, life_by(**quick_drawn, mode.mode), life_by(drawn, mode.mode));
    }
    return outcomes;
  };
  return finalist;
}

std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first,
                                              const Outcome& as_it_is, const ToleranceProgress& progress) {
  std::vector<WithinTolerance> all;
  const auto admit_next = [&] { all.push_back(none_evaluated(best_first[all.size()], as_it_is)); };
  while (all.size() < std::min(usually_judged, best_first.size())) admit_next();
  while (true) {
    const auto runs = [](const WithinTolerance& one) { return one.worst.kept != Kept::nothing; };
    while (all.size() < best_first.size() && std::none_of(all.begin(), all.end(), runs)) admit_next();
    const auto leader = std::max_element(
        all.begin(), all.end(),
        [](const WithinTolerance& a, const WithinTolerance& b) { return a.worst < b.worst; });
    if (leader == all.end() || leader->whole) break;
    const Finalist& of = best_first[static_cast<std::size_t>(leader - all.begin())];
    ToleranceCount count;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto [done, left] = runs_of(all[k], best_first[k], as_it_is);
      count.done += done;
      count.most += done + left;
      if (&all[k] == &*leader) count.likely = left;
    }
    count.likely += count.done;
    if (progress) progress(count);
    std::vector<WithinTolerance> others = all;
    others.erase(others.begin() + (leader - all.begin()));
    go_on(*leader, of, false, others, as_it_is);
  }
  // Of equal finalists the first leads, so finalists without a run are at the end.
  while (!all.empty() && all.back().numbers.empty() && !all.back().whole) all.pop_back();
  return all;
}

std::size_t best_within(const std::vector<WithinTolerance>& judged) {
  const auto best = std::max_element(judged.begin(), judged.end(), [](const auto& a, const auto& b) {
    return std::pair(a.whole, a.worst) < std::pair(b.whole, b.worst);
  });
  return static_cast<std::size_t>(best - judged.begin());
}

std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges,
                            const MountingTolerance& tolerance) {
  if (nudges.empty()) return "";
  const ImprovementStory::Nudge *shortest = nullptr, *earliest = nullptr;
  std::vector<std::string> broken;
  for (const ImprovementStory::Nudge& nudge : nudges) {
    if (!nudge.words.empty()) broken.push_back(nudge.what + ": " + nudge.words);
    if (!nudge.ran) continue;
    if (std::isfinite(nudge.share) && (!shortest || nudge.share < shortest->share)) shortest = &nudge;
    if (!nudge.first_mode.empty() && (!earliest || nudge.first_hours < earliest->first_hours))
      earliest = &nudge;
  }
  std::vector<std::string> parts;
  if (shortest)
    parts.push_back(
        fmt::format("the wires live at least {:.2g} times as long ({})", shortest->share, shortest->what));
  if (earliest)
    parts.push_back(fmt::format("{} comes after {} at the earliest ({})", earliest->first_mode,
                                hours_text(earliest->first_hours), earliest->what));
  parts.push_back(broken.empty() ? "all limits are kept"
                                 : fmt::format("{} of {} such jobs pass a limit or do not run ({})",
                                               broken.size(), nudges.size(), broken.front()));
  std::string text = "With " + tolerance_text(tolerance);
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? " " : k + 1 == parts.size() ? ", and " : ", ") + parts[k];
  return text + ".\n";
}

}  // namespace dresslife::pipeline
