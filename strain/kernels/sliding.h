// Waves of layers that slide over their pitch, without nodes (W27), for one instruction set. This file is a part of body.h, which
// declares the state of a part before it. Names as in sliding_layer.h.
#pragma once

#include "strain/sliding_layer.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

/// Numbers that all layers of a part have in common: its bending, turned, and products of it; the change of its squared
/// stretch.
struct alignas(64) BendShape {
  enum Row { sine, cosine, sine2, cosine2, sine3, cosine3, bend_squared, square_stretch, rows_in_all };
  float rows[rows_in_all][chunk];
  float most_bend_squared, most_square_stretch, most_twist;  ///< largest sizes over the samples

  /// of: any layer of the part with closed forms.
  void fill(const SlidingLayer& of, const PartState& part, std::size_t count) {
    FloatPack most_bend{}, most_square{}, most_twisted{};
    for (std::size_t t = 0; t < count; t += float_pack_size) {
      const FloatPack bend1 = part(part_bend1, t), bend2 = part(part_bend2, t);
      const FloatPack P = of.turn_cosine * bend1 + of.turn_sine * bend2;
      const FloatPack Q = of.turn_sine * bend1 - of.turn_cosine * bend2;
      const FloatPack P2 = P * P, Q2 = Q * Q, square = part(stretch_change, t) * (part(part_stretch, t) + of.stretch0);
      const FloatPack values[rows_in_all] = {
          P, Q, 2.0f * P * Q, Q2 - P2, P * (3.0f * Q2 - P2), Q * (Q2 - 3.0f * P2), P2 + Q2, square};
      for (int row = 0; row < rows_in_all; ++row) store(values[row], rows[row] + t);
      most_bend = larger(most_bend, values[bend_squared]);
      most_square = larger(most_square, larger(square, -square));
      most_twisted = larger(most_twisted, larger(part(twist_change, t), -part(twist_change, t)));
    }
    most_bend_squared = largest_lane(most_bend);
    most_square_stretch = largest_lane(most_square);
    most_twist = largest_lane(most_twisted);
  }

  inline FloatPack operator()(Row row, std::size_t t) const { return load<FloatPack>(rows[row] + t); }

  /// Returns whether the closed forms are accurate for a layer at all of these samples.
  bool suits(const SlidingLayer& layer) const {
    const float turning = most_twist * (most_twist + std::fabs(layer.two_sigma0)) * layer.R2_over_D0;
    const float square = most_square_stretch * layer.inverse_D0 + turning;
    return layer.closed && square < strain::most_square_stretch &&
           most_bend_squared * layer.R2_over_D0 < strain::most_bend_squared * (1 - square);
  }
};

/// Returns sqrt(1 + q) - 1. The relative error is below 7/128 q^4.
inline FloatPack root_less_one(const FloatPack& q) {
  return q * (0.5f + q * (-0.125f + q * (0.0625f - 0.0390625f * q)));
}

/// The part of a layer's strain that does not depend on the angle: the mean strain over the pitch, and the factors of
/// the harmonics of f (1 + strain), that of the mean less its value at rest. This loop is separate: within the loop that uses
/// the factors, the numbers of a sample would wait too long for each other.
struct alignas(64) SlidingState {
  enum Row { axial, mean, first, second, third, rows_in_all };
  float rows[rows_in_all][chunk];

  inline FloatPack operator()(Row row, std::size_t t) const { return load<FloatPack>(rows[row] + t); }

