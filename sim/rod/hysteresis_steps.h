// A step of hysteretic bending and its energy, (S19) to (S21) of sim/rod/hysteresis.h: for the loop over all links.
#pragma once

#include "sim/rod/hysteresis.h"

namespace dresslife::sim {

inline Eigen::Vector2d Hysteresis::advance(BendMemory& memory, const Eigen::Vector2d& bend) const {
  const Eigen::Vector2d change = bend - memory.bend;
  memory.bend = bend;
  memory.held.rowwise() += change.transpose().array();
  const Eigen::Array<double, BendMemory::frictions, 1> cut =
      yield_ / memory.held.square().rowwise().sum().max(yield_.square()).sqrt();
  memory.held.colwise() *= cut;
  memory.relaxing = memory.relaxing.colwise() * keep_ + (gain_.matrix() * change.transpose()).array();
  return (memory.held.matrix().transpose() * friction_.matrix()) +
         memory.relaxing.matrix().transpose() * polymer_.matrix();
}

inline double Hysteresis::energy(const BendMemory& memory) const {
  return 0.5 * ((memory.held.square().rowwise().sum() * friction_).sum() +
                (memory.relaxing.square().rowwise().sum() * polymer_).sum());
}

}  // namespace dresslife::sim
