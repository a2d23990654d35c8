#include "sim/rod/hysteresis.h"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>
#include <numbers>

namespace dresslife::sim {

PolymerLoss polymer_loss(double factor) {
  assert(factor >= 0 && factor <= most_loss_factor);
  if (factor == 0) return {};
  // [Hz]. Hoses on robots swing at 1 to 5 Hz, their third wave at 20 Hz. A lower limit would make the hose at rest softer
  // compared to 1 Hz; published cables are as stiff at rest as in their swings.
  constexpr double lowest = 0.8, highest = 30;
  constexpr int frequencies = 61, unknowns = BendMemory::relaxations + 1;
  using Vector = Eigen::Matrix<double, unknowns, 1>;
  Eigen::Matrix<double, unknowns, unknowns> normal = decltype(normal)::Zero();
  Vector right = Vector::Zero();
  for (int k = 0; k < frequencies; ++k) {
    const double frequency = lowest * std::pow(highest / lowest, k / (frequencies - 1.0));
    Vector row;  // of E'' - factor E' = 0; the elastic spring's term is on the right
    for (int i = 0; i < BendMemory::relaxations; ++i) {
      const double x = frequency / PolymerLoss::corner[i];  // omega tau_i
      row[i] = (x - factor * x * x) / (1 + x * x);
    }
    row[unknowns - 1] = 2 * std::numbers::pi * frequency;
    normal += row * row.transpose();
    right += factor * row;
  }
  const Vector found = normal.ldlt().solve(right);
  PolymerLoss loss;
  double storage = 1;  // at the reference frequency
  for (int i = 0; i < BendMemory::relaxations; ++i) {
    const double x = PolymerLoss::reference_frequency / PolymerLoss::corner[i];
    storage += found[i] * x * x / (1 + x * x);
  }
  loss.elastic = 1 / storage;
  for (int i = 0; i < BendMemory::relaxations; ++i) loss.stiffness[i] = found[i] / storage;
  loss.dashpot = found[unknowns - 1];
  return loss;
}

// keep_ and gain_ are a and b of (S22).
Hysteresis::Hysteresis(double bending_stiffness, const std::vector<FrictionElement>& friction, double loss_factor,
                       double step) {
  assert(friction.size() <= BendMemory::frictions);
  for (std::size_t i = 0; i < friction.size(); ++i) friction_[i] = friction[i].stiffness, yield_[i] = friction[i].yield;
  const PolymerLoss loss = polymer_loss(loss_factor);
  for (int i = 0; i < BendMemory::relaxations; ++i) {
    const double x = 2 * std::numbers::pi * PolymerLoss::corner[i] * step;  // h / tau_i
    polymer_[i] = bending_stiffness * loss.stiffness[i];
    keep_[i] = std::exp(-x), gain_[i] = -std::expm1(-x) / x;
  }
  tangent_ = friction_.sum() + (polymer_ * gain_).sum();
  dashpot_ = loss.dashpot;
}

}  // namespace dresslife::sim
