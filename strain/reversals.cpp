#include "strain/reversals.h"

#include <cassert>
#include <cmath>

namespace dresslife::strain {

/// Takes samples until the first range of at least the gate sets the direction.
void TurningPoints::begin(float strain, TurningList& out) {
  const std::uint32_t now = sample_++;
  last_ = strain;
  if (now == 0) {
    out.add(strain, now);
    low_ = high_ = extreme_ = strain;
    return;
  }
  if (strain < low_) low_ = strain, low_at_ = now;
  if (strain > high_) high_ = strain, high_at_ = now;
  if (high_ - low_ < gate_ || !(high_ > low_)) return;
  const bool rising = high_at_ == now;
  const std::uint32_t before = rising ? low_at_ : high_at_;
  if (before > 0) out.add(rising ? low_ : high_, before);
  direction_ = rising ? 1 : -1;
  extreme_ = strain;
  extreme_at_ = now;
}

void TurningPoints::next(std::span<const float> strains, TurningList& out) {
  std::size_t k = 0;
  while (k < strains.size() && direction_ == 0) begin(strains[k++], out);
  const std::uint32_t first = sample_ - static_cast<std::uint32_t>(k);
  float direction = static_cast<float>(direction_),
        extreme = extreme_;  // in registers, because most samples change neither
  std::uint32_t extreme_at = extreme_at_;
  for (; k < strains.size(); ++k) {
    const float beyond = direction * (strains[k] - extreme);
    if (beyond < 0 && -beyond >= gate_) {
      out.add(extreme, extreme_at);
      direction = -direction;
    } else if (!(beyond > 0)) {
      continue;
    }
    extreme = strains[k];
    extreme_at = first + static_cast<std::uint32_t>(k);
  }
  direction_ = static_cast<int>(direction);
  extreme_ = extreme;
  extreme_at_ = extreme_at;
  sample_ = first + static_cast<std::uint32_t>(strains.size());
  if (!strains.empty()) last_ = strains.back();
}

void TurningPoints::finish(TurningList& out) const {
  if (sample_ < 2) return;
  if (direction_ != 0 && extreme_at_ != sample_ - 1) out.add(extreme_, extreme_at_);
  out.add(last_, sample_ - 1);
}

LaneScan::LaneScan(std::span<const double> angles, float gate) {
  assert(!angles.empty() && angles.size() <= lanes);
  state_.used = static_cast<int>(angles.size());
  state_.below_gate = gate > 0 ? std::nextafter(gate, 0.0f) : 0;
  for (int lane = 0; lane < lanes; ++lane) {
    const double angle = angles[lane < state_.used ? lane : 0];
    state_.shape[0][lane] = static_cast<float>(std::sin(angle));
    state_.shape[1][lane] = static_cast<float>(std::cos(angle));
    state_.shape[2][lane] = static_cast<float>(std::sin(2 * angle));
    state_.shape[3][lane] = static_cast<float>(std::cos(2 * angle));
  }
  restart();
}

void LaneScan::restart() {
  state_.sample = 0;
  state_.decided = 0;
}

LaneRun LaneScan::next(std::size_t count, std::span<TurningList> out) {
  assert(static_cast<int>(out.size()) == state_.used && count > 0);
  for (std::size_t wire = 0; wire < out.size(); ++wire) end_[wire] = out[wire].room(count + spare_points);
  return {&state_, nullptr, nullptr, nullptr, end_.data()};
}

LaneRun LaneScan::next_to_rank() { return {&state_, nullptr, nullptr, &ranks_, nullptr}; }

StrainMeasures LaneScan::measures(std::size_t wire) const {
  return {ranks_.low[wire], ranks_.high[wire], ranks_.cycle_sum[wire], ranks_.range_sum[wire]};
}

void LaneScan::done(std::span<TurningList> out) const {
  for (std::size_t wire = 0; wire < out.size(); ++wire) out[wire].set_end(end_[wire]);
}

void LaneScan::finish(std::span<TurningList> out) {
  for (int wire = 0; wire < state_.used && state_.sample > 1; ++wire) {
    const bool moved = (state_.decided >> wire & 1) != 0;
    if (moved && state_.extreme_at[wire] != state_.sample - 1)
      out[wire].add(state_.extreme[wire], static_cast<std::uint32_t>(state_.extreme_at[wire]));
    out[wire].add(state_.last[wire], static_cast<std::uint32_t>(state_.sample - 1));
  }
}

}  // namespace dresslife::strain
