#include "strain/cable_rubbing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dresslife::strain {

double CableRubbing::width() { return 2 * std::numbers::pi / sectors; }

/// Returns the sector of a direction. guess: is tested first without computing an angle, because a cable stays in its sector for
/// many samples.
std::size_t CableRubbing::sector_of(double x, double y, std::size_t guess) {
  static const auto borders = [] {
    std::array<std::array<double, 2>, sectors + 1> of;
    for (std::size_t k = 0; k <= sectors; ++k) {
      const double angle = static_cast<double>(k) * width();
      of[k] = {std::cos(angle), std::sin(angle)};
    }
    return of;
  }();
  const auto left_of = [&](const std::array<double, 2>& border) { return border[0] * y - border[1] * x; };
  if (left_of(borders[guess]) > 0 && left_of(borders[guess + 1]) < 0) return guess;
  const double angle = std::atan2(y, x);
  return static_cast<std::size_t>((angle < 0 ? angle + 2 * std::numbers::pi : angle) / width()) % sectors;
}

void CableRubbing::move_across(std::size_t sample, const LooseCable& cable, const CableState& state, double line_load,
                               double spacing) {
  const std::size_t elements = state.press.size() - 1;
  const auto middle = [](const std::vector<double>& of, std::size_t element, std::size_t d) {
    return (of[2 * element + d] + of[2 * element + 2 + d]) / 2;
  };
  sector_.resize(elements);
  if (laid_.empty())
    for (std::size_t e = 0; e < elements; ++e) {
      const double turn = cable.lay_rate * spacing * (static_cast<double>(e) + 0.5);
      laid_.push_back({std::cos(turn) * cable.place[0] - std::sin(turn) * cable.place[1],
                       std::sin(turn) * cable.place[0] + std::cos(turn) * cable.place[1]});
    }
  // Within this radius the cable is nearer to the core, and touches with its inner side.
  const double between = cable.farthest < without_limit ? (cable.nearest + cable.farthest) / 2 : 0;
  const auto pressing = [](const std::vector<double>& of, std::size_t element) {
    return (of[element] + of[element + 1]) / 2;
  };
  for (std::size_t i = 0; i < segments_; ++i) {
    const std::size_t first = i * elements / segments_, end = std::max(first + 1, (i + 1) * elements / segments_);
    const double length = spacing * static_cast<double>(elements) / static_cast<double>(segments_ * (end - first));
    double x = 0, y = 0;
    for (std::size_t e = first; e < end; ++e) {
      const double to_x = middle(state.offset, e, 0), to_y = middle(state.offset, e, 1), now = pressing(state.press, e);
      double at_x = laid_[e][0] + to_x, at_y = laid_[e][1] + to_y;
      const double turned = at_x * at_x + at_y * at_y < between * between ? -1 : 1;
      at_x *= turned, at_y *= turned;
      x += (line_load + now) * at_x, y += (line_load + now) * at_y;
      if (pressed_.empty()) continue;
      const double by_x = to_x - middle(offset_, e, 0), by_y = to_y - middle(offset_, e, 1);
      const double moved = std::sqrt(by_x * by_x + by_y * by_y);
      const double before = pressing(pressed_, e), less = std::min(now, before);
      const double mid_x = at_x - turned * by_x / 2, mid_y = at_y - turned * by_y / 2,
                   radius = std::sqrt(mid_x * mid_x + mid_y * mid_y);
      const double around = radius > 0 ? std::abs(by_x * mid_y - by_y * mid_x) / radius : 0;
      const double work = ((line_load + less) * moved + ((now + before) / 2 - less) * around) * length;
      if (!(work > 0)) continue;
      const std::size_t sector = sector_of(at_x, at_y, sector_[e]);
      sector_[e] = static_cast<std::uint8_t>(sector);
      across_.add(i, sector, sample, work);
    }
    touch(i, sample, x, y);
  }
  pressed_ = state.press;
  offset_ = state.offset;
}

std::vector<CableRubbing::Patch> CableRubbing::patches() const {
  std::vector<Patch> patches;
  for (std::size_t k = 0; k < across_.of.size(); ++k) {
    const Sum &across = across_.of[k], &along = along_.of[k];
    if (const double work = across.work + along.work; work > 0)
      patches.push_back({k / sectors, (static_cast<double>(k % sectors) + 0.5) * width(), work,
                         (across.largest > along.largest ? across : along).at});
  }
  return patches;
}

}  // namespace dresslife::strain
