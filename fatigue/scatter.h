// Scatter of life: when the first wires break, and when enough wires have broken for a conductor to fail.
//
// The life of a wire is the life of its worst place by the curves, which are medians, times a lognormal factor
// (F14): log10(life) = log10(median) + s z, z normal, one z per wire. The probability of a break by the time t:
//     p(t) = Phi(log10(t / median) / s)
// The probability that k of n wires have broken is the upper tail of the Poisson-binomial distribution of
// their p (F15). Percentiles are found by bisection in log t. All lives are in repeats of the motion.
//
// A share c of the variance s^2 is common to all wires of a dresspack (F25):
//     z = sqrt(c) z_common + sqrt(1 - c) z_own.
// For a given z_common, (F15) holds with sqrt(1 - c) s. Its distribution over ln t is convolved with the common factor in closed
// form, linear between tabulated points.
//
// Assumptions: apart from the common factor, wires are independent of each other. The places of one wire are not independent
// (one z), because a segment is not a separate piece of metal. A wire counts as broken if it breaks at any place along the
// dresspack, except in first_place_lives(), where a conductor's share must have broken in one segment.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fatigue/life_distribution.h"

namespace dresslife::fatigue {

/// Definitions of a failed conductor: its first wire, a share of its wires, or all of them have broken.
constexpr std::size_t failures = 3;
using FailureLives = std::array<Percentiles, failures>;

/// Returns the lives by which at least one wire has broken. damage: (dresspack) (wire).
Percentiles first_wire_lives(std::span<const std::vector<double>> damage, Scatter scatter);

/// The wires of one conductor.
struct ConductorWires {
  std::vector<double> damage;  ///< (wire) per repeat at its worst place
  std::size_t dresspack = 0;   ///< conductors of different dresspacks have no common factor
  /// (broken) factor on the damage of the remaining wires with so many broken; empty: 1.
  std::vector<double> rate;
};

/// Returns the lives of one conductor without load sharing (F15).
FailureLives conductor_lives(const ConductorWires& bundle, double failed_percent, Scatter scatter);

/// Returns the life by which the first of several conductors has lost `failed_percent` of its wires.
Percentiles first_conductor_lives(std::span<const ConductorWires> bundles, double failed_percent, Scatter scatter);

/// Lives with load sharing: the remaining wires of a conductor take over the load of the broken wires (F16).
struct SharedLives {
  std::vector<FailureLives> conductor;  ///< (conductor)
  Percentiles first_conductor;
};

/// Returns lives with ConductorWires::rate, from `draws` samples of all wires with a fixed seed. With k wires broken every
/// remaining wire is damaged rate[k] times as fast. In a time that runs faster by this factor the wires break as without
/// sharing, so a sample gives all its breaks by one sort.
SharedLives shared_lives(std::span<const ConductorWires> bundles, double failed_percent, Scatter scatter, int draws);

/// A conductor in one segment.
struct PlaceOfConductor {
  std::size_t conductor, segment;
};
using DamageAt = std::function<std::span<const double>(std::size_t conductor, std::size_t segment)>;

/// Returns the life by which the first of these places has lost `failed_percent` of its wires, from the samples of
/// shared_lives(). The places of one conductor must be adjacent. damage_at: damage per repeat in one segment, (wire).
Percentiles shared_place_lives(std::span<const ConductorWires> bundles, std::span<const PlaceOfConductor> places,
                               double failed_percent, Scatter scatter, int draws, const DamageAt& damage_at);

/// Returns a number from the standard normal distribution. It depends only on the arguments, on every machine.
double normal_of(std::uint64_t stream, std::uint64_t draw);

}  // namespace dresslife::fatigue
