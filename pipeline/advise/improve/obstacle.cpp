#include "pipeline/advise/improve/obstacle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dresslife::pipeline {

std::size_t nearest_trial(const std::vector<Trial>& trials) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = trials.size();
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (trials[k].worst.failure.empty() && trials[k].worst.violation() < least)
      least = trials[k].worst.violation(), nearest = k;
  return nearest;
}

namespace {

/// Returns the limits that no trial keeps; if each limit is kept by some trial, the limits that the nearest trial violates.
std::vector<std::string> binding(const std::vector<Trial>& trials, const Trial& nearest) {
  std::vector<std::string> lines;
  std::string together;
  for (std::size_t k = 0; k < nearest.worst.beyond.size(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t t = 0; t < trials.size(); ++t)
      if (trials[t].worst.failure.empty() && trials[t].worst.beyond[k] < least)
        least = trials[t].worst.beyond[k], best = t;
    const std::string& name = outcome_limit_names()[k];
    const std::vector<std::string>& reached = trials[best].worst.reached;
    if (least > 0)
      lines.push_back(fmt::format("No trial keeps {}: the best violates it by {} ({}{})", name, passed_text(k, least),
                                  k < reached.size() && !reached[k].empty() ? reached[k] + "; " : "",
                                  best == 0 ? "the jobs as they are" : fmt::format("trial {}", best)));
    if (nearest.worst.beyond[k] > 0) together += (together.empty() ? "" : ", ") + name;
  }
  if (lines.empty())
    lines.push_back(fmt::format("Each limit is kept by some trial, but not with the others: {}", together));
  return lines;
}

/// Returns "; it lives 3.2 times as long as the jobs as they are", by the p10 lives of both trials; empty if the original jobs
/// have no finite life above 0.
std::string life_words(const Trial& nearest, const Trial& as_they_are) {
  const double ratio = nearest.worst.hours / as_they_are.worst.hours;
  if (!as_they_are.worst.failure.empty() || !std::isfinite(ratio) || ratio <= 0) return "";
  return fmt::format("; it lives {:.{}f} times as long as the jobs as they are", ratio, ratio < 10 ? 2 : 0);
}

}  // namespace

std::vector<std::string> obstacle_words(const std::vector<Trial>& trials, const Freedom& freedom) {
  const std::size_t k = nearest_trial(trials);
  if (k == trials.size()) return {fmt::format("No trial runs; the last: {}", trials.back().worst.failure)};
  const Trial& nearest = trials[k];
  std::vector<std::string> lines{
      k == 0 ? fmt::format("Nearest are the jobs as they are: {}", nearest.worst.words())
             : fmt::format("Nearest is trial {}: {}{}", k, nearest.worst.words(), life_words(nearest, trials.front()))};
  for (std::string& line : binding(trials, nearest)) lines.push_back(std::move(line));
  if (nearest.place.size() == 0) return lines;
  const std::vector<std::string> ends = freedom.at_ends(nearest.place);
  for (const std::string& end : ends) lines.push_back("A free key is at the end of its range: " + end + "; widen it");
  if (ends.empty())
    lines.push_back(
        "No free key is at an end of its range: allow more trials, free other keys, or take another dresspack");
  return lines;
}

}  // namespace dresslife::pipeline
