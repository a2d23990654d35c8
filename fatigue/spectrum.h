// Load spectra by stress: for parts whose maker gives a stress-life line instead of a strain-life curve
// (hose, connector, clamp), and to compare a counting with spectra that others have published.
//
// Stress-life line (Basquin 1910), (F10): N = N_D (s / S_D)^-k, s the stress amplitude.
// Elementary Miner continues the line below S_D; consistent Miner (Haibach, Betriebsfestigkeit, 3rd edition
// 2006, 3.2) lets the fatigue limit fall with damage, S_D(D) = S_D (1 - D)^(1/q), q = k - 1 (F11).
#pragma once

#include <span>
#include <vector>

#include "fatigue/rainflow.h"

namespace dresslife::fatigue {

/// Cycles of one stress amplitude in a spectrum.
struct SpectrumStep {
  double amplitude = 0;  ///< [Pa]
  double count = 0;
};

struct StressLife {
  double limit = 0;         ///< S_D [Pa]
  double limit_cycles = 0;  ///< N_D
  double slope = 0;         ///< k > 1

  double cycles(double amplitude) const;  ///< to failure, by the line alone
  /// Miner's sum of one spectrum, elementary: the line holds for every amplitude.
  double damage(std::span<const SpectrumStep> spectrum) const;
  /// Spectra to failure by consistent Miner; infinity when nothing reaches S_D.
  double spectra_to_failure(std::span<const SpectrumStep> spectrum) const;
};

/// Ranges of zero mean that do the same damage as `range` about `mean` [Pa].
double walker_range(double range, double mean, double gamma);  ///< (2 mean + range)^(1-gamma) range^gamma
double swt_range(double range, double mean);                   ///< gamma 1/2
double morrow_range(double range, double mean, double fatigue_strength);  ///< range / (1 - mean / sf')

/// Reversals of a history rounded to the bounds of `classes` equal classes between its smallest and largest
/// value; a value half-way between two bounds goes outward (a peak up, a valley down); equal neighbours
/// merge. ISO 12110-2.
std::vector<Reversal> classed_reversals(std::span<const double> history, int classes);

/// Ranges that the residue counts by DIN 45667: its rises and falls, each sorted by size, are paired and the
/// smaller of each pair is counted. Largest first.
std::vector<double> paired_ranges(std::span<const Reversal> residue);

}  // namespace dresslife::fatigue
