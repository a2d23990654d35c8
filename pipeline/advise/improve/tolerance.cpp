#include "pipeline/advise/improve/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/job.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t usually_judged = 3;  // 24 jobs for each
constexpr std::size_t known_at_once =
    4;  // the first are the lengths and the turn of the end, which show a narrow optimum soonest
constexpr std::size_t full_at_once = 2;  // also the least: a second costs less beside the first than after it
constexpr std::size_t usually_full = 4;  // of the best
constexpr double known_time = 0.2;       // of a full run: 0.12 and 0.37 measured

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

std::size_t full_runs(const WithinTolerance& judged) {
  return static_cast<std::size_t>(std::ranges::count(judged.nudges, false, &ImprovementStory::Nudge::estimated));
}

/// Returns what a full run may change: the wires' life, among results with equal limits and modes (T2).
std::pair<Kept, double> to_verify(const Outcome& outcome, const Outcome& as_it_is) {
  const Merit merit = merit_of(outcome, as_it_is);
  return {merit.kept, merit.hours};
}

/// Returns the next nudges: first those without a result, then the estimated ones with the shortest lives of the wires.
std::vector<std::size_t> next_of(const Finalist& of, const WithinTolerance& judged,
                                 const std::vector<WithinTolerance>& others, const Outcome& as_it_is) {
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < of.nudges.size(); ++k)
    if (!std::binary_search(judged.numbers.begin(), judged.numbers.end(), k)) left.push_back(k);
  if (!left.empty()) {
    std::stable_sort(left.begin(), left.end(),
                     [&](std::size_t a, std::size_t b) { return kept_share(a, others) < kept_share(b, others); });
    left.resize(std::min(left.size(), known_at_once));
    return left;
  }
  std::vector<std::pair<std::pair<Kept, double>, std::size_t>> worst_first;
  for (std::size_t k = 0; k < judged.numbers.size(); ++k)
    if (judged.nudges[k].estimated)
      worst_first.emplace_back(to_verify(judged.outcomes[k], as_it_is), judged.numbers[k]);
  std::ranges::sort(worst_first);
  worst_first.resize(std::min(worst_first.size(), full_at_once));
  for (const auto& [life, number] : worst_first) left.push_back(number);
  return left;
}

void add(WithinTolerance& judged, const Finalist& of, std::size_t number, const Outcome& outcome, bool is_estimated) {
  const bool ran = outcome.failure.empty();
  const ModeLife mode = first_mode(outcome);
  const ImprovementStory::Nudge nudge{of.nudges[number].what,
                                      ran,
                                      ran ? outcome.hours / of.drawn.hours : 0,
                                      outcome.words(),
                                      ran ? mode.mode : "",
                                      ran ? mode.hours : 0,
                                      ran && is_estimated,
                                      outcome.hours};
  const auto at = std::lower_bound(judged.numbers.begin(), judged.numbers.end(), number);
  const auto k = at - judged.numbers.begin();
  if (at != judged.numbers.end() && *at == number) {
    judged.nudges[k] = nudge, judged.outcomes[k] = outcome;
    return;
  }
  judged.numbers.insert(at, number);
  judged.nudges.insert(judged.nudges.begin() + k, nudge);
  judged.outcomes.insert(judged.outcomes.begin() + k, outcome);
}

void evaluate(WithinTolerance& judged, const Finalist& of, const std::vector<std::size_t>& numbers,
              const Outcome& as_it_is) {
  const bool all_have_results = judged.numbers.size() == of.nudges.size();
  const bool estimates = of.run_known && !all_have_results;
  const std::vector<Outcome> outcomes = estimates ? of.run_known(numbers) : of.run(numbers);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    Outcome outcome = estimates ? estimated(outcomes[k + 1], outcomes[0], of.drawn) : outcomes[k];
    outcome.exceeding = of.drawn.exceeding;  // runs without uncertain inputs do not have it: no case counts its own
    add(judged, of, numbers[k], outcome, estimates);
  }
  judged.worst = merit_of(of.drawn, as_it_is);
  std::pair<Kept, double> worst_of_full = to_verify(of.drawn, as_it_is), worst_estimated{Kept::modes, HUGE_VAL};
  for (std::size_t k = 0; k < judged.outcomes.size(); ++k) {
    auto& worst = judged.nudges[k].estimated ? worst_estimated : worst_of_full;
    worst = std::min(worst, to_verify(judged.outcomes[k], as_it_is));
    judged.worst = std::min(judged.worst, merit_of(judged.outcomes[k], as_it_is));
  }
  std::vector<Outcome> all = judged.outcomes;
  all.push_back(of.drawn);
  judged.worst_outcome = worst_of(all);
  judged.whole = judged.numbers.size() == of.nudges.size() && worst_of_full <= worst_estimated &&
                 full_runs(judged) >= std::min(full_at_once, of.nudges.size());
}

