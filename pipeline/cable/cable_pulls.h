// Forces in the cables of a span and on its clamps, caused by the cables' strains (strain/theory.md, W37).
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
  /// Strain of the cable's force, (sample): the strain of largest size along the cable, that at the base clamp, that at the tool
  /// clamp.
  std::array<std::vector<double>, 3> strain{};
  /// Position of its axis at the base and at the tool clamp, toward d1 and d2 [m].
  std::array<std::array<double, 2>, 2> place{};
};

struct CablePulls {
  /// Force of largest size along each cable, with its sign (cable, sample) [N].
  std::vector<std::vector<double>> tension;
  std::vector<double> moment;  ///< of all cables on the hose, at the clamp with the larger moment (sample) [N m]
  /// Largest tension at each cable's base clamp and at its tool clamp (cable, 2) [N]; 0: only compression.
  std::vector<std::array<double, 2>> end_pull;
  double force_share = 0;                   ///< largest ratio of force to breaking force of all cables; 0: unknown
  std::size_t of_cable = 0, at_sample = 0;  ///< cable and sample of that ratio
};

/// Returns the pulls. Precondition: all strains have `samples` samples.
CablePulls pulls_of(std::span<const PulledCable> cables, std::size_t samples);

/// Returns the largest moment of all cables / the largest moment of the simulated hose; 0 if the hose has no moment.
double moment_share(const CablePulls& pulls, std::span<const double> hose_moment);

}  // namespace dresslife::pipeline
