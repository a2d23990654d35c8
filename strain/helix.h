// Nested helices: from the state of a parent rod to the state of a component that lies in it on a helix
// (README W5-W12).
//
// A rod is a curve with a frame (d1, d2, d3 = tangent), described per ideal length l of its own: path length
// per l
// (`stretch`, 1 = undeformed for the dresspack) and the rotation rate of the frame per l (`bend1`, `bend2`,
// `twist` about d1, d2, d3 [1/m]), each as a power series in l about the place of interest. A component at
// radius R from the parent's axis and angle theta(l) from d1 toward d2, theta' = tan(alpha)/R with the lay
// angle alpha signed (left hand negative), has the path derivative, with X = bend1 sin(theta) - bend2
// cos(theta),
//     v = R (theta' + twist) e_theta + (stretch + R X) e_z (W5)
// which has no radial part. Hence the child's frame n = inward radial, b = t x n, t = v/|v| turns against the
// parent's by theta about e_z and by the deformed lay angle a = atan(R sigma / y) about n, and its state per
// ideal length of its own, l_child = l / cos(alpha), is with sigma = theta' + twist, y = stretch + R X, V =
// sqrt(R^2 sigma^2 + y^2)          (W6)
//     stretch = cos(alpha) V
//     bend1   = cos(alpha) (a' - (bend1 cos(theta) + bend2 sin(theta)))        a' = R (sigma' y - sigma y') /
//     V^2 bend2   = cos(alpha) (R sigma^2 + y X) / V twist   = cos(alpha) sigma stretch_parent / V
// The axial strain of a component is its stretch over that in the undeformed construction, minus one (W7).
// This is the geometry without approximation. `thesis` is Backman's set (12)-(23), see README W9.
#pragma once

#include "pipeline/job.h"
#include "strain/series.h"

namespace dresslife::strain {

/// State of a component at one place: see above. In `thesis` kinematics only the values (order 0) are used,
/// stretch is 1 + strain, bend1 = kappa_bi and bend2 = kappa_no.
template <class T>
struct Rod {
  Series<T> stretch, bend1, bend2, twist;

  /// A rod in a uniform state, as the dresspack is within a segment. curvature [1/m], rate [rad/m].
  static Rod uniform(const T& elongation, const T& curvature1, const T& curvature2, const T& rate,
                     int order) {
    return {Series<T>::constant(1.0 + elongation, order), Series<T>::constant(curvature1, order),
            Series<T>::constant(curvature2, order), Series<T>::constant(rate, order)};
  }
  int order() const { return stretch.order; }
};

/// Where a component lies in its parent, at one place along it.
struct Placement {
  pipeline::Kinematics kinematics = pipeline::Kinematics::exact;
  double radius = 0;            ///< R [m]
  double lay_tangent = 0;       ///< tan(alpha), negative = left hand
  double lay_cosine = 1;        ///< cos(alpha)
  double turn_rate = 0;         ///< theta' per ideal length of the parent [rad/m]; 0 on the axis
  Series<double> sine, cosine;  ///< of theta along the parent

  /// lay_angle signed [rad]; phase = theta here [rad].
  Placement(pipeline::Kinematics model, double helix_radius, double lay_angle, double phase)
      : kinematics(model),
        radius(helix_radius),
        lay_tangent(std::tan(lay_angle)),
        lay_cosine(std::cos(lay_angle)) {
    assert(radius > 0 || lay_angle == 0);
    turn_rate = radius > 0 ? lay_tangent / radius : 0;
    constexpr int highest = Series<double>::capacity - 1;
    sine = sine_series(phase, turn_rate, highest);
    cosine = cosine_series(phase, turn_rate, highest);
  }
};

/// cos^2 and sin cos of the deformed lay angle (13), with which the thesis' equations are written.
template <class T>
struct ThesisAngle {
  T cosine_squared, cosine, sine_cosine;