/// Returns the worst merit so far without the estimated lives of the wires; limits and other modes are known.
Merit worst_known(const WithinTolerance& judged, const Finalist& of, const Outcome& as_it_is) {
  Merit worst = merit_of(of.drawn, as_it_is);
  for (std::size_t k = 0; k < judged.outcomes.size(); ++k) {
    Outcome outcome = judged.outcomes[k];
    if (judged.nudges[k].estimated) outcome.hours = of.drawn.hours;
    worst = std::min(worst, merit_of(outcome, as_it_is));
  }
  return worst;
}

/// Returns the state of all finalists. The last one is evaluated next.
ToleranceCount count_of(const std::vector<const WithinTolerance*>& all, const Finalist& of) {
  const double each = of.run_known ? known_time : 1;
  ToleranceCount count;
  for (const WithinTolerance* one : all) {
    const double full = of.run_known ? static_cast<double>(full_runs(*one)) : 0;
    count.done += each * static_cast<double>(one->numbers.size()) + full;
  }
  const WithinTolerance& next = *all.back();
  const std::size_t left = of.nudges.size() - next.numbers.size();
  const double to_estimate = each * static_cast<double>(left);
  count.next = left > 0 ? std::min(to_estimate, each * known_at_once) : full_at_once;
  count.likely = count.done + to_estimate;
  if (of.run_known)
    count.likely += static_cast<double>(std::max(usually_full, full_runs(next) + full_at_once) - full_runs(next));
  count.words = left > 0 ? fmt::format("{} of {} cases", next.numbers.size(), of.nudges.size())
                         : fmt::format("the worst of {} cases in full, {} so far", of.nudges.size(), full_runs(next));
  return count;
}

}  // namespace

Finalist finalist_of(
    const Outcome& drawn, const MountingTolerance& tolerance,
    const std::function<std::vector<StudyJob>(const std::vector<std::string>&, const std::string&)>& jobs_with,
    const std::function<std::vector<Outcome>(const std::vector<StudyJob>&)>& run) {
  const std::vector<StudyJob> placed = jobs_with({}, "place");
  Finalist finalist{drawn, nudges_of(placed, tolerance), {}};
  const auto runs_of = [=, nudges = finalist.nudges](const std::vector<std::size_t>& numbers, bool known) {
    const std::vector<std::string> certain{"uncertainty.enabled=false"};
    std::vector<StudyJob> jobs;
    if (known) jobs = jobs_with(certain, "00_known");
    for (const std::size_t k : numbers) {
      std::vector<std::string> sets = nudges[k].sets;
      if (known) sets.insert(sets.end(), certain.begin(), certain.end());
      std::ranges::move(jobs_with(sets, fmt::format("{:02}{}", k + 1, known ? "_known" : "")),
                        std::back_inserter(jobs));
    }
    const std::vector<Outcome> outcomes = run(jobs);
    std::vector<Outcome> worst;
    for (auto one = outcomes.begin(); one != outcomes.end(); one += placed.size())
      worst.push_back(worst_of({one, one + placed.size()}));
    return worst;
  };
  finalist.run = [=](const auto& numbers) { return runs_of(numbers, false); };
  const bool uncertain =
      std::ranges::any_of(placed, [](const StudyJob& job) { return job.job && job.job->uncertainty.enabled; });
  if (uncertain && finalist.nudges.size() > full_at_once)
    finalist.run_known = [=](const auto& numbers) { return runs_of(numbers, true); };
  return finalist;
}

Outcome estimated(const Outcome& off, const Outcome& own, const Outcome& drawn) {
  const auto scaled = [](double off_hours, double own_hours, double drawn_hours) {
    const bool ratio = own_hours > 0 && std::isfinite(own_hours) && std::isfinite(drawn_hours);
    return ratio ? drawn_hours * off_hours / own_hours : std::min(off_hours, drawn_hours);
  };
  Outcome outcome = off;
  outcome.hours = scaled(off.hours, own.hours, drawn.hours);
  for (ModeLife& mode : outcome.modes)
    mode.hours = scaled(mode.hours, life_by(own, mode.mode), life_by(drawn, mode.mode));
  return outcome;
}

