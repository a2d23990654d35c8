#include "pipeline/advise/improve/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_judged = 3;  // each 14 jobs
constexpr std::size_t at_once = 6;      // one clamp along its axes

void judge(WithinTolerance& judged, const Finalist& of, double to_beat) {
  judged.least_hours = of.hours;
  for (std::size_t first = 0; first < of.nudges.size() && judged.least_hours >= to_beat; first += at_once) {
    const std::size_t count = std::min(at_once, of.nudges.size() - first);
    const std::vector<Outcome> outcomes = of.run(first, count);
    for (std::size_t k = 0; k < count; ++k) {
      const Outcome& outcome = outcomes[k];
      const bool ran = outcome.failure.empty();
      judged.nudges.push_back(
          {of.nudges[first + k].what, ran, ran ? outcome.hours / of.hours : 0, outcome.words()});
      judged.least_hours = std::min(judged.least_hours, ran ? outcome.hours : 0);
    }
  }
  judged.whole = judged.nudges.size() == of.nudges.size();
}

}  // namespace

std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& by_life) {
  std::vector<WithinTolerance> all;
  double to_beat = 0;
  for (const Finalist& finalist : by_life) {
    if (all.size() == most_judged || (!all.empty() && finalist.hours <= to_beat)) break;
    judge(all.emplace_back(), finalist, to_beat);
    if (all.back().whole) to_beat = std::max(to_beat, all.back().least_hours);
  }
  return all;
}

std::size_t best_within(const std::vector<WithinTolerance>& judged) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < judged.size(); ++k)
    if (judged[k].whole && judged[k].least_hours > judged[best].least_hours) best = k;
  return best;
}

std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges, double off) {
  if (nudges.empty()) return "";
  double least = HUGE_VAL;
  int broken = 0;
  for (const ImprovementStory::Nudge& nudge : nudges) {
    broken += !nudge.words.empty();
    if (nudge.ran && std::isfinite(nudge.share)) least = std::min(least, nudge.share);
  }
  std::string text = fmt::format("With a clamp or the length off by {:.3g} mm", 1000 * off);
  if (std::isfinite(least)) text += fmt::format(" it lives at least {:.2g} times as long", least);
  const char* joint = std::isfinite(least) ? ", and" : "";
  if (broken == 0) return text + joint + " all limits are kept\n";
  return text + fmt::format("{} {} of {} such jobs pass a limit\n", joint, broken, nudges.size());
}

}  // namespace dresslife::pipeline
