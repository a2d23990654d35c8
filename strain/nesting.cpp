#include "strain/nesting.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"

namespace dresslife::strain {
namespace {

/// Returns the undeformed parent at the end of a nesting. turn < 0: at its own phase; else with its helical ancestor moved by
/// `turn`.
const ComponentState<double>& rest_at_end(const BundleNesting& nesting, int turn = -1) {
  if (nesting.steps.empty()) return nesting.dresspack_at_rest;
  return turn < 0 ? nesting.steps.back().rest : nesting.steps.back().turned_rest[turn];
}

SlidingNumbers sliding_numbers(const LayerSlip& slip, const BundleNesting& nesting, const Placement& place) {
  SlidingNumbers slide;
  slide.sliding = slip.sliding;
  slide.helical_level = slip.helical_level;
  slide.cap = slip.cap;
  slide.radial_share = slip.radial_share;
  if (slip.sliding == Sliding::over_pitch) slide.mean_rest_rate = mean_path_rate(rest_at_end(nesting), place);
  if (slip.sliding == Sliding::along_ancestor) {
    double sum = 0;
    for (int turn = 0; turn < phases_per_pitch; ++turn) sum += path_rate(rest_at_end(nesting, turn), place);
    slide.mean_rest_rate = sum / phases_per_pitch;
  }
  return slide;
}

/// Sets the state of a node at rest at its place.
void put_at_rest(WireNode& node, const ComponentState<double>& parent) {
  node.rest = wire_state(parent, node.place);
  node.inverse_rest_stretch = 1 / node.rest.stretch;
  const bool exact = !is_thesis(node.place.kinematics);
  node.rest_rate = exact ? node.rest.stretch / node.place.lay_cosine : node.rest.stretch;
}

/// Moves a place around its layer by an angle.
void turn_place(Placement& place, double sine, double cosine) {
  const double before = place.sine.at[0];
  place.sine.at[0] = before * cosine + place.cosine.at[0] * sine;
  place.cosine.at[0] = place.cosine.at[0] * cosine - before * sine;
}

SlidingLayer closed_layer(const BundleNesting& nesting, const WireNode& first) {
  std::array<double, most_sliding_fibres> heights;
  std::size_t count = 0;
  for (const Fibre& fibre : nesting.fibres)
    heights[count++] = fibre.on_axis ? 0 : -first.wire_radius * fibre.phi_cosine;
  return sliding_layer(rest_at_end(nesting), first.place, first.slide.radial_share, {heights.data(), count});
}

bool helical(const Layer& layer) { return layer.helix_radius > 0 && layer.lay_angle != 0; }

}  // namespace

BundleNesting nesting_to(const Construction& construction, const std::vector<LayerSlip>& plan, int part, double arc,
                         const std::vector<Fibre>& fibres) {
  // Each level needs one order, and fibres that depend on bend1 need one more.
  const int order = std::min(construction.levels() + 1, Series<double>::capacity - 1);
  BundleNesting nesting;
  nesting.fibres = fibres;
  nesting.dresspack_at_rest = uniform_rod<double>(0, 0, construction.rest_curvature(), 0, order);
  nesting.order = order_for(fibres);
  const bool any_turned =
      std::ranges::any_of(plan, [](const LayerSlip& slip) { return slip.sliding == Sliding::along_ancestor; });
  const std::vector<int> line = construction.ancestry(part);
  nesting.steps.reserve(line.size());
  for (const int level_part : line) {
    const Part& of = construction.parts()[level_part];
    NestingLevel step;
    // A loose cable does not turn about itself, with or without lay. Its phase is that at the clamp (W32).
    step.place = plan[of.layer].loose ? make_placement(construction.kinematics(), 0.0, 0.0, 1.0,
                                                       construction.phase(of.layer, of.number, of.parent, 0), order)
                                      : construction.placement(of.layer, of.number, of.parent, arc, 0, order);
    step.rest = child(rest_at_end(nesting), step.place);
    step.slide = sliding_numbers(plan[of.layer], nesting, step.place);
    const bool turns = helical(construction.layers()[of.layer]);
    for (int turn = 0; any_turned && turn < phases_per_pitch; ++turn) {
      const double angle = turns ? 2 * pi * turn / phases_per_pitch : 0;
      step.turned[turn] =
          plan[of.layer].loose ? step.place : construction.placement(of.layer, of.number, of.parent, arc, angle, order);
      step.turned_rest[turn] = child(rest_at_end(nesting, turns ? -1 : turn), step.turned[turn]);
    }
    nesting.steps.push_back(step);
  }
  return nesting;
}

WireNode node_at(const Construction& construction, const std::vector<LayerSlip>& plan, const BundleNesting& nesting,
                 int layer, int number, int part, double arc, double turn) {
  WireNode node;
  node.place = construction.placement(layer, number, part, arc, turn, 0);
  put_at_rest(node, rest_at_end(nesting));
  node.slide = sliding_numbers(plan[layer], nesting, node.place);
  const Layer& of = construction.layers()[layer];
  node.shear_radius = of.part_radius * of.shear_factor / of.strain_factor;  // the kernels multiply by strain_factor
  node.wire_radius = of.is_hose ? 0 : of.part_radius;
  node.strain_factor = of.strain_factor;
  return node;
}

void add_wire_layer(const Construction& construction, const std::vector<LayerSlip>& plan, BundleNesting& nesting,
                    int layer, int part, double arc) {
  const double fifth = 2 * pi / waves_per_layer, sine = std::sin(fifth), cosine = std::cos(fifth);
  WireNode node = node_at(construction, plan, nesting, layer, 1, part, arc, 0);
  const bool closed =
      nesting.order == 0 && !is_thesis(node.place.kinematics) && node.slide.sliding == Sliding::over_pitch;
  nesting.sliding.push_back(closed ? closed_layer(nesting, node) : SlidingLayer{});
  nesting.nodes.push_back(node);
  for (int k = 1; k < waves_per_layer; ++k) {
    turn_place(node.place, sine, cosine);
    put_at_rest(node, rest_at_end(nesting));
    if (node.slide.sliding == Sliding::along_ancestor) node.slide = sliding_numbers(plan[layer], nesting, node.place);
    nesting.nodes.push_back(node);
  }
}

int order_for(const std::vector<Fibre>& fibres) {
  return std::ranges::any_of(fibres,
                             [](const Fibre& fibre) { return !fibre.on_axis && std::abs(fibre.phi_sine) > 1e-12; });
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
