// Nested helices: computes the state of a component on a helix from the state of its parent rod. W5 to W12 of strain/theory.md,
// which also has the measurements.
//
// A rod is a curve with a frame (d1, d2, d3 = tangent). Its parameter l is its own ideal length. `stretch`, the path length per
// l, is 1 for the undeformed dresspack. `bend1`, `bend2`, `twist` are the rotation rates of the frame about d1, d2, d3 [1/m].
// Each is a power series in l about the evaluated point.
//
// A component lies at radius R from its parent's axis, at the angle theta(l) from d1 toward d2. theta' = tan(alpha)/R, where the
// lay angle alpha is signed (left hand negative). With X = bend1 sin(theta) - bend2 cos(theta), sigma = theta' + twist and y =
// stretch + R X, the derivative of its path is
//     v = R sigma e_theta + y e_z,    V = |v| (W5)
// which has no radial part. So the component's frame (n = inward radial, b = t x n, t = v/V) is rotated from its parent's by
// theta about e_z and by the deformed lay angle a = atan(R sigma / y) about n. The component's state per its own ideal length, l
// / cos(alpha), is (W6)
//     stretch = cos(alpha) V
//     bend1   = cos(alpha) (a' - bend1 cos(theta) - bend2 sin(theta)),  a' = R (sigma' y - sigma y') / V^2
//     bend2   = cos(alpha) (R sigma^2 + y X) / V
//     twist   = cos(alpha) sigma stretch / V
// with the parent's state on the right. Axial strain is the stretch over that of the undeformed construction, minus one (W7).
// These equations are exact. The `thesis` kinematics is Backman's set (12) to (23), see W9 of strain/theory.md.
#pragma once

#include "pipeline/cable/series.h"
#include "pipeline/job/kinematics.h"

