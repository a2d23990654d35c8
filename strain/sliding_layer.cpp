#include "strain/sliding_layer.h"

#include <cmath>

namespace dresslife::strain {
namespace {

/// The harmonics of g: g = at[0] + at[1] cos b + at[2] cos 2b + at[3] cos 3b. By sqrt(1 + 2 c x + x^2) = 1 +
/// c x + (1 - c^2) x^2/2 - c (1 - c^2) x^3/2 - (1 - c^2)(1 - 5 c^2) x^4/8 + .., x = sqrt(k) cos b, c^2 = 1 -
/// tau.
struct RestStretch {
  double at[4];

  RestStretch(double scale, double c, double tau, double k) {
    const double x = std::sqrt(k), third = -0.5 * c * tau, fourth = 0.125 * tau * (4 - 5 * tau);
    at[0] = scale * (1 + k * (0.25 * tau + k * 0.375 * fourth));
    at[1] = scale * x * (c + 0.75 * third * k);
    at[2] = scale * k * (0.25 * tau + 0.5 * fourth * k);
    at[3] = scale * 0.25 * third * k * x;
  }
};

}  // namespace

SlidingLayer sliding_layer(const Rod<double>& parent, const Placement& first) {
  assert(!is_thesis(first.kinematics) && first.radius > 0);
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
  const auto [g0, g1, g2, g3] = RestStretch(first.lay_cosine * std::sqrt(D), s / std::sqrt(D), tau, k).at;
  const double by_first = 1 / D, by_second = -0.5 * R / D, by_third = 0.25 * R * R / (D * D);
  layer.mean_of_mean = single(g0 / R);
  layer.mean_of_first = single(0.5 * g1 * by_first);
  layer.mean_of_second = single(0.5 * g2 * by_second);
  layer.sine_of_sine = single((g0 - 0.5 * g2) * by_first);
  layer.first_of_second = single(0.5 * g1 * by_second);
  layer.cosine_of_cosine = single((g0 + 0.5 * g2) * by_first);
  layer.cosine_of_mean = single(g1 / R);
  layer.second_of_second = single(g0 * by_second);
  layer.sine2_of_sine = single(0.5 * (g1 - g3) * by_first);
  layer.cosine2_of_cosine = single(0.5 * (g1 + g3) * by_first);
  layer.second_of_third = single(0.5 * g1 * by_third / 0.75);  // of 3/4 C4
  layer.cosine2_of_mean = single(g2 / R);
  layer.third0 = single(0.5 * g1 * by_third * C4 * s * B * B * B);
  // of theta - psi at wire 1
  const double sine1 = first.sine.at[0] * cosine - first.cosine.at[0] * sine;
  const double cosine1 = first.cosine.at[0] * cosine + first.sine.at[0] * sine;
  layer.sine1 = single(sine1);
  layer.cosine1 = single(cosine1);
  layer.sine2 = single(2 * sine1 * cosine1);
  layer.cosine2 = single(cosine1 * cosine1 - sine1 * sine1);
  return layer;
}

}  // namespace dresslife::strain
