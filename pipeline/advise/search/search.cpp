#include "pipeline/advise/search/search.h"

#include <algorithm>

#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {

double Candidate::violation() const { return sum_above_zero(beyond); }

bool better(const Candidate& a, const Candidate& b) {
  if (a.ran != b.ran) return a.ran;
  if (a.violation() != b.violation()) return a.violation() < b.violation();
  return a.ran && !a.aims.empty() && a.aims.front() < b.aims.front();
}

namespace {

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool smaller = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    smaller = smaller || a[k] < b[k];
  }
  return smaller;
}

}  // namespace

std::vector<std::size_t> front(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> best;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto beats = [&](const Candidate& other) {
      return other.feasible() && dominates(other.aims, candidates[k].aims);
    };
    if (candidates[k].feasible() && std::none_of(candidates.begin(), candidates.end(), beats)) best.push_back(k);
  }
  std::stable_sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) {
    return candidates[a].aims.front() < candidates[b].aims.front();
  });
  return best;
}

}  // namespace dresslife::pipeline
