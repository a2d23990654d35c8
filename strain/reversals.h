// Turning points of a strain history ((W14) in strain/theory.md).
//
// A hysteresis filter keeps the first and last sample and every turning point between rises and falls of at least the gate. It
// drops only cycles with a range below the gate. Rainflow counting of the kept points finds every cycle of range >= gate with
// its true extremes. A plateau counts at its first sample.
//
// `TurningPoints` filters one history. `LaneScan` filters the wires of a layer, sixteen side by side, from the five waves of
// the layer (W13):
//     strain_j(t) = w0 + w1 sin(theta_j) + w2 cos(theta_j) + w3 sin(2 theta_j) + w4 cos(2 theta_j).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "strain/kernels/kernels.h"

namespace dresslife::strain {

/// Precondition of both classes: finite strains.
class TurningPoints {
 public:
  /// gate: smallest range kept, >= 0.
  explicit TurningPoints(float gate) : gate_(gate) {}

  void next(std::span<const float> strains, TurningList& out);  ///< the next samples, in order
  void finish(TurningList& out) const;                          ///< after the last sample

 private:
  void begin(float strain, TurningList& out);

  float gate_;
  std::uint32_t sample_ = 0;  ///< of the next strain
  float last_ = 0;
  int direction_ = 0;  ///< +1 rising, -1 falling, 0 not yet known
  float extreme_ = 0, low_ = 0, high_ = 0;
  std::uint32_t extreme_at_ = 0, low_at_ = 0, high_at_ = 0;
};

class LaneScan {
 public:
  /// angles: theta_j of up to 16 wires, relative to the angle from which the waves count [rad].
  LaneScan(std::span<const double> angles, float gate);

  /// Returns the input of the kernels for the next `count` samples. Turning points of wire j go to out[j]. The caller sets waves
  /// or strains, and calls done() after the scan.
  LaneRun next(std::size_t count, std::span<TurningList> out);
  void done(std::span<TurningList> out) const;
  void finish(std::span<TurningList> out);  ///< after the last sample

  /// Replaces next() and done() for wires that are only ranked.
  LaneRun next_to_rank();
  StrainMeasures measures(std::size_t wire) const;

  void restart();  ///< before another history of the same wires

  int wires() const { return state_.used; }

 private:
  LaneState state_;
  LaneRanks ranks_;
  std::array<TurningPoint*, lanes> end_{};
};

}  // namespace dresslife::strain
