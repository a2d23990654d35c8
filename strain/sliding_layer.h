// Waves of the strain of a layer of wires that slides over its pitch, in closed form without nodes ((W27) in
// strain/theory.md). Each wire has fibres at the height rho outward of its axis.
//
// Only bending depends on the angle theta. By W6, W11 and W12 the strain of the fibre is
//     G (strain + rho (f (1 + strain) - f0)),   G = 1 / (1 + rho f0),
//     f = (R sigma^2 + y X) / (R^2 sigma^2 + y^2) = (1 - s Re 1/(z + R X)) / R,   z = s + i R sigma,
// s is the parent's stretch, sigma the layer's turning rate; index 0: the parent at rest. X is a first harmonic of amplitude B.
// With b = theta - psi, psi the angle at which X0 is largest,
//     X = P sin b + Q cos b,   D = |z|^2 = s^2 + R^2 sigma^2,   tau = R^2 sigma^2 / D,   k = R^2 B^2 / D,
// the harmonics of 1/(z + R X) are series in k, truncated where the next term is small, with Chebyshev's C2 = 1 - 2
// tau, C(n+2) = 2 C2 Cn - C(n-2), E1 = (C2 + C4)/2, E2 = (C4 + C6)/2, E3 = (C6 + C8)/2:
//     mean    f_0 = (tau - k/2 (E1 + 3/4 k E2 + 5/8 k^2 E3)) / R
//     first   f_1 = s/D (C2 + 3/4 k C4 + 5/8 k^2 C6 + 35/64 k^3 C8)          times P sin b + Q cos b
//     second  f_2 = -R/(2 D) (E1 + k E2 + 15/16 k^2 E3)          times 2 P Q sin 2b + (Q^2 - P^2) cos 2b
//     third   f_3 = s R^2/(4 D^2) C4            times (3 Q^2 P - P^3) sin 3b + (Q^3 - 3 Q P^2) cos 3b
// G has its own harmonics, with X0 = B0 cos b. Products of harmonics are harmonics. E2 and C6 are linearised in tau, E3 and C8
// are constants at rest, because all of them are multiplied by powers of k.
#pragma once

#include <array>
#include <span>

#include "pipeline/cable/helix.h"

namespace dresslife::strain {

using namespace helices;

/// Within these limits the closed forms differ from the exact harmonics by less than 1e-6 of the layer's largest strain. Beyond
/// them five nodes are evaluated (W13).
constexpr float most_bend_squared = 0.01F;     ///< of k
constexpr float most_square_stretch = 0.065F;  ///< of the change of D over its value at rest

/// Numbers that depend on a fibre's height.
struct SlidingFibre {
  float mean;  ///< factor of f's mean in the mean of the strain
  // Products with the harmonics of G. a_of_b: factor of harmonic b of f in harmonic a of the strain.
  float mean_of_mean, mean_of_first, mean_of_second;
  float sine_of_sine, first_of_second, cosine_of_cosine, cosine_of_mean;
  float second_of_second, sine2_of_sine, cosine2_of_cosine, second_of_third, cosine2_of_mean, third0;
};

/// Fibres that depend on bend2 only: outward, inward, or the axis.
constexpr std::size_t most_sliding_fibres = 2;

struct SlidingLayer {
  bool closed = false;  ///< whether the numbers below hold
  // The parent's frame is turned so that the bending at rest is largest at angle 0.
  float turn_sine, turn_cosine;
  float stretch0;
  // Helix at rest
  float two_sigma0, inverse_D0, R2_over_D0, tau0;
  float second_scale, second0, second_slope;  ///< terms of the mean over the pitch
  // Coefficients in tau and k
  float E2_constant, E2_slope, E3_mean, E3_second, C6_constant, C6_slope, C8;
  // Values at rest
  float mean0, first0, second_wave0;
  float radial_share;  ///< of the mean over the pitch (W31)
  std::array<SlidingFibre, most_sliding_fibres> fibres;
  // For the return to angles from wire 1: sine and cosine of the turn and of twice the turn.
  float sine1, cosine1, sine2, cosine2;
};

/// parent: at rest; first: place of wire 1; heights: of the fibres [m]. Precondition: exact kinematics, a helix (radius > 0),
/// at most most_sliding_fibres.
SlidingLayer sliding_layer(const ComponentState<double>& parent, const Placement& first, double radial_share,
                           std::span<const double> heights);

}  // namespace dresslife::strain
