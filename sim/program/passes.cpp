#include "sim/program/passes.h"

#include <algorithm>
#include <tuple>

namespace dresslife::sim {
namespace {

constexpr int repeats_for_certainty = 3;

/// Whether two moves are the same motion; where they stand in the program does not count.
bool alike(const Instruction& a, const Instruction& b) {
  const auto same_pose = [](const Frame& x, const Frame& y) {
    return x.position == y.position && x.orientation.coeffs() == y.orientation.coeffs();
  };
  const auto settings = [](const Instruction& i) {
    return std::tie(i.kind, i.target.joints, i.target.configuration, i.target.external_axes, i.tool,
                    i.work_object, i.speed.axis_percent, i.speed.tool, i.speed.orientation, i.speed.duration,
                    i.zone.distance, i.zone.percent, i.acceleration_percent, i.dwell);
  };
  return settings(a) == settings(b) && same_pose(a.target.pose, b.target.pose) && same_pose(a.via, b.via);
}

}  // namespace

void Passes::add(std::uint64_t state) {
  ends_.push_back(moves_->size());
  states_.push_back(state);
}

bool Passes::same_motion(std::size_t a, std::size_t b) const {
  const auto at = [&](std::size_t pass) { return moves_->begin() + static_cast<long>(ends_[pass]); };
  return std::equal(at(a - 1), at(a), at(b - 1), at(b), alike);
}

bool Passes::repeats() const {
  const std::size_t last = count();
  for (std::size_t pass = 1; pass < last; ++pass)
    if (states_[pass - 1] == states_[last - 1] && same_motion(pass, last)) return true;
  return false;
}

std::size_t Passes::by_motion() const {
  const std::size_t last = count();
  for (std::size_t period = 1; period * (repeats_for_certainty + 1) <= last; ++period) {
    std::size_t first = last - period;  // the earliest pass from which on each equals the one a period later
    while (first >= 1 && same_motion(first, first + period)) --first;
    if (first + 1 + repeats_for_certainty * period <= last) return first + period;
  }
  return 0;
}

std::size_t Passes::kept(std::size_t wanted) const {
  if (wanted) return wanted;
  if (repeats()) return count() - 1;
  if (const std::size_t periodic = by_motion()) return periodic;
  std::size_t first = 1;  // that moves
  while (first < count() && end(first) == end(0)) ++first;
  return first;
}

}  // namespace dresslife::sim
