// Functions shared by the tests of the chain: clamp frames in a plane, fast statics, bisection, orders of convergence.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/base/constants.h"
#include "sim/rod/rod.h"
#include "sim/run/equilibrium.h"
#include "tests/catch.h"
#include "tests/sim/rod/smooth.h"

namespace dresslife::sim::test {

using dresslife::pi;

/// Returns a frame in the x-z plane with its tangent `angle` above the x axis: body z turned about y by 90 deg - angle.
inline Frame planar_frame(double x, double z, double angle) {
  return {{x, 0, z}, Quaternion(Eigen::AngleAxisd(pi / 2 - angle, Vector3::UnitY()))};
}

/// One step without ODE: solve(), v += dv, x += h v, finish(). For closed forms and relaxation. Returns false if solve() does.
inline bool advance_rod(const Rod& rod, RodSolver& solver, RodState& state, const ClampFrames& end, double h,
                        std::span<const Load> loads = {}) {
  if (!solver.solve(state, end, h, loads)) return false;
  const std::span<const Twist6> change = solver.velocity_change();
  for (int i = 0; i < rod.segments(); ++i) {
    state.velocity[i] += change[i].linear();
    state.angular_velocity[i] += change[i].angular();
    state.position[i] += h * state.velocity[i];
    state.orientation[i] = (rotation(h * state.angular_velocity[i]) * state.orientation[i]).normalized();
  }
  solver.finish(state);
  return true;
}

/// Returns a thin, nearly inextensible rod of unit stiffness and unit length without gravity.
inline RodProperties unit_rod(int segments) {
  RodProperties p;
  p.segments = segments;
  p.length = 1;
  p.mass_per_length = 1;
  p.diameter = 0.01;
  p.bending_stiffness = 1;
  p.torsional_stiffness = 0.8;
  p.axial_stiffness = 1e7;  // stretch of 1e-6 at forces of 10: below every tolerance here
  p.gravity.setZero();
  return p;
}

/// Returns a soft hose of the kind that robots carry: 2.5 kg/m, 60 mm thick.
inline RodProperties hose(int segments, double length = 2) {
  RodProperties p;
  p.segments = segments;
  p.length = length;
  p.mass_per_length = 2.5;
  p.diameter = 0.06;
  p.bending_stiffness = 5;
  p.torsional_stiffness = 4;
  p.axial_stiffness = 1e5;
  p.damping_time = 0.01;
  return p;
}

/// Returns the loads of a force at the tip of a free end, moved to the last segment's centre.
inline std::vector<Load> tip_force(const Rod& rod, const RodState& state, const Vector3& force) {
  std::vector<Load> loads(rod.segments());
  const Vector3 arm = rod.tip(state) - state.position.back();
  loads.back() = {force, arm.cross(force)};
  return loads;
}

/// Returns the equilibrium of a cantilever under a dead force at its tip, applied in ten parts. The force's torque about the
/// segment's centre depends on the segment's orientation, so the solution is repeated until the tip moves less than 1e-12 m.
inline RodState tip_loaded(const Rod& rod, const Frame& base, const Vector3& force) {
  RodState state = rod.straight(base);
  EquilibriumSettings newton;
  newton.also_unstable = true;
  for (int part = 1; part <= 10; ++part)
    for (int repeat = 0; repeat < 100; ++repeat) {
      const Vector3 tip = rod.tip(state);
      state = find_equilibrium(rod, state.clamps, state, tip_force(rod, state, force * part / 10.0), newton).state;
      if ((rod.tip(state) - tip).norm() < 1e-12) break;
    }
  return state;
}

/// Returns the point of the hose's axis at a link. In a bend the chain's joints lie outside by kappa l^2/12 (S17). Planar bends.
inline Vector3 on_axis(const Rod& rod, const RodState& state, int link) {
  const Vector3 before = tangent(state.orientation[link - 1]), after = tangent(state.orientation[link]);
  return state.position[link - 1] + rod.segment_length() * (before / 2 + (after - before) / 12);
}

/// Returns the largest difference of the segments of `a`, from `first` on, to those of `b`: positions [m], quaternions,
/// velocities [m/s].
inline double furthest(const RodState& a, int first, const RodState& b) {
  double most = 0;
  for (size_t i = 0; i < b.position.size(); ++i) {
    most = std::max(most, (a.position[first + i] - b.position[i]).norm());
    most = std::max(most, (a.orientation[first + i].coeffs() - b.orientation[i].coeffs()).norm());
    most = std::max(most, (a.velocity[first + i] - b.velocity[i]).norm());
  }
  return most;
}

/// Returns the bending curvature of a link [1/m].
inline double curvature(const Rod& rod, const RodState& state, int link) {
  return rod.link_state(state, link).turn.head<2>().norm() / rod.bending_length(link);
}

/// Returns the value between low and high at which `unstable` changes from false to true.
inline double bisect(double low, double high, int halvings, const std::function<bool(double)>& unstable) {
  for (int k = 0; k < halvings; ++k) {
    const double middle = (low + high) / 2;
    (unstable(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

/// Returns the observed order of convergence from the errors at a resolution and at twice this resolution.
inline double observed_order(double coarse, double fine) { return std::log2(coarse / fine); }

/// Lower bound of an observed order: second order minus the effect of higher terms.
inline constexpr double least_order = 1.9;

}  // namespace dresslife::sim::test
