#include "fatigue/stress_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pipeline/base/warning_words.h"

namespace dresslife::fatigue {
namespace {

constexpr double agreement =
    0.1;  // relative, of K' and n' with (F5): fits of one test series scatter by several percent

double compatible_exponent(const pipeline::Material& m) {
  return m.fatigue_strength_exponent / m.fatigue_ductility_exponent;
}

double compatible_strength(const pipeline::Material& m, double exponent) {
  return m.fatigue_strength / std::pow(m.fatigue_ductility, exponent);
}

}  // namespace

CyclicCurve::CyclicCurve(double youngs_modulus, double strength, double hardening_exponent)
    : modulus_(youngs_modulus), strength_(strength), hardening_exponent_(hardening_exponent) {
  assert(modulus_ > 0 && strength_ > 0 && hardening_exponent_ > 0 && hardening_exponent_ <= 1);
}

CyclicCurve::CyclicCurve(const pipeline::Material& m)
    : CyclicCurve(m.youngs_modulus,
                  m.cyclic_strength.value_or(
                      compatible_strength(m, m.cyclic_hardening_exponent.value_or(compatible_exponent(m)))),
                  m.cyclic_hardening_exponent.value_or(compatible_exponent(m))) {}

double CyclicCurve::strain(double stress) const {
  const double size = std::fabs(stress);
  return std::copysign(size / modulus_ + std::pow(size / strength_, 1 / hardening_exponent_), stress);
}

// strain(s) rises and is convex, since 1/n' >= 1. At s = min(E eps, K' eps^n') one of its two terms alone
// equals eps, so this s is at or above the root. From there Newton's steps approach the root without
// overshooting.
double CyclicCurve::stress(double strain) const {
  const double target = std::fabs(strain);
  if (target == 0) return 0;
  double s = std::min(modulus_ * target, strength_ * std::pow(target, hardening_exponent_));
  for (;;) {
    const double plastic = std::pow(s / strength_, 1 / hardening_exponent_);
    const double next = s - (s / modulus_ + plastic - target) / (1 / modulus_ + plastic / (s * hardening_exponent_));
    if (!(next < s)) break;
    s = next;
  }
  return std::copysign(s, strain);
}

std::optional<pipeline::Warning> compatibility_warning(const pipeline::Material& m) {
  if (!m.cyclic_strength && !m.cyclic_hardening_exponent) return {};
  const CyclicCurve curve(m);
  const double exponent = compatible_exponent(m), strength = compatible_strength(m, exponent);
  const auto differs = [](double a, double b) { return std::fabs(a - b) > agreement * b; };
  if (!differs(curve.hardening_exponent(), exponent) && !differs(curve.strength(), strength)) return {};
  return pipeline::warning_of(
      pipeline::WarningKind::material, "",
      fmt::format(
          "material {}: K' {:.4g} MPa and n' {:.3g} disagree with its strain-life curve, which gives {:.4g} MPa and "
          "{:.3g} (limit {:.0f} %)",
          m.name, curve.strength() / 1e6, curve.hardening_exponent(), strength / 1e6, exponent, 100 * agreement),
      "the six constants come from different test series",
      fmt::format("cyclic_strength_MPa: {:.4g} and cyclic_hardening_exponent: {:.3g}, or leave both out",
                  strength / 1e6, exponent));
}

double MemoryPath::on_curve(double input) const { return std::copysign(curve_(std::fabs(input)), input); }

double MemoryPath::go_to(double input) {
  if (input == open_.back().input) return open_.back().response;
  if (std::fabs(input) >= largest_) {  // beyond all loops: the curve itself
    largest_ = std::fabs(input);
    open_.assign(1, {input, on_curve(input)});
    return open_.back().response;
  }
  // The last point was not a reversal: the path continues in its direction.
  if (open_.size() > 1 && (input > open_.back().input) == (open_.back().input > open_[open_.size() - 2].input)) {
    open_.pop_back();
  }
  while (open_.size() > 2) {
    const double below = open_[open_.size() - 2].input, top = open_.back().input;
    if (input > top ? input < below : input > below) break;
    open_.resize(open_.size() - 2);
  }
  const Point from = open_.back();
  const double branch = 2 * curve_(std::fabs(input - from.input) / 2);
  open_.push_back({input, from.response + std::copysign(branch, input - from.input)});
  return open_.back().response;
}

}  // namespace dresslife::fatigue
