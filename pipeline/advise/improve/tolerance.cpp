#include "pipeline/advise/improve/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/readable.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t usually_judged = 3;  // each 24 jobs
constexpr std::size_t at_once =
    4;  // the length and the turn of the end first, in which a narrow optimum shows soonest

}  // namespace

WithinTolerance within_tolerance(const Finalist& of, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough) {
  WithinTolerance judged{{}, merit_of(of.drawn, as_it_is), of.drawn, false};
  for (std::size_t first = 0; first < of.nudges.size() && !enough(judged.worst); first += at_once) {
    const std::size_t count = std::min(at_once, of.nudges.size() - first);
    const std::vector<Outcome> outcomes = of.run(first, count);
    for (std::size_t k = 0; k < count; ++k) {
      const Outcome& outcome = outcomes[k];
      const bool ran = outcome.failure.empty();
      const ModeLife mode = first_mode(outcome);
      judged.nudges.push_back({of.nudges[first + k].what, ran, ran ? outcome.hours / of.drawn.hours : 0,
                               outcome.words(), ran ? mode.mode : "", ran ? mode.hours : 0});
      if (const Merit merit = merit_of(outcome, as_it_is); merit < judged.worst)
        judged.worst = merit, judged.worst_outcome = outcome;
    }
  }
  judged.whole = judged.nudges.size() == of.nudges.size();
  return judged;
}

std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first,
                                              const Outcome& as_it_is) {
  std::vector<WithinTolerance> all;
  Merit to_beat;
  for (const Finalist& finalist : best_first) {
    const bool one_runs = to_beat.kept != Kept::nothing;
    if ((all.size() >= usually_judged && one_runs) ||
        (!all.empty() && merit_of(finalist.drawn, as_it_is) <= to_beat))
      break;
    all.push_back(within_tolerance(finalist, as_it_is, [&](const Merit& worst) { return worst < to_beat; }));
    if (all.back().whole && all.back().worst > to_beat) to_beat = all.back().worst;
  }
  return all;
}

std::size_t best_within(const std::vector<WithinTolerance>& judged) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < judged.size(); ++k)
    if (judged[k].whole && judged[k].worst > judged[best].worst) best = k;
  return best;
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