namespace dresslife::helices {

constexpr int highest_level = 6;  ///< of nesting; Series::capacity must be larger by at least two

/// State of a component at one point, see the file head. The `thesis` kinematics uses only the values (order 0): stretch is 1 +
/// strain, bend1 = kappa_bi and bend2 = kappa_no.
template <class T>
struct ComponentState {
  Series<T> stretch, bend1, bend2, twist;
};

/// State of a wire at one point: values without derivatives.
template <class T>
struct WireState {
  T stretch, bend1, bend2, twist;
  T inverse_stretch;  ///< factor for sliding; not in `thesis`
};

/// Position of a component in its parent, at one point along it.
struct Placement {
  pipeline::Kinematics kinematics = pipeline::Kinematics::exact;
  double radius = 0;            ///< R [m]
  double lay_tangent = 0;       ///< tan(alpha), negative = left hand
  double lay_cosine = 1;        ///< cos(alpha)
  double turn_rate = 0;         ///< theta' per ideal length of the parent [rad/m]; 0 on the axis
  Series<double> sine, cosine;  ///< of theta along the parent
};

/// Strain of a fibre on a wire's surface by the wire's bending: (axial + by_bend1 x change of bend1 + by_bend2 x change of bend2)
/// x scale.
struct FibreShape {
  double by_bend1 = 0, by_bend2 = 0, scale = 1;
};

inline namespace DRESSLIFE_MACHINE {

/// Returns a placement for the tangent and cosine of the signed lay angle. phase: theta at the point [rad]. order: of the
/// parent's state; 0 is enough for wires.
inline Placement make_placement(pipeline::Kinematics kinematics, double radius, double lay_tangent, double lay_cosine,
                                double phase, int order = Series<double>::capacity - 1) {
  assert(radius > 0 || lay_tangent == 0);
  Placement place;
  place.kinematics = kinematics;
  place.radius = radius;
  place.lay_tangent = lay_tangent;
  place.lay_cosine = lay_cosine;
  place.turn_rate = radius > 0 ? place.lay_tangent / radius : 0;
  const double sine = std::sin(phase), cosine = std::cos(phase);
  place.sine = sine_series(sine, cosine, place.turn_rate, order);
  place.cosine = sine_series(cosine, -sine, place.turn_rate, order);
  return place;
}

inline Placement make_placement(pipeline::Kinematics kinematics, double radius, double lay_angle, double phase) {
  return make_placement(kinematics, radius, std::tan(lay_angle), std::cos(lay_angle), phase);
}

/// Returns a rod in a uniform state, like the dresspack in one segment. curvature [1/m], twist [rad/m].
template <class T>
ComponentState<T> uniform_rod(const T& elongation, const T& curvature1, const T& curvature2, const T& twist,
                              int order) {
  return {constant_series(T(1.0 + elongation), order), constant_series(curvature1, order),
          constant_series(curvature2, order), constant_series(twist, order)};
}

/// Deformed lay angle (13) of the thesis.
template <class T>
struct ThesisAngle {
  T cosine_squared, cosine, sine_cosine;
};

template <class T>
ThesisAngle<T> thesis_angle(const ComponentState<T>& parent, const Placement& place) {
  const T tangent = (place.lay_tangent + place.radius * parent.twist.at[0]) / parent.stretch.at[0];
  const T cosine_squared = 1.0 / (1.0 + tangent * tangent);
  return {cosine_squared, square_root(cosine_squared), tangent * cosine_squared};
}

/// Returns the path length of a component per ideal length of its parent (exact: V of W5; thesis: 1 + its strain, W9).
template <class T>
T path_rate(const ComponentState<T>& parent, const Placement& place) {
  const double R = place.radius;
  const T X = parent.bend1.at[0] * place.sine.at[0] - parent.bend2.at[0] * place.cosine.at[0];
  if (is_thesis(place.kinematics)) {
    const ThesisAngle<T> a = thesis_angle(parent, place);
    return 1.0 + a.cosine_squared * (parent.stretch.at[0] - 1.0 + R * X) + R * a.sine_cosine * parent.twist.at[0];
  }
  const T sigma = place.turn_rate + parent.twist.at[0], y = parent.stretch.at[0] + R * X;
  return square_root(R * R * sigma * sigma + y * y);
}

/// Returns the mean of path_rate over all phases theta for one state of the parent (W10). With f(y) = sqrt(A + y^2), y = stretch
/// + R K sin and K^2 = bend1^2 + bend2^2, the mean is f + f2 R^2 K^2 / 4 + f4 R^4 K^4 / 64, where f2 and f4 are the second and
/// fourth derivative. The next term is below A (R K)^6 / 50: 2e-7 at R K = 0.2 and alpha = 25 deg.
template <class T>
T mean_path_rate(const ComponentState<T>& parent, const Placement& place) {
  const double R = place.radius;
  if (is_thesis(place.kinematics)) {
    const ThesisAngle<T> a = thesis_angle(parent, place);
    return 1.0 + a.cosine_squared * (parent.stretch.at[0] - 1.0) + R * a.sine_cosine * parent.twist.at[0];
  }
  const T sigma = place.turn_rate + parent.twist.at[0];
  const T y2 = parent.stretch.at[0] * parent.stretch.at[0], A = R * R * sigma * sigma;
  const T bend = R * R * (parent.bend1.at[0] * parent.bend1.at[0] + parent.bend2.at[0] * parent.bend2.at[0]);
  const T f = square_root(A + y2), inverse2 = 1.0 / (A + y2);
  const T second = 0.25 * A * bend * inverse2 * inverse2;  // f2 R^2 K^2 / 4, divided by f
  return f * (1.0 + second * (1.0 + (3.0 / 16.0) * bend * (4.0 * y2 - A) * inverse2 * inverse2));
}

template <class T>
ComponentState<T> thesis_child(const ComponentState<T>& parent, const Placement& place) {
  const ThesisAngle<T> a = thesis_angle(parent, place);
  const T X = parent.bend1.at[0] * place.sine.at[0] - parent.bend2.at[0] * place.cosine.at[0];
  const T Y = parent.bend1.at[0] * place.cosine.at[0] + parent.bend2.at[0] * place.sine.at[0];
  return {constant_series(path_rate(parent, place), 0), constant_series(T(a.cosine_squared * X), 0),
          constant_series(T(a.cosine * Y), 0), constant_series(T(a.sine_cosine * X), 0)};
}

/// Returns the values of a glued component (W6) without series. bend1 needs a parent of order one and is 0 for order zero. In
/// `thesis`, bend1 is minus kappa_no, about n, and bend2 is kappa_bi, about b: the order differs from ComponentState.
template <class T>
WireState<T> wire_state(const ComponentState<T>& parent, const Placement& place) {
  const double R = place.radius, c = place.lay_cosine;
  const double sine = place.sine.at[0], cosine = place.cosine.at[0];
  const T X = parent.bend1.at[0] * sine - parent.bend2.at[0] * cosine;
  const T radial = parent.bend1.at[0] * cosine + parent.bend2.at[0] * sine;
  if (is_thesis(place.kinematics)) {
    const ThesisAngle<T> a = thesis_angle(parent, place);
    return {path_rate(parent, place), -a.cosine * radial, a.cosine_squared * X, a.sine_cosine * X, 1.0 + 0.0 * X};
  }
  const T sigma = place.turn_rate + parent.twist.at[0], y = parent.stretch.at[0] + R * X;
  const T V = square_root(R * R * sigma * sigma + y * y), inverse = 1.0 / V, scale = c * inverse;
  WireState<T> wire{c * V, 0.0 * V, scale * (R * sigma * sigma + y * X), scale * sigma * parent.stretch.at[0],
                    (1 / c) * inverse};
  if (parent.stretch.order == 0) return wire;
  const T y_slope = parent.stretch.at[1] + R * (parent.bend1.at[1] * sine - parent.bend2.at[1] * cosine) +
                    R * place.turn_rate * radial;
  wire.bend1 = c * (R * (parent.twist.at[1] * y - sigma * y_slope) * inverse * inverse - radial);
  return wire;
}

/// Returns the state of a component glued to its parent (W6). Its order is one less than the parent's.
template <class T>
ComponentState<T> child(const ComponentState<T>& parent, const Placement& place) {
  if (is_thesis(place.kinematics)) return thesis_child(parent, place);
  if (parent.stretch.order == 1) {
    const WireState<T> values = wire_state(parent, place);
    return {constant_series(values.stretch, 0), constant_series(values.bend1, 0), constant_series(values.bend2, 0),
            constant_series(values.twist, 0)};
  }
  const double R = place.radius, c = place.lay_cosine;
  const Series<T> X = parent.bend1 * place.sine - parent.bend2 * place.cosine;
  const Series<T> radial = parent.bend1 * place.cosine + parent.bend2 * place.sine;
  const Series<T> y = parent.stretch + R * X, sigma = place.turn_rate + parent.twist;
  const Series<T> V2 = (R * R) * (sigma * sigma) + y * y;
  const Series<T> V = square_root(V2);
  const Series<T> angle_slope = (R * (slope(sigma) * y - sigma * slope(y))) / V2;
  ComponentState<T> rod;
  rod.stretch = stretched(c * V, c);
  rod.bend1 = stretched(c * (angle_slope - radial), c);
  rod.bend2 = stretched(c * ((R * (sigma * sigma) + y * X) / V), c);
  rod.twist = stretched(c * ((sigma * parent.stretch) / V), c);
  const int order = parent.stretch.order - 1;
  rod.stretch.order = rod.bend1.order = rod.bend2.order = rod.twist.order = order;
  return rod;
}

/// Returns a component that slides along its path until its axial strain is `strain` everywhere (W11). Curvature and torsion per
/// path length do not change, so the rotation rates per material length are proportional to the stretch. rest: the component in
/// the undeformed construction.
template <class T>
ComponentState<T> slid(const ComponentState<T>& glued, const T& strain, const ComponentState<double>& rest,
                       pipeline::Kinematics kinematics) {
  ComponentState<T> rod = glued;
  for (int k = 0; k <= glued.stretch.order; ++k) rod.stretch.at[k] = (1.0 + strain) * rest.stretch.at[k];
  if (is_thesis(kinematics)) return rod;
  if (glued.stretch.order == 0) {
    const T factor = rod.stretch.at[0] / glued.stretch.at[0];
    rod.bend1.at[0] *= factor;
    rod.bend2.at[0] *= factor;
    rod.twist.at[0] *= factor;
    return rod;
  }
  const Series<T> factor = rod.stretch / glued.stretch;
  rod.bend1 = glued.bend1 * factor;
  rod.bend2 = glued.bend2 * factor;
  rod.twist = glued.twist * factor;
  return rod;
}

/// Returns a component that slides like in slid(), but with an axial strain that changes along it because friction limits the
/// sliding (W17).
template <class T>
ComponentState<T> slid_unevenly(const ComponentState<T>& glued, const Series<T>& strain,
                                const ComponentState<double>& rest, pipeline::Kinematics kinematics) {
  ComponentState<T> rod = glued;
  rod.stretch = (1.0 + strain) * rest.stretch;
  if (is_thesis(kinematics)) return rod;
  const Series<T> factor = rod.stretch / glued.stretch;
  rod.bend1 = glued.bend1 * factor;
  rod.bend2 = glued.bend2 * factor;
  rod.twist = glued.twist * factor;
  return rod;
}

/// Returns the stretch at rest, which converts a wire's rates to path length; 1 in `thesis`.
inline double rest_length(pipeline::Kinematics kinematics, const WireState<double>& rest) {
  return is_thesis(kinematics) ? 1 : rest.stretch;
}

/// Returns the shape of the fibre at angle phi (from n toward b) on a wire of radius r. Per ideal length of the wire, the fibre's
/// length is stretch + r Y with Y = bend1 sin(phi) - bend2 cos(phi). With index 0 for the undeformed state and the axial strain e
/// = stretch / stretch0 - 1 of the wire, the strain of the fibre is
///     (stretch + r Y) / (stretch0 + r Y0) - 1 = (e + r (Y - Y0) / stretch0) / (1 + r Y0 / stretch0). (W12)
/// Precondition: r Y0 > -stretch0, so the wire is thinner than the radius of its bend at rest.
inline FibreShape fibre_shape(pipeline::Kinematics kinematics, const WireState<double>& rest, double r, double phi_sine,
                              double phi_cosine) {
  const double per_length = r / rest_length(kinematics, rest);
  FibreShape shape{per_length * phi_sine, -per_length * phi_cosine, 1};
  if (!is_thesis(kinematics)) shape.scale = 1 / (1 + shape.by_bend1 * rest.bend1 + shape.by_bend2 * rest.bend2);
  return shape;
}

/// Returns the strain of a fibre from the axial strain of its wire and the changes of the wire's bending.
template <class T>
T fibre_strain(const FibreShape& fibre, const T& axial, const T& bend1_change, const T& bend2_change) {
  return (axial + fibre.by_bend1 * bend1_change + fibre.by_bend2 * bend2_change) * fibre.scale;
}

}  // namespace DRESSLIFE_MACHINE
}  // namespace dresslife::helices
