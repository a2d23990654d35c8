// Corkscrew: a loose cable that compression and twist wind into a tight coil inside its hose.
//
// A cable of stiffnesses E I and G J under compression P and torque M = G J twist lies in a room of radius r. A helix of
// wave number q and a small radius a changes its energy per length by a^2/2 times
//     E I q^4 - M q^3 - P q^2 + k,     k = |P| kappa / r.
// k is the line load that holds the cable at the wall where the hose is bent by kappa. Both limits must be passed:
// 1. The coil begins. The straight cable is unstable if this is negative for a q of at least one turn in its length L,
//     M >= min over q >= 2 pi / L of  E I q + k / q^3 - P / q.                                               (F33)
//    k = 0, P = 0: 2 pi E I / L (Greenhill 1883). k = 0, M = 0: 4 pi^2 E I / L^2 (Euler, clamped ends). k = 0, a long
//    cable under tension T: 2 sqrt(E I T). M = 0: 2 sqrt(E I |P| kappa / r) (Dawson and Paslay 1984, with this line load).
// 2. The coil is tight. At the wall its q has the least energy, 4 E I q^2 = 3 M q + 2 P, and its curvature is r q^2 (M = 0:
//    Lubinski, Althouse and Logan 1962). It reaches kappa_c = r q_c^2 at
//     M = (4 E I q_c^2 - 2 P) / (3 q_c).                                                                     (F34)
//    A coil below kappa_c is the cable's usual rest in a hose with slack. Its strain is in the lives of the wires (W32).
// kappa_c: 1 / 5 diameters, the tightest bend that a maker allows (bend_limit.h).
//
// A repeat after which the robot's joints have returned, but for whole turns, and that leaves the dresspack twisted by D adds
// G J D / L to M. The repeats until both limits are passed are the life.
// E I and G J are those of a cable whose parts slide, which is safe. Not contained: weight across the hose (which
// stabilises), friction at the wall, coils with steep turns (r q > 0.5), a lay that a twist opens inside a cable. The force
// of a cable is its largest one along the hose. A dresspack with rings or further clamps counts with its whole length.
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

  /// Torque at which the coil begins (F33). compression [N], negative: tension; curvature: kappa of the hose [1/m]. [N m]
  double torque_to_coil(double compression, double curvature) const;
  /// Torque at which the coil is tight (F34), negative where the compression alone suffices [N m].
  double torque_to_tighten(double compression) const;
  /// The larger of both: from there on it is a corkscrew [N m].
  double critical_torque(double compression, double curvature) const;
  /// Factor on compression and torque at which it is one; at most largest_margin.
  double margin(double compression, double torque, double curvature) const;
  static constexpr double largest_margin = 1000;
};

/// The loose cable of a dresspack that is nearest to a corkscrew.
struct Corkscrew {
  std::size_t cable = 0;  ///< of the strain file
  double margin = 0;      ///< on its forces and twist
  double repeats =
      0;  ///< until it is one; infinite: no repeat leaves a twist, or it is far; 1: in every repeat
  double turn_left = 0;  ///< D, 0 below `least_turn_left` [rad]
  double position = 0;   ///< of the place from the base clamp [m]
  std::size_t sample = 0;
};

/// Less is left by the digits of a twist and by a motion that repeats only nearly [rad]. ESTIMATE.
constexpr double least_turn_left = 0.01;

/// tension: (cable, sample) of the strain file, largest along each cable by size [N]. Nothing: no cable of the dresspack lies
/// loose in a room of known size, or the forces are not known or not believable (believable.h).
std::optional<Corkscrew> corkscrew(const pipeline::FileReader& strain, const pipeline::Job& job,
                                   std::size_t dresspack, const std::vector<std::vector<double>>& tension);

}  // namespace dresslife::fatigue
