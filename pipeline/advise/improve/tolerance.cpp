#include "pipeline/advise/improve/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/base/readable.h"

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

void evaluate(WithinTolerance& judged, const Finalist& of, const std::vector<std::size_t>& numbers,
              const Outcome& as_it_is) {
  const std::vector<Outcome> outcomes = of.run(numbers);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Outcome& outcome = outcomes[k];
    const bool ran = outcome.failure.empty();
    const ModeLife mode = first_mode(outcome);
    const auto at = std::lower_bound(judged.numbers.begin(), judged.numbers.end(), numbers[k]);
    judged.nudges.insert(judged.nudges.begin() + (at - judged.numbers.begin()),
                         {of.nudges[numbers[k]].what, ran, ran ? outcome.hours / of.drawn.hours : 0,
                          outcome.words(), ran ? mode.mode : "", ran ? mode.hours : 0});
    judged.numbers.insert(at, numbers[k]);
    if (const Merit merit = merit_of(outcome, as_it_is); merit < judged.worst)
      judged.worst = merit, judged.worst_outcome = outcome;
  }
  judged.whole = judged.numbers.size() == of.nudges.size();
}

}  // namespace

WithinTolerance within_tolerance(const Finalist& of, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others,
                                 const ToleranceProgress& progress) {
  WithinTolerance judged = none_evaluated(of, as_it_is);
  while (!judged.whole && !enough(judged.worst)) {
    if (progress) progress({judged.numbers.size(), of.nudges.size(), of.nudges.size()});
    evaluate(judged, of, next_of(of, judged, others), as_it_is);
  }
  return judged;
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
      count.done += all[k].numbers.size();
      count.most += best_first[k].nudges.size();
    }
    count.likely = count.done + of.nudges.size() - leader->numbers.size();
    if (progress) progress(count);
    std::vector<WithinTolerance> others = all;
    others.erase(others.begin() + (leader - all.begin()));
    evaluate(*leader, of, next_of(of, *leader, others), as_it_is);
  }
  // Of equal finalists the first leads, so finalists without a run are at the end.
  while (!all.empty() && all.back().numbers.empty() && !all.back().whole) all.pop_back();
  return all;
}

std::size_t best_within(const std::vector<WithinTolerance>& judged, std::optional<std::size_t> own) {
  const auto best = std::max_element(judged.begin(), judged.end(), [](const auto& a, const auto& b) {
    return std::pair(a.whole, a.worst) < std::pair(b.whole, b.worst);
  });
  if (own && !clearly_better(best->worst, judged[*own].worst)) return *own;
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
