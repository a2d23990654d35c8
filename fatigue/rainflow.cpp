#include "fatigue/rainflow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pipeline/base/errors.h"

namespace dresslife::fatigue {
namespace {

/// Returns whether the way from top to next covers the range from below to top (F1). top is an extreme between the two.
bool covers(double below, double top, double next) { return next > top ? next >= below : next <= below; }

/// Returns whether next lies beyond top in the direction from below to top.
bool continues(double below, double top, double next) { return (top > below) == (next > top); }

/// Appends a reversal so that rises and falls alternate.
void append_alternating(std::vector<Reversal>& to, const Reversal& reversal) {
  if (!to.empty() && to.back().strain == reversal.strain) return;
  if (to.size() > 1 && continues(to[to.size() - 2].strain, to.back().strain, reversal.strain)) {
    to.back() = reversal;
  } else {
    to.push_back(reversal);
  }
}

}  // namespace

std::optional<Reversal> ReversalFinder::push(double strain) {
  const Reversal now{strain, sample_++};
  if (!std::isfinite(strain)) {
    throw pipeline::InputError({},
                               fmt::format("sample {} of a strain history is {} (must be finite)", now.sample, strain),
                               "repair the history; a gap cannot be counted over");
  }
  if (now.sample == 0) return candidate_ = now;
  if (strain == candidate_.strain) return std::nullopt;
  const int direction = strain > candidate_.strain ? 1 : -1;
  const Reversal turned = candidate_;
  const bool turns = direction_ == -direction;
  direction_ = direction;
  candidate_ = now;
  return turns ? std::optional(turned) : std::nullopt;
}

std::optional<Reversal> ReversalFinder::finish() const {
  return direction_ == 0 ? std::nullopt : std::optional(candidate_);
}

std::vector<Reversal> find_reversals(std::span<const double> history) {
  ReversalFinder finder;
  std::vector<Reversal> reversals;
  for (const double strain : history) {
    if (const auto reversal = finder.push(strain)) reversals.push_back(*reversal);
  }
  if (const auto last = finder.finish()) reversals.push_back(*last);
  return reversals;
}

std::vector<Cycle> count_half_cycles(std::span<const Reversal> reversals) {
  if (const std::size_t bad = first_going_on(reversals, [](const Reversal& r) { return r.strain; });
      bad < reversals.size())
    throw pipeline::InputError(
        {},
        fmt::format("reversal {} of a strain history continues from {} to {} in the direction of the one before "
                    "(rises and falls must alternate)",
                    bad, reversals[bad - 1].strain, reversals[bad].strain),
        "leave out what is no turn, or count the repeated history");
  std::vector<Cycle> cycles;
  std::vector<Reversal> open;
  std::size_t first = 0;  // of the open reversals
  for (const Reversal& next : reversals) {
    if (!open.empty() && open.back().strain == next.strain) continue;
    while (open.size() - first >= 2) {
      const Reversal below = open[open.size() - 2], top = open.back();
      if (!covers(below.strain, top.strain, next.strain)) break;
      const bool holds_start = open.size() - first == 2;
      cycles.push_back({below, top, holds_start ? 0.5 : 1.0});
      if (holds_start) {
        ++first;
      } else {
        open.resize(open.size() - 2);
      }
    }
    open.push_back(next);
  }
  for (std::size_t i = first; i + 1 < open.size(); ++i) cycles.push_back({open[i], open[i + 1], 0.5});
  return cycles;
}

std::vector<Reversal> rotate_to_largest(std::span<const Reversal> reversals) {
  assert(!reversals.empty());
  const auto largest = std::ranges::max_element(
      reversals, [](const Reversal& a, const Reversal& b) { return std::fabs(a.strain) < std::fabs(b.strain); });
  std::vector<Reversal> period;
  period.reserve(reversals.size() + 1);
  for (auto r = largest; r != reversals.end(); ++r) append_alternating(period, *r);
  for (auto r = reversals.begin(); r != largest; ++r) append_alternating(period, *r);
  append_alternating(period, *largest);
  return period;
}

std::vector<Cycle> count_repeating(std::span<const Reversal> reversals) {
  std::vector<Cycle> cycles;
  if (reversals.empty()) return cycles;
  const std::vector<Reversal> period = rotate_to_largest(reversals);
  std::vector<Reversal> open{period.front()};
  for (std::size_t i = 1; i < period.size(); ++i) {
    while (open.size() >= 2) {
      const Reversal below = open[open.size() - 2], top = open.back();
      if (!covers(below.strain, top.strain, period[i].strain)) break;
      cycles.push_back({below, top, 1});
      open.resize(open.size() - 2);
    }
    open.push_back(period[i]);
  }
  return cycles;
}

}  // namespace dresslife::fatigue
