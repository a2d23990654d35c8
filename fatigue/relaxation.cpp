#include "fatigue/relaxation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"

namespace dresslife::fatigue {
namespace {

constexpr double usual_rate = 0.085;     // Landgraf and Chernenkoff 1988, for steels
constexpr double most_repeats = 0x1p50;  // cycles with longer lives do no damage (strain_life.h)

// Gauss-Legendre quadrature with four nodes on [0, 1]: exact for polynomials up to the seventh degree. n^r on an octave
// is analytic within three half widths of its middle, so the relative error is about (3 + sqrt 8)^-8 = 7e-7.
constexpr std::size_t nodes = 4;
constexpr std::array<double, nodes> place{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                          0.93056815579702629};
constexpr std::array<double, nodes> weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                           0.17392742256872693};
using Values = std::array<double, nodes>;

/// Returns the value at x of the cubic through the values at the nodes.
double cubic_at(const Values& value, double x) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    double term = value[i];
    for (std::size_t j = 0; j < nodes; ++j)
      if (j != i) term *= (x - place[j]) / (place[i] - place[j]);
    sum += term;
  }
  return sum;
}

/// Returns the integral of this cubic from 0 to x.
double integral_to(const Values& value, double x) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) sum += weight[i] * cubic_at(value, x * place[i]);
  return x * sum;
}

/// Returns the x at which this integral reaches `target`. Precondition: target <= integral_to(value, 1).
double place_of(const Values& value, double target) {
  return pipeline::halved(0, 1, 50, [&](double end) { return integral_to(value, end) < target; }).middle();
}

Values damage_between(double begin, double width, double exponent, const DamageOfShares& damage) {
  Values share, of;
  for (std::size_t i = 0; i < nodes; ++i) share[i] = std::pow(begin + width * place[i], exponent);
  damage(share, of);
  return of;
}

}  // namespace

Relaxation::Relaxation(const pipeline::Material& material, const pipeline::Fatigue& settings) {
  if (!material.strain_life_table.empty() || !is_repeated(settings.counting)) return;
  switch (settings.mean_stress_relaxation) {
    case pipeline::MeanStressRelaxation::none:
      return;
    case pipeline::MeanStressRelaxation::complete:
      never_ = false, complete_ = true;
      return;
    case pipeline::MeanStressRelaxation::power_law:
      threshold_ = material.relaxation_threshold_strain.value_or(infinity);
      rate_ = material.relaxation_exponent.value_or(usual_rate);
      never_ = std::isinf(threshold_) || rate_ == 0;
      return;
  }
}

double Relaxation::exponent(double strain_amplitude) const {
  assert(!never_ && !complete_);
  return -rate_ * std::max(strain_amplitude / threshold_ - 1, 0.0);
}

// [1 + integral from 1 to L of n^r dn] / L
double mean_share(double repeats, double exponent) {
  assert(exponent <= 0);
  if (repeats <= 1 || exponent == 0) return 1;
  if (std::isinf(repeats)) return 0;
  const double log_repeats = std::log(repeats), power = 1 + exponent;
  const double rest = std::fabs(power * log_repeats) < 1e-8 ? log_repeats : std::expm1(power * log_repeats) / power;
  return (1 + rest) / repeats;
}

double relaxing_life(double exponent, const DamageOfShares& damage) {
  assert(exponent <= 0);
  std::array<double, 2> ends, share{1.0, 0.0};
  damage(share, ends);
  const auto [at_first, at_last] = ends;
  if (at_first >= 1) return 1 / at_first;
  if (exponent == 0 || at_first == at_last) return at_first > 0 ? 1 / at_first : infinity;
  // As long as the damage is below a millionth, the share has no visible influence on the sum.
  const double largest = std::max(at_first, at_last);
  double repeats = std::clamp(1e-6 / largest, 1.0, most_repeats);
  double sum = repeats > 1 ? 0.0 : at_first;
  if (repeats > 1) {
    std::array<double, 1> mean{mean_share(repeats, exponent)}, of;
    damage(mean, of);
    sum = repeats * of[0];
  }
  for (; repeats < most_repeats; repeats *= 2) {
    const Values rate = damage_between(repeats, repeats, exponent, damage);
    const double more = repeats * integral_to(rate, 1);
    if (sum + more >= 1) return repeats * (1 + place_of(rate, (1 - sum) / repeats));
    sum += more;
  }
  std::array<double, 1> left{std::pow(repeats, exponent)}, rate;
  damage(left, rate);
  return rate[0] * most_repeats > 1 - sum ? repeats + (1 - sum) / rate[0] : infinity;
}

}  // namespace dresslife::fatigue
