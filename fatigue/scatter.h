// Scatter of life: when the first wires break, and when so many have broken that a conductor fails.
//
// Every wire's life is the life of its worst place by the curves, which are medians, times a lognormal factor
// (F14): log10(life) = log10(median) + s z, z normal, one z per wire. Probability that a wire has
// broken by the time t:
//     p(t) = Phi(log10(t / median) / s)
// The probability that k of n wires have broken is the upper tail of the Poisson-binomial distribution of
// their p (F15). Percentiles are found by bisection in log t. All lives are in repeats of the motion.
//
// A share c of the variance s^2 is common to all wires of a dresspack (F25):
//     z = sqrt(c) z_common + sqrt(1 - c) z_own.
// With z_common given, (F15) holds with sqrt(1 - c) s; its distribution over ln t is spread by the common
// factor in closed form, straight between tabulated points.
//
// Assumptions: apart from the common factor, wires are independent of each other; the places of one wire are
// not (one z, because a segment is no separate piece of metal). A wire counts as broken wherever along the
// dresspack it breaks, except in first_place_lives(), where a conductor's share must have broken in one
// segment.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fatigue/life_distribution.h"

namespace dresslife::fatigue {

/// When a conductor has failed: its first wire, a share of its wires, or all of them.
constexpr std::size_t failures = 3;
using FailureLives = std::array<Percentiles, failures>;

/// Lives by which at least one wire has broken, of wires that lie in several dresspacks: (dresspack) (wire)
/// damage.
Percentiles first_wire_lives(std::span<const std::vector<double>> damage, Scatter scatter);

/// The wires of one conductor.
struct ConductorWires {
  std::vector<double> damage;  ///< (wire) per repeat of its worst place
  std::size_t dresspack = 0;   ///< conductors of different ones share no common factor
  /// (broken) how much faster the rest is damaged when so many have broken; empty: no faster.
  std::vector<double> rate;
};

/// Lives of one conductor whose wires do not take over load: (F15).
FailureLives conductor_lives(const ConductorWires& bundle, double failed_percent, Scatter scatter);

/// Life by which the first of several conductors has lost `failed_percent` of its wires.
Percentiles first_conductor_lives(std::span<const ConductorWires> bundles, double failed_percent,
                                  Scatter scatter);

/// What happens when the rest of a conductor takes over the load of its broken wires (F16).
struct SharedLives {
  std::vector<FailureLives> conductor;  ///< (conductor)
  Percentiles first_conductor;
};

/// The same with ConductorWires::rate, by `draws` draws of all wires with a fixed seed. With k broken, every wire
/// left is damaged rate[k] times as fast; in the time that runs faster by that factor the wires break as if
/// nothing were shared, so one sorting of a draw gives all its breaks.
SharedLives shared_lives(std::span<const ConductorWires> bundles, double failed_percent, Scatter scatter,
                         int draws);

/// A conductor in one segment, and what its wires suffer there per repeat, (wire).
struct PlaceOfConductor {
  std::size_t conductor, segment;
};
using DamageAt = std::function<std::span<const double>(std::size_t conductor, std::size_t segment)>;

/// By the same draws, when the first of these places, those of a conductor in a row, has lost
/// `failed_percent` of its wires.
Percentiles shared_place_lives(std::span<const ConductorWires> bundles,
                               std::span<const PlaceOfConductor> places, double failed_percent,
                               Scatter scatter, int draws, const DamageAt& damage_at);

/// A number from the standard normal distribution, the same for the same pair on every machine.
double normal_of(std::uint64_t stream, std::uint64_t draw);

}  // namespace dresslife::fatigue
