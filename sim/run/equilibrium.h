// Static equilibrium of the chain: where a simulation starts.
//
// The potential energy (stretch, bending, twist, gravity) is minimised by Newton's method with the exact
// tangent stiffness, shifted by a multiple of the mass matrix until it is positive definite and the energy
// falls (Levenberg-Marquardt). The result is therefore a stable equilibrium. (S11), (S12) in sim/rod/theory.md.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/world.h"
#include "sim/rod/rod.h"

namespace dresslife::sim {

// Of one span: several do not feel each other until they touch.

enum class EquilibriumStatus {
  converged,
  not_converged,  ///< residual above the tolerance after the allowed iterations
  too_short,      ///< the clamps are further apart than the free length allows (longest_elongation)
};

struct Equilibrium {
  EquilibriumStatus status = EquilibriumStatus::not_converged;
  int iterations = 0;
  double residual = 0;  ///< largest unbalanced force or torque / segment length, over the largest link force
  int negative_pivots = 0;  ///< of the tangent stiffness at the end: 0 = stable
  RodState state;           ///< at rest
};

struct EquilibriumSettings {
  int iterations = 2000;
  /// On Equilibrium::residual. Rounding of EA g (g of 1e-16 m at EA 1e6 N) leaves 1e-10 N; 1e-8 N against
  /// forces of 1..100 N moves nothing that is plotted or counted.
  double tolerance = 1e-8;
  /// Plain Newton instead, which follows a branch whether it is stable or not; the start must be near.
  bool also_unstable = false;
};

/// From both clamps alone: starts from a smooth curve of the right length with parallel-transported frames,
/// so that the tool clamp's roll is met by the shortest uniform twist (|net twist| <= pi).
Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps,
                             const EquilibriumSettings& settings = {});

/// From a given state, for a clamp or load that has moved a little: stays on the same branch and keeps whole
/// turns.
Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps, const RodState& start,
                             std::span<const Load> loads = {}, const EquilibriumSettings& settings = {});

/// As an installer clamps it: the roll [rad] of the tool frame about its own tangent, to be added to that of
/// clamps.tool, with which the equilibrium carries no torsion; and that equilibrium.
struct TwistFreeClamp {
  double roll = 0;
  Equilibrium equilibrium;  ///< its state.clamps.tool is the rolled frame
};
TwistFreeClamp twist_free_roll(const Rod& rod, const ClampFrames& clamps,
                               const EquilibriumSettings& settings = {});

/// Stable shapes under gravity, each reached from where an installer may hold the hose: hanging, held up, or to either side
/// (mounting.h). twist_free: each has a roll of its own, else 0. Shapes nearer than half a diameter are one.
std::vector<TwistFreeClamp> rest_shapes(const RodProperties& hose, const ClampFrames& clamps, bool twist_free,
                                        const EquilibriumSettings& settings = {});

/// Lets the chain come to rest in the world, among its obstacles, by steps whose velocities are taken away as
/// soon as the kinetic energy falls. Any number of spans; clamps and links stay. iterations counts steps, fewer
/// than `steps` where hundreds of contacts make them slow; residual is the largest speed left [m/s].
Equilibrium settle(World& world, std::span<const Frame> links = {}, int steps = 20000, double speed = 1e-4);

}  // namespace dresslife::sim
