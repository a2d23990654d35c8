#include "strain/sliding_layer.h"

#include <cmath>

namespace dresslife::strain {
namespace {

/// The helix at rest, and the numbers that its fibres have in common.
struct AtRest {
  double R, s, sigma, B, D, C4;

  /// Returns f0 at the angle b from the place where the bending at rest is largest.
  double bending(double cosine) const {
    const double X = B * cosine, y = s + R * X;
    return (R * sigma * sigma + y * X) / (R * R * sigma * sigma + y * y);
  }
};

/// Harmonics of G = at[0] + at[1] cos b + at[2] cos 2b + at[3] cos 3b, from its values at eight angles. The first harmonic also
/// contains the seventh, which is of the order of the sixth power of the first.
struct LengthAtRest {
  double at[4];

  LengthAtRest(const AtRest& rest, double height) {
    double value[5];
    for (int k = 0; k <= 4; ++k) value[k] = (k == 0 || k == 4 ? 1 : 2) / (1 + height * rest.bending(eighth(k)));
    for (int wave = 0; wave < 4; ++wave) {
      at[wave] = 0;
      for (int k = 0; k <= 4; ++k) at[wave] += (wave == 0 ? 0.125 : 0.25) * value[k] * eighth(wave * k);
    }
  }

 private:
  static double eighth(int turns) {  ///< cosine of eighths of a turn
    constexpr double root = 0.70710678118654752;
    constexpr double cosine[] = {1, root, 0, -root, -1, -root, 0, root};
    return cosine[turns % 8];
  }
};

SlidingFibre sliding_fibre(const AtRest& rest, double height) {
  const auto single = [](double x) { return static_cast<float>(x); };
  const auto [G0, G1, G2, G3] = LengthAtRest(rest, height).at;
  const double R = rest.R, D = rest.D, s = rest.s, B = rest.B;
  const double by_first = height / D, by_second = -0.5 * height * R / D, by_third = 0.25 * height * R * R / (D * D);
  SlidingFibre fibre;
  fibre.mean = single(height / R);
  fibre.mean_of_mean = single(G0);
  fibre.mean_of_first = single(0.5 * G1 * by_first);
  fibre.mean_of_second = single(0.5 * G2 * by_second);
  fibre.sine_of_sine = single((G0 - 0.5 * G2) * by_first);
  fibre.first_of_second = single(0.5 * G1 * by_second);
  fibre.cosine_of_cosine = single((G0 + 0.5 * G2) * by_first);
  fibre.cosine_of_mean = single(G1);
  fibre.second_of_second = single(G0 * by_second);
  fibre.sine2_of_sine = single(0.5 * (G1 - G3) * by_first);
  fibre.cosine2_of_cosine = single(0.5 * (G1 + G3) * by_first);
  fibre.second_of_third = single(0.5 * G1 * by_third / 0.75);  // the row already contains 3/4 C4
  fibre.cosine2_of_mean = single(G2);
  fibre.third0 = single(0.5 * G1 * by_third * rest.C4 * s * B * B * B);
  return fibre;
}

}  // namespace

SlidingLayer sliding_layer(const ComponentState<double>& parent, const Placement& first, double radial_share,
                           std::span<const double> heights) {
  assert(!is_thesis(first.kinematics) && first.radius > 0 && heights.size() <= most_sliding_fibres);
  const auto single = [](double x) { return static_cast<float>(x); };
  const double R = first.radius, s = parent.stretch.at[0], sigma = first.turn_rate + parent.twist.at[0];
  const double bend1 = parent.bend1.at[0], bend2 = parent.bend2.at[0], B = std::hypot(bend1, bend2);
  const double D = s * s + R * R * sigma * sigma, tau = R * R * sigma * sigma / D, k = R * R * B * B / D;
  const double C2 = 1 - 2 * tau, C4 = 2 * C2 * C2 - 1, C6 = 2 * C2 * C4 - C2, C8 = 2 * C2 * C6 - C4;
  const double E1 = (C2 + C4) / 2, E2 = (C4 + C6) / 2, E3 = (C6 + C8) / 2;
  const double E2_slope = -13 + tau * (56 - 48 * tau);  // of E2 = 1 - 13 tau + 28 tau^2 - 16 tau^3
  const double C6_slope = -18 + 96 * tau * (1 - tau);   // of C6 = 1 - 18 tau + 48 tau^2 - 32 tau^3
  const double second = 0.25 * tau * k * (1 + 3.0 / 16 * k * (4 - 5 * tau));
  SlidingLayer layer;
  layer.closed = k <= most_bend_squared;
  const double sine = B > 0 ? bend1 / B : 0, cosine = B > 0 ? -bend2 / B : 1;
  layer.turn_sine = single(sine);
  layer.turn_cosine = single(cosine);
  layer.stretch0 = single(s);
  layer.two_sigma0 = single(2 * sigma);
  layer.inverse_D0 = single(1 / D);
  layer.R2_over_D0 = single(R * R / D);
  layer.tau0 = single(tau);
  layer.second_scale = single(0.25 / (1 + second));
  layer.second0 = single(second / (1 + second));
  layer.second_slope = single(3.0 / 16 * (4 - 5 * tau));
  layer.E2_constant = single(E2 - E2_slope * tau);
  layer.E2_slope = single(E2_slope);
  layer.E3_mean = single(0.625 * E3);
  layer.E3_second = single(0.9375 * E3);
  layer.C6_constant = single(0.625 * (C6 - C6_slope * tau));
  layer.C6_slope = single(0.625 * C6_slope);
  layer.C8 = single(35.0 / 64 * C8);
  layer.mean0 = single(tau - 0.5 * k * (E1 + k * (0.75 * E2 + 0.625 * k * E3)));
  layer.first0 = single(s * B * (C2 + k * (0.75 * C4 + k * (0.625 * C6 + 35.0 / 64 * k * C8))));
  layer.second_wave0 = single(B * B * (E1 + k * (E2 + 0.9375 * k * E3)));
  layer.radial_share = single(radial_share);
  for (std::size_t f = 0; f < heights.size(); ++f) layer.fibres[f] = sliding_fibre({R, s, sigma, B, D, C4}, heights[f]);
  // theta - psi at wire 1
  const double sine1 = first.sine.at[0] * cosine - first.cosine.at[0] * sine;
  const double cosine1 = first.cosine.at[0] * cosine + first.sine.at[0] * sine;
  layer.sine1 = single(sine1);
  layer.cosine1 = single(cosine1);
  layer.sine2 = single(2 * sine1 * cosine1);
  layer.cosine2 = single(cosine1 * cosine1 - sine1 * sine1);
  return layer;
}

}  // namespace dresslife::strain
