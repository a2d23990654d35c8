#include "strain/sliding_layer.h"

#include <cmath>
#include <random>

#include "pipeline/base/constants.h"
#include "strain/history.h"
#include "strain/nesting.h"
#include "tests/catch.h"
#include "tests/strain/all_kernels.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;

namespace {

constexpr std::size_t samples = 250, stride = 256;  // not a multiple of any register's lanes
constexpr int angles = 24;                          // harmonics above the twelfth are below any rounding

constexpr double single = 3e-6;    // five waves in single precision, of the largest strain
constexpr double left_out = 1e-6;  // of the largest strain: the terms that the series neglect (W27)
// A wire's bending is computed from its bending at rest: three roundings of its strain at rest.
constexpr double single_at_rest = 2e-7;

/// Returns five layers of wires with the same lay angle in the thesis' conductors.
Dresspack dresspack_of(double lay_angle_deg, double size, double rest_curvature) {
  Dresspack dresspack = thesis_dresspack();
  dresspack.rest_curvature = rest_curvature;
  for (Component& layer : dresspack.components[0].components[0].components) {
    layer.lay_angle = lay_angle_deg * degree;
    layer.helix_radius *= size;
    layer.radius *= size;
  }
  return dresspack;
}

/// Returns independent random states within these bounds.
DeformationHistory anything(double curvature, double twist, double elongation) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> any(-1, 1);
  DeformationHistory history(1, samples);
  for (std::size_t t = 0; t < samples; ++t)
    history.set(
        0, t,
        {curvature * any(generator), curvature * any(generator), twist * any(generator), elongation * any(generator)});
  return history;
}

struct Wires {
  BundleNesting nesting;
  std::vector<double> clamp_strain = std::vector<double>(stride, 1e-3);
  std::size_t layers;

  Wires(const Construction& construction, const std::vector<Slip>& slip) {
    constexpr double arc = 0.1;
    const auto plan = plan_slip(construction, slip, 2.0);
    const Bundle& bundle = construction.bundles()[12];
    nesting = nesting_to(construction, plan, bundle.part, arc, surface_fibres(1));
    for (NestingLevel& step : nesting.steps) step.slide.clamp_strain = clamp_strain.data();
    layers = bundle.wire_layers.size();
    for (const int layer : bundle.wire_layers) add_wire_layer(construction, plan, nesting, layer, bundle.part, arc);
    for (const int layer : bundle.wire_layers)
      for (int k = 0; k < angles; ++k)
        around.push_back(node_at(construction, plan, nesting, layer, 1, bundle.part, arc, 2 * pi * k / angles));
  }

  std::vector<float> waves(const Kernels& set, const DeformationHistory& history) const {
    std::vector<float> waves(layers * waves_per_layer * stride);
    set.layer_waves(pointers(nesting), history.columns(0), 0, samples, waves.data(), stride);
    return waves;
  }

  /// Returns the exact strains (layer, angle, sample) in double precision.
  std::vector<double> strains(const DeformationHistory& history) const {
    BundleNesting exact = nesting;
    exact.nodes = around;
    std::vector<double> strains(layers * angles * stride);
    kernels().node_strains(pointers(exact), history.columns(0), 0, samples, strains.data(), stride);
    return strains;
  }

 private:
  std::vector<WireNode> around;
};

/// Returns the largest difference of a layer's waves from the harmonics of its exact strains, divided by the allowed difference.
double worst_error(const Wires& wires, const std::vector<float>& waves, const std::vector<double>& strains) {
  double worst = 0;
  for (std::size_t layer = 0; layer < wires.layers; ++layer) {
    double largest = 0, difference = 0;
    for (std::size_t t = 0; t < samples; ++t) {
      double exact[waves_per_layer] = {};
      for (int k = 0; k < angles; ++k) {
        const double strain = strains[(layer * angles + k) * stride + t], angle = 2 * pi * k / angles;
        largest = std::max(largest, std::abs(strain));
        const double shape[] = {0.5, std::sin(angle), std::cos(angle), std::sin(2 * angle), std::cos(2 * angle)};
        for (int w = 0; w < waves_per_layer; ++w) exact[w] += 2.0 / angles * strain * shape[w];
      }
      double sum = 0;
      for (int w = 0; w < waves_per_layer; ++w)
        sum += std::abs(waves[(layer * waves_per_layer + w) * stride + t] - exact[w]);
      difference = std::max(difference, sum);
    }
    const WireNode& wire = wires.nesting.nodes[layer * waves_per_layer];
    const double at_rest = wire.wire_radius * std::abs(wire.rest.bend2);
    worst = std::max(worst, difference / ((single + left_out) * largest + single_at_rest * at_rest));
  }
  return worst;
}

}  // namespace

TEST_CASE("waves of sliding layers in closed form are the harmonics of their exact strains") {
  struct Most {
    double curvature, twist, elongation;
  };
  for (const double lay_angle : {5.0, 15.0, 25.0})
    for (const double size : {0.3, 1.0, 1.6})
      for (const double rest_curvature : {0.0, 2.0}) {
        const Construction construction(dresspack_of(lay_angle, size, rest_curvature), Kinematics::exact);
        const Wires wires(construction, {Slip::free});
        for (const SlidingLayer& layer : wires.nesting.sliding) CHECK(layer.closed);
        for (const Most most : {Most{1, 1, 1e-4}, {10, 10, 1e-3}, {15, 5, 1e-3}}) {
          const DeformationHistory history = anything(most.curvature, most.twist, most.elongation);
          const std::vector<double> strains = wires.strains(history);
          for (const Kernels* set : kernels_of_this_machine()) {
            const double error = worst_error(wires, wires.waves(*set, history), strains);
            CAPTURE(set->machine, lay_angle, size, rest_curvature, most.curvature, error);
            CHECK(error < 1);
          }
        }
      }
}

TEST_CASE("sliding layers beyond their closed forms have the waves of five nodes") {
  const auto agree = [](const Wires& wires, const DeformationHistory& history) {
    Wires by_nodes = wires;
    by_nodes.nesting.sliding.clear();
    return wires.waves(kernels(), history) == by_nodes.waves(kernels(), history);
  };
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  const Wires wires(construction, {Slip::free});
  CHECK_FALSE(agree(wires, anything(10, 10, 1e-3)));
  CHECK(agree(wires, anything(10, 60, 1e-3)));  // 6 % of the strain from twist
  CHECK(agree(wires, anything(1e4, 1, 1e-3)));  // a bend around 0.1 mm
  const Construction fat(dresspack_of(5, 12, 0), Kinematics::exact);
  CHECK(agree(Wires(fat, {Slip::free}), anything(10, 10, 1e-3)));  // already at rest
  // Glued wires, and fibres with the bending of the second axis, have no closed forms.
  CHECK(agree(Wires(construction, {Slip::stick}), anything(10, 10, 1e-3)));
}
