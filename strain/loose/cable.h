// A cable that lies loose in its hose: its properties, and its state at one sample.
//
// It runs along the hose at a0(s) + b(s); s is the arc of the hose's axis. a0 is the place in the dresspack, on a helix if the
// cable has a lay (back-twisted: it does not turn about itself). b is the offset to the place where it rests. Both are in the
// hose's frame (d1, d2), so the path of a held cable follows the hose's twist. Per length of the axis the path gains (W32)
//     g = e + k1 a2 - k2 a1 + |a' + tau J a|^2 / 2,    J a = (-a2, a1),
// with the hose's elongation e, curvatures k1, k2 and twist tau.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace dresslife::strain {

constexpr int no_ring = -1;
constexpr double without_limit = std::numeric_limits<double>::infinity();

struct LooseCable {
  std::array<double, 2> place{};  ///< a0, from the hose's axis toward d1 and d2 at the base clamp [m]
  double lay_rate = 0;            ///< rotation of its place about the hose's axis per length of the axis [rad/m]
  double radius = 0;              ///< of the cable [m]
  double axial_stiffness = 0;     ///< E A, from its wires [N]
  double bending_stiffness = 0;   ///< E I with sliding wires [N m2]
  double mass_per_length = 0;     ///< [kg/m]
  double slack = 0;               ///< length beyond its path at installation, over this path
  double wall_stiffness = 1e7;    ///< k_w of its contacts, force per length and depth [N/m2]
  double grip = without_limit;    ///< force at which a clamp lets the cable slip [N]
  double friction = 0;            ///< coefficient of dry friction across the hose (W42); 0: only the drag
  double line_load = 0;           ///< force per length that presses it on wall or core besides its contacts [N/m]
  /// Drag force per length and sideways speed [N s/m2] (W36): at 50 mm/s equal to the friction of 0.2 kg/m with the coefficient
  /// 0.3.
  double drag = 12;
  static constexpr double friction_of_drag = 0.3;  ///< of this drag, which is proportional to it
  /// Share of the drag that remains beside dry friction: at 50 mm/s 2 % of the friction of its weight.
  static constexpr double drag_beside_friction = 0.02;
  /// Sideways force per length and displacement of a cable that dry friction holds [N/m2]. The cable rolls on its contact and
  /// twists: G J q^2/r^2 with G J = 0.02 N m2, r = 5 mm is 2e3 to 1e5 for waves 2 pi/q of 4 to 0.5 m. The contact of the jacket
  /// itself (10 MPa) is 100 times as stiff.
  static constexpr double stick_stiffness = 1e4;

  // Limits of its movement; fit_in_hose() computes all except the first.
  double play = without_limit;      ///< c: greatest distance from its place, independent of other limits [m]
  double farthest = without_limit;  ///< greatest distance from the hose's axis: the wall, or parts between [m]
  double nearest = 0;               ///< least distance from the hose's axis: the core [m]
  int ring = no_ring;               ///< number of its ring: cables around the hose's axis that turn together
  double gap = without_limit;       ///< along its ring in both directions, up to its neighbours [m]

  bool operator==(const LooseCable&) const = default;
};

/// One cable at one sample. Nodes are evenly spaced from the base clamp (0) to the tool clamp (last);
/// element i lies between nodes i and i + 1.
struct CableState {
  double strain = 0;              ///< of its free length from clamp to clamp: the mean
  std::vector<double> gain;       ///< growth of the path over its length in the straight hose (element)
  std::vector<double> tension;    ///< T [N] (element); positive: pulled
  std::vector<double> press;      ///< force on its contacts [N/m] (node); empty: not needed
  std::vector<double> offset;     ///< b [m] (node, 2)
  std::vector<double> curvature;  ///< of its path about the hose's d1 and d2 [1/m] (node, 2)
  /// Curvature at the base and the tool clamp (clamp, 2) [1/m], with the part that the distance of nodes misses there, see
  /// bend_at_clamp(). Means over several nodes use `curvature`.
  std::array<double, 4> clamped{};
};

}  // namespace dresslife::strain
