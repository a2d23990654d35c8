#include "strain/starts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"

namespace dresslife::strain {
namespace {

// Largest relative difference of curvature between two starts of one rest. Each cycle reduces it to at most an eighth.
constexpr double same_rest = 1e-3;

}  // namespace

std::size_t other_starts_at_most(const pipeline::Job& job) {
  for (const pipeline::MountedDresspack& mounted : job.dresspacks) {
    int cables = 0;
    for (const pipeline::Component& component : mounted.dresspack.components)
      if (!component.components.empty()) cables += component.count;
    if (cables > 1 && !mounted.dresspack.cable_alone) return Starts::count - 1;
  }
  return 0;
}

Starts::Starts(Spans& own, const std::function<Spans&()>& build) : own_(own) {
  const auto ring = [](const auto& evaluation) { return evaluation->cables().any_ring(); };
  if (std::ranges::none_of(own, ring)) return;
  rest_of_.resize(count);
  std::iota(rest_of_.begin(), rest_of_.end(), 0);
  std::uint64_t seed = 0;
  for (std::size_t start = 1; start < count; ++start) {
    others_.push_back(&build());
    for (const auto& evaluation : *others_.back())
      if (evaluation->any_loose()) evaluation->wind(pipeline::mixed(seed++));
  }
}

std::vector<Evaluation*> Starts::placed(std::size_t span) const {
  std::vector<Evaluation*> all;
  for (const Spans* of : others_) all.push_back((*of)[span].get());
  return all;
}

void Starts::merge() {
  const auto same = [&](const Spans& one, const Spans& other) {
    for (std::size_t span = 0; span < one.size(); ++span)
      if (one[span]->any_loose() && !(one[span]->cables().apart(other[span]->cables()) < same_rest)) return false;
    return true;
  };
  for (std::size_t rest = 1; rest < rests(); ++rest)
    for (std::size_t earlier = 0; earlier < rest; ++earlier) {
      if (!same(spans(rest), spans(earlier))) continue;
      others_[rest - 1]->clear();  // not used from now on
      others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(rest - 1));
      for (std::size_t& of : rest_of_)
        if (of >= rest) of = of == rest ? earlier : of - 1;
      --rest;
      break;
    }
}

/// Returns the place of the quantile z among the starts, the most damaged one first. For an even number of starts z = 0 gives the
/// more damaged one of the middle two.
std::size_t Starts::place_of(double z) const {
  const std::size_t starts = rest_of_.size();
  const auto at = static_cast<std::size_t>(std::ceil(pipeline::normal_share(z) * static_cast<double>(starts)));
  return std::clamp<std::size_t>(at, 1, starts) - 1;
}

bool Starts::choose_by_number(double z) {
  for (std::size_t rest = 0; rest < rests() && !rest_of_.empty(); ++rest) {
    const auto own = static_cast<std::size_t>(std::ranges::count(rest_of_, rest)), others = rest_of_.size() - own;
    if (others > place_of(z) || place_of(z) >= own) continue;
    make_own(rest);
    return true;
  }
  return false;
}

void Starts::choose(double z, const std::vector<double>& damage) {
  if (rest_of_.empty()) return;
  std::vector<std::size_t> starts = rest_of_;  // the largest damage first
  std::ranges::stable_sort(starts, std::ranges::greater(), [&](std::size_t rest) { return damage[rest]; });
  make_own(starts[place_of(z)]);
}

void Starts::make_own(std::size_t rest) {
  if (rest == 0) return;
  std::ranges::swap_ranges(own_, *others_[rest - 1]);
  for (std::size_t& of : rest_of_)
    if (of == 0 || of == rest) of = rest - of;
}

}  // namespace dresslife::strain
