// Geometry of one elastic link: its two ends and its rotation vector. Shared by the step and the statics.
#pragma once

#include <algorithm>

#include "sim/rod/rod.h"

namespace dresslife::sim {

/// phi = log(R_a^T R_b) and the map G with dphi/dt = G^T (w_b - w_a), G = R_mid S,
/// S = s 1 + (1 - s) u u^T, s = (theta/2) / sin(theta/2), u = phi/theta. A moment m = K phi, conjugate to phi, is G m in the
/// world.
struct LinkTurn {
  Vector3 phi;         ///< [rad]
  Matrix3 map;         ///< G
  Vector3 axis;        ///< u sin(theta/2) in the world
  double stretch;      ///< s
  double axis_excess;  ///< (1 - s^2) / sin^2(theta/2): G G^T = s^2 1 + axis_excess axis axis^T
};

/// The rotation from a to b: u sin(theta/2), its square, the sign of the quaternion, cos(theta/2) >= 0 and s.
struct HalfTurn {
  Vector3 half;
  double squared, sign, cosine, stretch;
  Vector3 phi() const { return (2 * stretch) * half; }
};

inline HalfTurn half_turn(const Quaternion& a, const Quaternion& b) {
  const Quaternion relative = a.conjugate() * b;
  const double sign = relative.w() < 0 ? -1 : 1, cosine = sign * relative.w();
  const Vector3 half = sign * relative.vec();
  const double x = half.squaredNorm();
  // s = asin(y)/y with y^2 = x. Below 0.0225 (theta < 0.3) its series up to x^6 is exact to rounding.
  double s;
  if (x < 0.0225) {
    s = 1 +
        x * (1. / 6 + x * (3. / 40 + x * (15. / 336 + x * (105. / 3456 + x * (945. / 42240 + x * (10395. / 599040))))));
  } else {
    const double sine = std::sqrt(x);
    s = std::atan2(sine, cosine) / sine;
  }
  return {half, x, sign, cosine, s};
}

inline LinkTurn link_turn(const Quaternion& a, const Quaternion& b) {
  const HalfTurn half_way = half_turn(a, b);
  const Vector3& half = half_way.half;
  const double x = half_way.squared, sign = half_way.sign, cosine = half_way.cosine, s = half_way.stretch;
  // (1 - s)/x tends to -1/6 for small x.
  const double axial = x < 1e-10 ? -1. / 6 : (1 - s) / x;
  // The rotation half way is the sum of the two quaternions, of squared norm 2 (1 + cosine).
  const Eigen::Vector4d mid = a.coeffs() + sign * b.coeffs();
  const double scale = 1 / (1 + cosine), px = mid[0], py = mid[1], pz = mid[2], pw = mid[3];
  Matrix3 r;
  r << 1 - scale * (py * py + pz * pz), scale * (px * py - pw * pz), scale * (px * pz + pw * py),
      scale * (px * py + pw * pz), 1 - scale * (px * px + pz * pz), scale * (py * pz - pw * px),
      scale * (px * pz - pw * py), scale * (py * pz + pw * px), 1 - scale * (px * px + py * py);
  LinkTurn turn;
  turn.phi = half_way.phi();
  turn.axis = r * half;
  turn.map = s * r + (axial * turn.axis) * half.transpose();
  turn.stretch = s;
  turn.axis_excess = axial * (1 + s);
  return turn;
}

/// The arms from the centres of the segments before (a) and after (b) to the link between them. They grow with the link's bend
/// (S17): half a segment times 1 + (1 - t_a.t_b)/12. When the segments turn by w_a and w_b, the gap changes by
/// -w_a x a - w_b x b - lengthening (normal . (w_b - w_a)). At a clamp there is one arm, half a segment long.
struct LinkArms {
  Vector3 a = Vector3::Zero(), b = Vector3::Zero();  ///< world [m]; the ends are x_a + a and x_b - b
  Vector3 lengthening = Vector3::Zero();             ///< a/12 (t_a + t_b) [m]
  Vector3 normal = Vector3::Zero();                  ///< t_a x t_b
  double excess = 0;                                 ///< e.e - 2 |a x e|/|normal| with e = lengthening [m2]
};

/// half_a, half_b: half a segment along each tangent; zero at a clamp. half: its length [m].
inline LinkArms link_arms(const Vector3& half_a, const Vector3& half_b, double half) {
  const double half2 = half * half;
  if (half_a.isZero(0) || half_b.isZero(0)) return {half_a, half_b};
  const double cosine = half_a.dot(half_b) / half2, growth = 1 + (1 - cosine) / 12;
  return {growth * half_a, growth * half_b, (half_a + half_b) / 12, half_a.cross(half_b) / half2,
          half2 * ((1 + cosine) / 72 - growth / 6)};
}

/// Returns the change of the gap for small displacements x and rotations w of the two connected bodies.
inline Vector3 gap_change(const LinkArms& arms, const Vector3& x_a, const Vector3& w_a, const Vector3& x_b,
                          const Vector3& w_b) {
  return (x_b - w_b.cross(arms.b)) - (x_a + w_a.cross(arms.a)) - arms.normal.dot(w_b - w_a) * arms.lengthening;
}

/// The two bodies of a link: segment or clamp before (a) and after (b).
struct LinkEnds {
  const Vector3 *position_a, *position_b;
  const Quaternion *orientation_a, *orientation_b;
  Vector3 tangent_a, tangent_b;
  double half_a, half_b;  ///< half a segment on this side; 0 at a clamp [m]

  LinkArms arms() const { return link_arms(half_a * tangent_a, half_b * tangent_b, std::max(half_a, half_b)); }
  /// Returns the gap (S1) for these arms.
  Vector3 gap(const LinkArms& arms) const { return (*position_b - arms.b) - (*position_a + arms.a); }
};

inline LinkEnds link_ends(const Rod& rod, const RodState& state, int link) {
  const Span& span = rod.span_of_link(link);
  const int k = link - span.first_link, before = span.first_segment + k - 1;
  const bool has_a = k > 0, has_b = k < span.segments();
  const int first_end = 2 * static_cast<int>(&span - rod.spans().data());
  const Frame &base = state.clamps.end(first_end), &tool = state.clamps.end(first_end + 1);
  LinkEnds ends;
  ends.position_a = has_a ? &state.position[before] : &base.position;
  ends.orientation_a = has_a ? &state.orientation[before] : &base.orientation;
  ends.position_b = has_b ? &state.position[before + 1] : &tool.position;
  ends.orientation_b = has_b ? &state.orientation[before + 1] : &tool.orientation;
  const double a = span.segment_length / 2;
  ends.tangent_a = tangent(*ends.orientation_a), ends.tangent_b = tangent(*ends.orientation_b);
  ends.half_a = has_a ? a : 0, ends.half_b = has_b ? a : 0;
  return ends;
}

}  // namespace dresslife::sim
