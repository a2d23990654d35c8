#include "fatigue/spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

namespace dresslife::fatigue {

double StressLife::cycles(double amplitude) const {
  return limit_cycles * std::pow(amplitude / limit, -slope);
}

double StressLife::damage(std::span<const SpectrumStep> spectrum) const {
  double sum = 0;
  for (const SpectrumStep& step : spectrum) sum += step.count / cycles(step.amplitude);
  return sum;
}

// While the limit falls from one amplitude of the spectrum to the next lower one, the same steps do damage d
// per spectrum, so by (F11) that takes ((S_from/S_D)^q - (S_to/S_D)^q) / d spectra.
double StressLife::spectra_to_failure(std::span<const SpectrumStep> spectrum) const {
  assert(slope > 1);
  std::vector<SpectrumStep> falling(spectrum.begin(), spectrum.end());
  std::sort(falling.begin(), falling.end(),
            [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  const auto undamaged = [&](double stress) { return std::pow(stress / limit, slope - 1); };
  double spectra = 0, per_spectrum = 0, from = limit;
  for (std::size_t i = 0; i < falling.size(); ++i) {
    if (falling[i].amplitude < from) break;  // the limit stays above it: only possible for the largest
    per_spectrum += falling[i].count > 0 ? falling[i].count / cycles(falling[i].amplitude) : 0;
    const double next = i + 1 < falling.size() ? falling[i + 1].amplitude : 0;
    if (next >= limit) continue;
    spectra += (undamaged(from) - undamaged(next)) / per_spectrum;
    from = next;
  }
  return spectra > 0 ? spectra : std::numeric_limits<double>::infinity();
}

double walker_range(double range, double mean, double gamma) {
  return std::pow(2 * mean + range, 1 - gamma) * std::pow(range, gamma);
}

double swt_range(double range, double mean) { return walker_range(range, mean, 0.5); }

double morrow_range(double range, double mean, double fatigue_strength) {
  return range / (1 - mean / fatigue_strength);
}

std::vector<Reversal> classed_reversals(std::span<const double> history, int classes) {
  assert(classes > 0);
  std::vector<Reversal> reversals = find_reversals(history);
  if (reversals.size() < 2) return reversals;
  const auto [low, high] = std::minmax_element(history.begin(), history.end());
  const double width = (*high - *low) / classes;
  std::vector<Reversal> classed;
  for (std::size_t i = 0; i < reversals.size(); ++i) {
    const double position = (reversals[i].strain - *low) / width;
    const bool peak = reversals[i].strain > reversals[i > 0 ? i - 1 : 1].strain;
    const double bound = peak ? std::floor(position + 0.5) : std::ceil(position - 0.5);
    reversals[i].strain = *low + bound * width;
  }
  std::vector<double> rounded;
  for (const Reversal& r : reversals) rounded.push_back(r.strain);
  for (Reversal r : find_reversals(rounded)) classed.push_back({r.strain, reversals[r.sample].sample});
  return classed;
}

std::vector<double> paired_ranges(std::span<const Reversal> residue) {
  std::vector<double> rises, falls, ranges;
  for (std::size_t i = 1; i < residue.size(); ++i) {
    const double change = residue[i].strain - residue[i - 1].strain;
    (change > 0 ? rises : falls).push_back(std::fabs(change));
  }
  std::sort(rises.begin(), rises.end(), std::greater<>());
  std::sort(falls.begin(), falls.end(), std::greater<>());
  for (std::size_t i = 0; i < std::min(rises.size(), falls.size()); ++i)
    ranges.push_back(std::min(rises[i], falls[i]));
  return ranges;
}

}  // namespace dresslife::fatigue