  void fill(const SlidingLayer& of, const PartState& part, const BendShape& shape, std::size_t count) {
    for (std::size_t t = 0; t < count; t += float_pack_size) {
      const FloatPack twist_by = part(twist_change, t);
      const FloatPack turning = of.R2_over_D0 * (twist_by * (twist_by + of.two_sigma0));
      const FloatPack q = shape(BendShape::square_stretch, t) * of.inverse_D0 + turning;  // D / D0 - 1
      // D0 / D by division: the strain at rest is subtracted from its products, and the error of inverse() would use the whole
      // error budget. This error is two roundings on processors with a reciprocal of 12 bits.
      const FloatPack over_D = 1.0f / (1.0f + q);
      const FloatPack tau = (of.tau0 + turning) * over_D;
      const FloatPack k = shape(BendShape::bend_squared, t) * of.R2_over_D0 * over_D;
      // (W10) of a helix in a straight part, and the contribution of bending, as in mean_over_pitch()
      const FloatPack straight = root_less_one(q);
      const FloatPack bent = k * tau * (1.0f + of.second_slope * k) * of.second_scale - of.second0;
      const FloatPack strain = of.radial_share * (straight + bent + bent * straight);

      const FloatPack E1 = 1.0f + tau * (4.0f * tau - 5.0f), E2 = of.E2_constant + of.E2_slope * tau;
      const FloatPack C4 = 0.75f + tau * (6.0f * tau - 6.0f);   // times 3/4
      const FloatPack C6 = of.C6_constant + of.C6_slope * tau;  // times 5/8
      const FloatPack f0 = tau - 0.5f * k * (E1 + k * (0.75f * E2 + of.E3_mean * k));
      const FloatPack f1 = 1.0f - 2.0f * tau + k * (C4 + k * (C6 + of.C8 * k));
      const FloatPack f2 = E1 + k * (E2 + of.E3_second * k);
      const FloatPack by = over_D + strain * over_D, by_s = part(part_stretch, t) * by;
      store(strain, rows[axial] + t);
      store(FloatPack(f0 + strain * f0 - of.mean0), rows[mean] + t);
      store(FloatPack(f1 * by_s), rows[first] + t);
      store(FloatPack(f2 * by), rows[second] + t);
      store(FloatPack(by_s * over_D * C4), rows[third] + t);
    }
  }
};

/// Waves of the strain of one of the layer's fibres.
void closed_strains_of_fibre(const SlidingLayer& layer, const SlidingFibre& fibre, const SlidingState& state,
                             const BendShape& shape, std::size_t count, float* out, std::size_t stride) {
  const SlidingLayer of = layer;  // copies, so that the compiler knows that `out` does not alias them
  const SlidingFibre by = fibre;
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    // harmonics of strain + rho (f (1 + strain) - f0), in the order of the rows, then the harmonics of their product with G
    const FloatPack mean = state(SlidingState::axial, t) + by.mean * state(SlidingState::mean, t);
    const FloatPack first = state(SlidingState::first, t), second = state(SlidingState::second, t);
    const FloatPack third = by.second_of_third * state(SlidingState::third, t);
    const FloatPack sine = first * shape(BendShape::sine, t);
    const FloatPack cosine = first * shape(BendShape::cosine, t) - of.first0;
    const FloatPack sine2 = second * shape(BendShape::sine2, t);
    const FloatPack cosine2 = second * shape(BendShape::cosine2, t) - of.second_wave0;
    const FloatPack sine3 = third * shape(BendShape::sine3, t);
    const FloatPack cosine3 = third * shape(BendShape::cosine3, t) - by.third0;
    const FloatPack felt_mean = by.mean_of_mean * mean + by.mean_of_first * cosine + by.mean_of_second * cosine2;
    const FloatPack felt_sine = by.sine_of_sine * sine + by.first_of_second * sine2;
    const FloatPack felt_cosine =
        by.cosine_of_cosine * cosine + by.first_of_second * cosine2 + by.cosine_of_mean * mean;
    const FloatPack felt_sine2 = by.second_of_second * sine2 + (by.sine2_of_sine * sine + sine3);
    const FloatPack felt_cosine2 =
        by.second_of_second * cosine2 + by.cosine2_of_cosine * cosine + (by.cosine2_of_mean * mean + cosine3);
    store(felt_mean, out + t);
    store(FloatPack(of.cosine1 * felt_sine - of.sine1 * felt_cosine), out + stride + t);
    store(FloatPack(of.sine1 * felt_sine + of.cosine1 * felt_cosine), out + 2 * stride + t);
    store(FloatPack(of.cosine2 * felt_sine2 - of.sine2 * felt_cosine2), out + 3 * stride + t);
    store(FloatPack(of.sine2 * felt_sine2 + of.cosine2 * felt_cosine2), out + 4 * stride + t);
  }
}

/// Waves of the strain of the layer's fibres, like strains_of_layer().
void closed_strains_of_layer(const SlidingLayer& layer, int fibre_count, const PartState& part, const BendShape& shape,
                             std::size_t count, float* out, std::size_t stride) {
  SlidingState state;
  state.fill(layer, part, shape, count);
  for (int f = 0; f < fibre_count; ++f)
    closed_strains_of_fibre(layer, layer.fibres[f], state, shape, count, out + f * waves_per_layer * stride, stride);
}

}  // namespace
}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
