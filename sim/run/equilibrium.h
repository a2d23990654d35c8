// Static equilibrium of the chain: the start of a simulation.
//
// The potential energy (stretch, bending, twist, gravity) is minimised by Newton's method with the exact
// tangent stiffness plus a multiple of the mass matrix, which is increased until the sum is positive definite and the energy
// decreases (Levenberg-Marquardt). Therefore the result is a stable equilibrium. (S11), (S12) in sim/rod/theory.md.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/world.h"
#include "sim/rod/rod.h"

namespace dresslife::sim {

// For one span, because several spans do not interact until they touch.

enum class EquilibriumStatus {
  converged,
  not_converged,  ///< residual above the tolerance after the allowed iterations
  too_short,      ///< the distance of the clamps is larger than the free length allows (longest_elongation)
};

struct Equilibrium {
  EquilibriumStatus status = EquilibriumStatus::not_converged;
  int iterations = 0;
  double residual = 0;      ///< largest unbalanced force or torque / segment length, over the largest link force
  int negative_pivots = 0;  ///< of the tangent stiffness at the result: 0 = stable
  RodState state;           ///< the equilibrium
};

struct EquilibriumSettings {
  int iterations = 2000;
  /// Limit of Equilibrium::residual. Rounding of EA g (g of 1e-16 m at EA 1e6 N) leaves 1e-10 N; 1e-8 N compared with
  /// forces of 1..100 N changes no plotted or counted result.
  double tolerance = 1e-8;
  /// Uses plain Newton, which follows a stable or unstable branch. Precondition: the start is near the branch.
  bool also_unstable = false;
};

/// Finds an equilibrium from both clamps. The start is a smooth curve of the right length with parallel-transported frames, with
/// the shortest uniform twist that fits the tool clamp's roll (|net twist| <= pi).
Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps, const EquilibriumSettings& settings = {});

/// Finds an equilibrium from a given state, for a clamp or load that has moved a little: stays on the same branch and keeps full
/// turns.
Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps, const RodState& start,
                             std::span<const Load> loads = {}, const EquilibriumSettings& settings = {});

/// A clamp as an installer mounts it: the rotation `roll` [rad] of the tool frame about its tangent, to be added to
/// clamps.tool, with which the equilibrium has no torsion; and this equilibrium.
struct TwistFreeClamp {
  double roll = 0;
  Equilibrium equilibrium;  ///< with the rotated frame in state.clamps.tool
};
TwistFreeClamp twist_free_roll(const Rod& rod, const ClampFrames& clamps, const EquilibriumSettings& settings = {});
/// The same from a near result, for example that under another gravity: stays on its branch.
TwistFreeClamp twist_free_roll(const Rod& rod, const ClampFrames& clamps, const TwistFreeClamp& near,
                               const EquilibriumSettings& settings = {});

/// Returns the stable shapes under gravity, each found from a start in which an installer may hold the hose: hanging, held up, or
/// to either side (mounting.h). twist_free: each shape has a roll, else the roll is 0. Shapes at a distance below half a diameter
/// are one.
std::vector<TwistFreeClamp> rest_shapes(const RodProperties& hose, const ClampFrames& clamps, bool twist_free,
                                        const EquilibriumSettings& settings = {});

/// Lets the chain come to rest in the world, among its obstacles, by time steps; velocities are set to 0 whenever
/// the kinetic energy decreases. Any number of spans; clamps and links do not move. `iterations` is the number of steps, fewer
/// than `steps` if hundreds of contacts make them slow; `residual` is the largest remaining speed [m/s]; infinite: the
/// simulation broke down.
Equilibrium settle(World& world, std::span<const Frame> links = {}, int steps = 20000, double speed = 1e-4);

}  // namespace dresslife::sim
