// Corkscrew: compression and twist wind a loose cable into a tight coil inside its hose.
//
// A cable of stiffnesses E I and G J under compression P and torque M = G J twist lies in a room of radius r. A helix of
// wave number q and a small radius a changes its energy per length by a^2/2 times
//     E I q^4 - M q^3 - P q^2 + k,     k = |P| kappa / r.
// k is the line load that holds the cable at the wall in a bend of the hose with curvature kappa. Both limits must be exceeded:
// 1. The coil begins. The straight cable is unstable if this is negative for a q of at least one turn in its length L,
//     M >= min over q >= 2 pi / L of  E I q + k / q^3 - P / q.                                               (F33)
//    k = 0, P = 0: 2 pi E I / L (Greenhill 1883). k = 0, M = 0: 4 pi^2 E I / L^2 (Euler, clamped ends). k = 0, a long
//    cable under tension T: 2 sqrt(E I T). M = 0: 2 sqrt(E I |P| kappa / r) (Dawson and Paslay 1984, with this line load).
// 2. The coil is tight. At the wall it has the q of least energy, 4 E I q^2 = 3 M q + 2 P, and the curvature r q^2 (M = 0:
//    Lubinski, Althouse and Logan 1962). It reaches kappa_c = r q_c^2 at
//     M = (4 E I q_c^2 - 2 P) / (3 q_c).                                                                     (F34)
//    A coil below kappa_c is the usual rest of a cable with slack in a hose. Its strain is in the lives of the wires (W32).
// kappa_c: 1 / 5 diameters, the tightest bend that a maker allows (bend_limit.h).
//
// If the robot's joints return after a repeat, except for whole turns, and the repeat leaves the dresspack twisted by D, each
// repeat adds G J D / L to M. The life is the number of repeats until both limits are exceeded.
// E I and G J are those of a cable with sliding parts, which is safe. Not contained: weight across the hose (which
// stabilises), friction at the wall, coils with steep turns (r q > 0.5), a lay that a twist opens inside a cable. The force
// of a cable is its largest one along the hose. A dresspack with rings or further clamps is evaluated with its whole length.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {

/// A cable in its room.
struct BoredCable {
  double bending = 0;   ///< E I [N m2]
  double torsion = 0;   ///< G J [N m2]
  double room = 0;      ///< r > 0 [m]
  double tightest = 0;  ///< kappa_c [1/m]
  double length = 0;    ///< L [m]

  /// Returns the torque at which the coil begins (F33) [N m]. compression [N], negative: tension; curvature: kappa of the hose
  /// [1/m].
  double torque_to_coil(double compression, double curvature) const;
  /// Returns the torque at which the coil is tight (F34) [N m]; negative if the compression alone suffices.
  double torque_to_tighten(double compression) const;
  /// Returns the larger of the two torques, from which on the cable is a corkscrew [N m].
  double critical_torque(double compression, double curvature) const;
  /// Returns the factor on compression and torque at which the cable is a corkscrew; at most largest_margin.
  double margin(double compression, double torque, double curvature) const;
  static constexpr double largest_margin = 1000;
};

/// The loose cable of a dresspack that is nearest to a corkscrew.
struct Corkscrew {
  std::size_t cable = 0;   ///< index in the strain file
  double margin = 0;       ///< factor on its forces and twist
  double repeats = 0;      ///< until the twist that each repeat leaves winds it, at least 1; infinite: none is left
  double turn_left = 0;    ///< D; 0 if below `least_turn_left`, or unknown [rad]
  bool knows_turn = true;  ///< false: twist is left, but the robot does not end in its first pose
  double position = 0;     ///< of the place from the base clamp [m]
  std::size_t sample = 0;
};

/// Smaller twists can come from rounding and from a motion that repeats only approximately [rad]. ESTIMATE.
constexpr double least_turn_left = 0.01;

/// Returns the cable with the smallest margin. tension: (cable, sample) of the strain file, largest along each cable by size [N].
/// std::nullopt: no cable of the dresspack lies loose in a room of known size, or the forces are unknown or not believable
/// (believable.h).
std::optional<Corkscrew> corkscrew(const pipeline::FileReader& strain, const pipeline::Job& job, std::size_t dresspack,
                                   const std::vector<std::vector<double>>& tension);

}  // namespace dresslife::fatigue