  ThesisAngle(const Rod<T>& parent, const Placement& place) {
    const T tangent = (place.lay_tangent + place.radius * parent.twist.at[0]) / parent.stretch.at[0];
    cosine_squared = 1.0 / (1.0 + tangent * tangent);
    cosine = square_root(cosine_squared);
    sine_cosine = tangent * cosine_squared;
  }
};

/// Path length of the component per ideal length of its parent (exact: V of W6; thesis: 1 + its strain, W9).
template <class T>
T path_rate(const Rod<T>& parent, const Placement& place) {
  const double R = place.radius;
  const T X = parent.bend1.at[0] * place.sine.at[0] - parent.bend2.at[0] * place.cosine.at[0];
  if (place.kinematics == pipeline::Kinematics::thesis) {
    const ThesisAngle<T> a(parent, place);
    return 1.0 + a.cosine_squared * (parent.stretch.at[0] - 1.0 + R * X) +
           R * a.sine_cosine * parent.twist.at[0];
  }
  const T sigma = place.turn_rate + parent.twist.at[0], y = parent.stretch.at[0] + R * X;
  return square_root(R * R * sigma * sigma + y * y);
}

/// The mean of path_rate over all phases theta at this state of the parent. With f(y) = sqrt(A + y^2), y =
/// stretch + R K sin, K^2 = bend1^2 + bend2^2, the mean is f + f'' R^2K^2/4 + f'''' R^4K^4/64; the next term
/// is below A (RK)^6/50, 2e-6 at RK = 0.2 and alpha = 25 deg. (W10)
template <class T>
T mean_path_rate(const Rod<T>& parent, const Placement& place) {
  const double R = place.radius;
  if (place.kinematics == pipeline::Kinematics::thesis) {
    const ThesisAngle<T> a(parent, place);
    return 1.0 + a.cosine_squared * (parent.stretch.at[0] - 1.0) + R * a.sine_cosine * parent.twist.at[0];
  }
  const T sigma = place.turn_rate + parent.twist.at[0];
  const T y2 = parent.stretch.at[0] * parent.stretch.at[0], A = R * R * sigma * sigma;
  const T bend2 = R * R * (parent.bend1.at[0] * parent.bend1.at[0] + parent.bend2.at[0] * parent.bend2.at[0]);
  const T f = square_root(A + y2), inverse2 = 1.0 / (A + y2);
  const T second = 0.25 * A * bend2 * inverse2 * inverse2;  // f'' R^2 K^2 / 4, over f
  return f * (1.0 + second * (1.0 + (3.0 / 16.0) * bend2 * (4.0 * y2 - A) * inverse2 * inverse2));
}

template <class T>
Rod<T> thesis_child(const Rod<T>& parent, const Placement& place) {
  const ThesisAngle<T> a(parent, place);
  const T X = parent.bend1.at[0] * place.sine.at[0] - parent.bend2.at[0] * place.cosine.at[0];
  const T Y = parent.bend1.at[0] * place.cosine.at[0] + parent.bend2.at[0] * place.sine.at[0];
  return {Series<T>::constant(path_rate(parent, place), 0), Series<T>::constant(a.cosine_squared * X, 0),
          Series<T>::constant(a.cosine * Y, 0), Series<T>::constant(a.sine_cosine * X, 0)};
}

/// The component glued to its parent, one order less than the parent (W6).
template <class T>
Rod<T> child(const Rod<T>& parent, const Placement& place) {
  if (place.kinematics == pipeline::Kinematics::thesis) return thesis_child(parent, place);
  const double R = place.radius;
  const Series<T> X = parent.bend1 * place.sine - parent.bend2 * place.cosine;
  const Series<T> radial = parent.bend1 * place.cosine + parent.bend2 * place.sine;
  const Series<T> y = parent.stretch + R * X, sigma = place.turn_rate + parent.twist;
  const Series<T> V2 = (R * R) * (sigma * sigma) + y * y;
  const Series<T> V = square_root(V2);
  const Series<T> angle_slope = (R * (slope(sigma) * y - sigma * slope(y))) / V2;
  const double c = place.lay_cosine;
  Rod<T> rod{stretched(c * V, c), stretched(c * (angle_slope - radial), c),
             stretched(c * ((R * (sigma * sigma) + y * X) / V), c),
             stretched(c * ((sigma * parent.stretch) / V), c)};
  const int order = parent.order() - 1;
  rod.stretch.order = rod.bend1.order = rod.bend2.order = rod.twist.order = order;
  return rod;
}

/// The component when it slides along its path until its axial strain is `strain` everywhere: curvature and
/// torsion per path length stay, so its rotation rates per material length scale with the stretch. rest = the
/// component in the undeformed construction. (W11)
template <class T>
Rod<T> slid(const Rod<T>& glued, const T& strain, const Rod<double>& rest, pipeline::Kinematics kinematics) {
  Rod<T> rod = glued;
  for (int k = 0; k <= glued.order(); ++k) rod.stretch.at[k] = (1.0 + strain) * rest.stretch.at[k];
  if (kinematics == pipeline::Kinematics::thesis) return rod;
  const Series<T> factor = rod.stretch / glued.stretch;
  rod.bend1 = glued.bend1 * factor;
  rod.bend2 = glued.bend2 * factor;
  rod.twist = glued.twist * factor;
  return rod;
}

/// What the fibre at angle phi (from n toward b) on a wire of radius r adds to the axial strain:
/// r (d bend1 sin(phi) - d bend2 cos(phi)), with bend1 about n and bend2 about b. (W12)
template <class T>
T fibre_strain(const Rod<T>& wire, const Rod<double>& rest, pipeline::Kinematics kinematics, double r,
               double phi_sine, double phi_cosine) {
  if (kinematics == pipeline::Kinematics::thesis)  // kappa_no counts against n, kappa_bi along b
    return r * (-1.0 * wire.bend2.at[0] * phi_sine - wire.bend1.at[0] * phi_cosine);
  return r * ((wire.bend1.at[0] - rest.bend1.at[0]) * phi_sine -
              (wire.bend2.at[0] - rest.bend2.at[0]) * phi_cosine);
}

}  // namespace dresslife::strain
