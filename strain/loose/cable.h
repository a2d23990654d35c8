// A cable that lies loose in its hose: what it is, and its state at one sample.
//
// It runs along the hose at a0(s) + b(s), s the arc of the hose's axis: a0 is the place that the dresspack
// gives it, on a helix where it is laid (back-twisted: it does not turn about itself), b the offset to where
// it rests now. Both are in the hose's frame (d1, d2), so that the path of a cable that keeps its place
// follows the hose's twist. Per length of the axis the path gains (README W32)
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
  double lay_rate = 0;            ///< by which its place turns about the hose's axis along it [rad/m]
  double radius = 0;              ///< [m]
  double axial_stiffness = 0;     ///< E A, of its wires [N]
  double bending_stiffness = 0;   ///< E I, as its wires slide [N m2]
  double mass_per_length = 0;     ///< [kg/m]
  double slack = 0;               ///< length beyond its path at installation, over it
  double wall_stiffness = 1e7;    ///< k_w, of what it lies against, force per length and depth [N/m2]
  double grip = without_limit;    ///< force at which a clamp lets it slip [N]
  /// Force per length and sideways speed that holds it [N s/m2] (README W36): at 50 mm/s friction of 0.3
  /// under 0.2 kg/m.
  double drag = 12;
  static constexpr double friction_of_drag = 0.3;  ///< coefficient of that drag: another one has its share

  // How far it can go; fit_in_hose() finds all but the first.
  double play = without_limit;      ///< c: from its place, whatever else stops it [m]
  double farthest = without_limit;  ///< from the hose's axis: the wall, or what lies in between [m]
  double nearest = 0;               ///< to the hose's axis: what lies there [m]
  int ring = no_ring;               ///< of cables around the hose's axis, which turn as one
  double gap = without_limit;       ///< along its ring either way, by what its neighbours leave [m]

  bool operator==(const LooseCable&) const = default;
};

/// One cable at one sample. Nodes are evenly spaced from the base clamp (0) to the tool clamp (last);
/// element i lies between nodes i and i + 1.
struct CableState {
  double strain = 0;              ///< of its free length, clamp to clamp: mean over it
  std::vector<double> gain;       ///< of the path over its length in the straight hose (element)
  std::vector<double> tension;    ///< T [N] (element); above 0: pulled
  std::vector<double> press;      ///< on what it lies against [N/m] (node); empty: not needed
  std::vector<double> offset;     ///< b [m] (node, 2)
  std::vector<double> curvature;  ///< of its own path about the hose's d1 and d2 [1/m] (node, 2)
  /// The same at the base and the tool clamp (clamp, 2), with what the distance of nodes leaves out there, see bend_at_clamp().
  /// Means over several nodes are those of `curvature`.
  std::array<double, 4> clamped{};
};

}  // namespace dresslife::strain
