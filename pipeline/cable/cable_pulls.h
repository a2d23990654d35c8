// What the strains of a span's cables ask of them and of its clamps (strain/README.md, W37).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "pipeline/cable/cable_force.h"

namespace dresslife::pipeline {

/// A cable between two clamps.
struct PulledCable {
  CableForce force;
  /// (sample) strain that makes its force: the largest along it by size, at the base clamp, at the tool
  /// clamp.
  std::array<std::vector<double>, 3> strain{};
  /// Of its axis at the base and at the tool clamp, toward d1 and d2 [m].
  std::array<std::array<double, 2>, 2> place{};
};

struct CablePulls {
  /// Largest force along each cable by size, with its sign (cable, sample) [N].
  std::vector<std::vector<double>> tension;
  std::vector<double> moment;  ///< of all cables on the hose, the larger of both clamps (sample) [N m]
  /// Largest tension at each cable's base and at its tool clamp, 0: pressed only (cable, 2) [N].
  std::vector<std::array<double, 2>> end_pull;
  double force_share = 0;      ///< over the force at which a cable tears, the largest of all; 0: not known
  std::size_t of_cable = 0, at_sample = 0;  ///< where and when that is
};

/// Precondition: strains of as many samples.
CablePulls pulls_of(std::span<const PulledCable> cables, std::size_t samples);

/// Largest moment of all cables over the largest that the simulated hose carries; 0: it carries none.
double moment_share(const CablePulls& pulls, std::span<const double> hose_moment);

}  // namespace dresslife::pipeline
