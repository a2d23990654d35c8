#include "fatigue/strain_life.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "pipeline/base/constants.h"

namespace dresslife::fatigue {
namespace {

constexpr double swt_walker_exponent = 0.5;  // makes s_max^(1-gamma) s_a^gamma equal to SWT's sqrt(s_max s_a)

double bounded(double reversals, double longest) {
  return reversals > longest ? infinity : std::max(reversals, fewest_reversals);
}

}  // namespace

PowerSum::PowerSum(double a, double p, double c, double q) : a_(a), p_(p), c_(c), q_(q) {
  assert(a > 0 && c > 0 && p < 0 && q < 0);
}

double PowerSum::operator()(double x) const { return a_ * std::pow(x, p_) + c_ * std::pow(x, q_); }

double PowerSum::slope(double x) const { return (a_ * p_ * std::pow(x, p_) + c_ * q_ * std::pow(x, q_)) / x; }

// In l = ln x the logarithm of the sum is convex (log-sum-exp) and falls. Where the larger term alone equals
// y the sum is at or above y, left of the root. From there Newton's steps approach the root without
// overshooting. The root is within ln(2)/min(-p, -q) of the start.
double PowerSum::inverse(double y) const {
  assert(y > 0);
  const double target = std::log(y), log_a = std::log(a_), log_c = std::log(c_);
  double l = std::max((target - log_a) / p_, (target - log_c) / q_);
  for (;;) {
    const double first = log_a + p_ * l, second = log_c + q_ * l;
    const double ratio = std::exp(-std::fabs(first - second));
    const double share = (first > second ? 1 : ratio) / (1 + ratio);  // of the first term in the sum
    const double excess = std::max(first, second) + std::log1p(ratio) - target;
    const double next = l - excess / (share * p_ + (1 - share) * q_);
    if (!(next > l)) break;
    l = next;
  }
  return std::exp(l);
}

StrainLife::StrainLife(const pipeline::Material& m, pipeline::MeanStress mean_stress, double endurance_strain,
                       double longest)
    : material_(m),
      mean_stress_(mean_stress),
      endurance_strain_(endurance_strain),
      longest_(longest),
      coffin_manson_(m.fatigue_strength / m.youngs_modulus, m.fatigue_strength_exponent, m.fatigue_ductility,
                     m.fatigue_ductility_exponent),
      swt_(m.fatigue_strength * m.fatigue_strength / m.youngs_modulus, 2 * m.fatigue_strength_exponent,
           m.fatigue_strength * m.fatigue_ductility, m.fatigue_strength_exponent + m.fatigue_ductility_exponent),
      walker_power_(-(1 - m.walker_exponent.value_or(swt_walker_exponent)) / m.fatigue_strength_exponent) {}

double StrainLife::reversals(const CycleLoad& load) const {
  if (load.strain_amplitude <= endurance_strain_ || load.strain_amplitude == 0) return infinity;
  switch (mean_stress_) {
    case pipeline::MeanStress::none:
      return bounded(coffin_manson_.inverse(load.strain_amplitude), longest_);
    case pipeline::MeanStress::swt: {
      const double parameter = load.stress_max * load.strain_amplitude;
      return parameter > 0 ? bounded(swt_.inverse(parameter), longest_) : infinity;
    }
    case pipeline::MeanStress::morrow: {
      if (load.stress_mean >= material_.fatigue_strength) return fewest_reversals;
      const MorrowScale scale = morrow_scale(load.stress_mean);
      return bounded(scale.life * coffin_manson_.inverse(load.strain_amplitude / scale.strain), longest_);
    }
    case pipeline::MeanStress::walker:
      if (load.stress_max <= 0) return infinity;
      return bounded(walker_stretch(load.stress_max, load.stress_mean) * coffin_manson_.inverse(load.strain_amplitude),
                     longest_);
  }
  throw std::logic_error("no such rule of mean stress");
}

double StrainLife::damage(const CycleLoad& load) const { return 2 / reversals(load); }

StrainLife::MorrowScale StrainLife::morrow_scale(double stress_mean) const {
  assert(stress_mean < material_.fatigue_strength);
  const double b = material_.fatigue_strength_exponent, c = material_.fatigue_ductility_exponent;
  const double log_u = std::log1p(-stress_mean / material_.fatigue_strength);
  return {std::exp(c / (c - b) * log_u), std::exp(log_u / (c - b))};
}

double StrainLife::walker_stretch(double stress_max, double stress_mean) const {
  assert(stress_max > 0);
  return std::pow((stress_max - stress_mean) / stress_max, walker_power_);
}

StrainLifeTable::StrainLifeTable(const std::vector<pipeline::StrainLifePoint>& points, double longest)
    : longest_(longest) {
  assert(points.size() >= 2);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double fall = std::log(points[i + 1].strain_amplitude / points[i].strain_amplitude);
    const double rise = std::log(points[i + 1].cycles / points[i].cycles);
    assert(fall < 0 && rise > 0);
    pieces_.push_back({std::log(points[i].strain_amplitude), std::log(points[i].cycles), rise / fall});
  }
}

double StrainLifeTable::cycles(double strain_amplitude) const {
  if (strain_amplitude <= 0) return infinity;
  const double log_strain = std::log(strain_amplitude);
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && log_strain < pieces_[i + 1].log_strain) ++i;
  const Piece& piece = pieces_[i];
  return bounded(2 * std::exp(piece.log_cycles + piece.slope * (log_strain - piece.log_strain)), longest_) / 2;
}

}  // namespace dresslife::fatigue
