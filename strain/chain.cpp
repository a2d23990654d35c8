#include "strain/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dresslife::strain {
namespace {

constexpr double pi = std::numbers::pi;

// (W25) In the delivered shape.
Rod<double> dresspack_at_rest(const Construction& construction) {
  return uniform_rod<double>(0, 0, construction.rest_curvature(), 0, Series<double>::capacity - 1);
}

/// The undeformed parent at the end of a chain; turn < 0: as it is, else with the helical ancestor moved on.
const Rod<double>& rest_at_end(const BundleChain& chain, const Rod<double>& dresspack, int turn = -1) {
  if (chain.steps.empty()) return dresspack;
  return turn < 0 ? chain.steps.back().rest : chain.steps.back().turned_rest[turn];
}

SlidingNumbers sliding_numbers(const LayerSlip& slip, const BundleChain& chain, const Rod<double>& dresspack,
                               const Placement& place) {
  SlidingNumbers slide;
  slide.sliding = slip.sliding;
  slide.helical_level = slip.helical_level;
  slide.cap = slip.cap;
  if (slip.sliding == Sliding::over_pitch)
    slide.mean_rest_rate = mean_path_rate(rest_at_end(chain, dresspack), place);
  if (slip.sliding == Sliding::along_ancestor) {
    double sum = 0;
    for (int turn = 0; turn < phases_per_pitch; ++turn)
      sum += path_rate(rest_at_end(chain, dresspack, turn), place);
    slide.mean_rest_rate = sum / phases_per_pitch;
  }
  return slide;
}

bool helical(const Layer& layer) { return layer.helix_radius > 0 && layer.lay_angle != 0; }

}  // namespace

BundleChain chain_to(const Construction& construction, const std::vector<LayerSlip>& plan, int part,
                     double arc, const std::vector<Fibre>& fibres) {
  BundleChain chain;
  chain.fibres = fibres;
  chain.rest_curvature = construction.rest_curvature();
  for (const Fibre& fibre : fibres)
    if (!fibre.on_axis && std::abs(fibre.phi_sine) > 1e-12) chain.order = 1;
  const Rod<double> dresspack = dresspack_at_rest(construction);
  const bool any_turned = std::any_of(plan.begin(), plan.end(), [](const LayerSlip& slip) {
    return slip.sliding == Sliding::along_ancestor;
  });
  for (const int level_part : construction.ancestry(part)) {
    const Part& of = construction.parts()[level_part];
    ChainStep step;
    step.place = construction.placement(of.layer, of.number, of.parent, arc);
    step.rest = child(rest_at_end(chain, dresspack), step.place);
    step.slide = sliding_numbers(plan[of.layer], chain, dresspack, step.place);
    const bool turns = helical(construction.layers()[of.layer]);
    for (int turn = 0; any_turned && turn < phases_per_pitch; ++turn) {
      const double angle = turns ? 2 * pi * turn / phases_per_pitch : 0;
      step.turned[turn] = construction.placement(of.layer, of.number, of.parent, arc, angle);
      step.turned_rest[turn] = child(rest_at_end(chain, dresspack, turns ? -1 : turn), step.turned[turn]);
    }
    chain.steps.push_back(step);
  }
  return chain;
}

WireNode node_at(const Construction& construction, const std::vector<LayerSlip>& plan,
                 const BundleChain& chain, int layer, int number, int part, double arc, double turn) {
  const Rod<double> dresspack = dresspack_at_rest(construction);
  const Rod<double>& rest = rest_at_end(chain, dresspack);
  WireNode node;
  node.place = construction.placement(layer, number, part, arc, turn);
  node.rest_rate = path_rate(rest, node.place);
  node.rest = wire_state(rest, node.place);
  node.inverse_rest_stretch = 1 / node.rest.stretch;
  node.slide = sliding_numbers(plan[layer], chain, dresspack, node.place);
  const Layer& of = construction.layers()[layer];
  node.shear_radius =
      of.part_radius * of.shear_factor / of.strain_factor;  // the kernels multiply by the latter
  node.wire_radius = of.is_hose ? 0 : of.part_radius;
  node.strain_factor = of.strain_factor;
  return node;
}

void add_wire_layer(const Construction& construction, const std::vector<LayerSlip>& plan, BundleChain& chain,
                    int layer, int part, double arc) {
  for (int node = 0; node < waves_per_layer; ++node)
    chain.nodes.push_back(
        node_at(construction, plan, chain, layer, 1, part, arc, 2 * pi * node / waves_per_layer));
  const WireNode& first = chain.nodes[chain.nodes.size() - waves_per_layer];
  const bool by_bend2_alone = chain.order == 0 && first.place.kinematics == pipeline::Kinematics::exact;
  chain.sliding.push_back(
      by_bend2_alone && first.slide.sliding == Sliding::over_pitch
          ? sliding_layer(rest_at_end(chain, dresspack_at_rest(construction)), first.place)
          : SlidingLayer{});
}

double fibre_angle(int fibre, int count) { return count == 0 ? 0 : pi + 2 * pi * fibre / count; }

std::vector<Fibre> surface_fibres(int count) {
  if (count == 0) return {{0, 0, true}};
  std::vector<Fibre> fibres;
  for (int k = 0; k < count; ++k) {
    const double angle = fibre_angle(k, count);
    fibres.push_back({std::sin(angle), std::cos(angle), false});
  }
  return fibres;
}

}  // namespace dresslife::strain