WithinTolerance within_tolerance(const Finalist& of, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others, const ToleranceProgress& progress) {
  WithinTolerance judged = none_evaluated(of, as_it_is);
  while (!judged.whole && !enough(worst_known(judged, of, as_it_is))) {
    if (progress) progress(count_of({&judged}, of));
    evaluate(judged, of, next_of(of, judged, others, as_it_is), as_it_is);
  }
  return judged;
}

std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first, const Outcome& as_it_is,
                                              const ToleranceProgress& progress, std::optional<std::size_t> own) {
  const std::size_t with_own = own ? *own + 1 : 0;
  std::vector<WithinTolerance> all;
  const auto admit_next = [&] { all.push_back(none_evaluated(best_first[all.size()], as_it_is)); };
  while (all.size() < std::max(with_own, std::min(usually_judged, best_first.size()))) admit_next();
  while (true) {
    const auto runs = [](const WithinTolerance& one) { return one.worst.kept != Kept::nothing; };
    while (all.size() < best_first.size() && std::none_of(all.begin(), all.end(), runs)) admit_next();
    const auto leader = std::max_element(
        all.begin(), all.end(), [](const WithinTolerance& a, const WithinTolerance& b) { return a.worst < b.worst; });
    if (leader == all.end() || leader->whole) break;
    const Finalist& of = best_first[static_cast<std::size_t>(leader - all.begin())];
    std::vector<WithinTolerance> others = all;
    others.erase(others.begin() + (leader - all.begin()));
    if (progress) {
      std::vector<const WithinTolerance*> counted;
      for (const WithinTolerance& other : others) counted.push_back(&other);
      counted.push_back(&*leader);
      progress(count_of(counted, of));
    }
    evaluate(*leader, of, next_of(of, *leader, others, as_it_is), as_it_is);
  }
  // Of equal finalists the first leads, so finalists without a run are at the end.
  while (all.size() > with_own && all.back().numbers.empty() && !all.back().whole) all.pop_back();
  return all;
}

std::size_t best_within(const std::vector<WithinTolerance>& judged, std::optional<std::size_t> own) {
  const auto best = std::max_element(judged.begin(), judged.end(), [](const auto& a, const auto& b) {
    return std::pair(a.whole, a.worst) < std::pair(b.whole, b.worst);
  });
  if (own && !clearly_better(best->worst, judged[*own].worst)) return *own;
  return static_cast<std::size_t>(best - judged.begin());
}

std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges, const MountingTolerance& tolerance) {
  if (nudges.empty()) return "";
  const ImprovementStory::Nudge *shortest = nullptr, *earliest = nullptr;
  std::vector<std::string> broken;
  for (const ImprovementStory::Nudge& nudge : nudges) {
    if (!nudge.words.empty()) broken.push_back(nudge.what + ": " + nudge.words);
    if (!nudge.ran) continue;
    if (std::isfinite(nudge.share) &&
        (!shortest || std::pair(nudge.share, nudge.hours) < std::pair(shortest->share, shortest->hours)))
      shortest = &nudge;
    if (!nudge.first_mode.empty() && (!earliest || nudge.first_hours < earliest->first_hours)) earliest = &nudge;
  }
  std::vector<std::string> parts;
  if (shortest) {
    const std::string life = shortest->share > 0 ? fmt::format("{:.2g} times as long", shortest->share)
                                                 : hours_text(shortest->hours);  // they are not damaged as drawn
    parts.push_back(
        fmt::format("the wires live at least {}{} ({})", shortest->estimated ? "about " : "", life, shortest->what));
  }
  if (earliest)
    parts.push_back(fmt::format("{} comes after {} at the earliest ({})", earliest->first_mode,
                                hours_text(earliest->first_hours), earliest->what));
  parts.push_back(broken.empty() ? "all limits are kept"
                                 : fmt::format("{} of {} such jobs pass a limit or do not run ({})", broken.size(),
                                               nudges.size(), broken.front()));
  std::string text = "With " + tolerance_text(tolerance);
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? " " : k + 1 == parts.size() ? ", and " : ", ") + parts[k];
  text += ".";
  if (const auto estimates = std::ranges::count(nudges, true, &ImprovementStory::Nudge::estimated); estimates > 0)
    text += fmt::format(" Lives of {} of {} such jobs are estimates by runs without uncertain inputs.", estimates,
                        nudges.size());
  return text + "\n";
}

}  // namespace dresslife::pipeline
