#include "strain/slip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pipeline/cable/shares.h"

namespace dresslife::strain {
namespace {

// A helix with fewer turns between the clamps evens out over all of them. Evening out over each turn alone would miss the
// incomplete turn, an error of at most R kappa / (2 pi turns). With four turns of a wire 3 mm from the axis at 2 1/m this is
// 2.4e-4, the same as the error of evening out over all turns.
constexpr double least_turns = 4;

/// Returns the cap (W16). Friction gathers along a quarter of the length over which the deviation changes sign and back.
FrictionCap friction_cap(const Layer& layer, double evening_length) {
  const double sine = std::sin(layer.lay_angle);
  const double press = layer.helix_radius > 0 ? sine * sine / layer.helix_radius : 0;  // per tension [1/m]
  const double reach = layer.friction * evening_length / 4;                            // [m]
  const double load = layer.line_load + layer.tension * press;
  if (reach * load == 0) return {0, reach * press};
  return {reach * load / layer.axial_stiffness, reach * press};
}

}  // namespace

std::vector<LayerSlip> plan_slip(const Construction& construction, const std::vector<pipeline::Slip>& slip,
                                 double free_length) {
  assert(!slip.empty());
  const auto& layers = construction.layers();
  std::vector<LayerSlip> plan(layers.size());
  std::vector<int> helical_level(layers.size(),
                                 0);                 // of the layer itself or its nearest helical ancestor; 0: none
  std::vector<double> turning(layers.size());        // about the dresspack or a loose cable [rad/m]
  std::vector<double> length(layers.size());         // ideal length between the clamps [m]
  for (std::size_t k = 0; k < layers.size(); ++k) {  // parents come first
    const Layer& layer = layers[k];
    const bool outermost = layer.parent == dresspack_itself;
    const double parent_length = outermost ? free_length : length[layer.parent];
    const int inherited = outermost ? 0 : helical_level[layer.parent];
    length[k] = parent_length / std::cos(layer.lay_angle);
    const bool helical = !layer.is_cable() && layer.pitch() < parent_length / least_turns;
    helical_level[k] = helical ? layer.level : inherited;
    plan[k].radial_share =
        radial_share(layer.axial_stiffness, layer.lay_angle, layer.helix_radius, layer.radial_stiffness);
    const auto level = std::min<std::size_t>(layer.level, slip.size());
    // A loose cable does not turn about itself. The thesis counts phases from the direction of the bend (19).
    const bool turns = !(layer.is_cable() && layer.loose && slides(slip[level - 1]));
    const double before = outermost || is_thesis(construction.kinematics()) ? 0 : turning[layer.parent];
    turning[k] = turns ? helices::turning(before, layer.lay_angle, layer.helix_radius) : 0;
    const double evening = evening_length(turning[k], length[k]);
    if (!slides(slip[level - 1]) || layer.is_hose) continue;
    if (layer.is_cable()) {
      plan[k].loose = layer.loose;
      plan[k].sliding = layer.loose ? Sliding::glued : Sliding::clamp_to_clamp;
      if (!layer.loose) plan[k].radial_share = 1;  // CablePaths gives the strain that remains with the bed
      continue;
    }
    if (helical)
      plan[k].sliding = Sliding::over_pitch;
    else if (inherited > 0) {
      plan[k].sliding = Sliding::along_ancestor;
      plan[k].helical_level = inherited;
    } else {
      plan[k].sliding = Sliding::clamp_to_clamp;
    }
    if (!rubs(slip[level - 1])) continue;
    plan[k].friction = true;
    plan[k].evening = evening;
    plan[k].cap = friction_cap(layer, evening);
    plan[k].elastic = elastic_share(layer.jacket_stiffness, layer.axial_stiffness, evening);
  }
  return plan;
}

ShortenedPlan shortened(const Construction& construction, std::vector<LayerSlip> plan, double bend_wave) {
  ShortenedPlan result{std::move(plan)};
  std::vector<bool> on_axis(
      result.plan.size());  // true on the axis of its cable: no bend strains it, so friction has no effect
  for (std::size_t k = 0; k < result.plan.size(); ++k) {
    LayerSlip& slip = result.plan[k];
    const Layer& of = construction.layers()[k];
    on_axis[k] = of.is_cable() || (of.helix_radius == 0 && (of.parent == dresspack_itself || on_axis[of.parent]));
    if (!slip.friction) continue;
    const bool holds = !on_axis[k] && slip.cap != FrictionCap{};
    if (holds && slip.evening > result.evening) result.longest = static_cast<int>(k), result.evening = slip.evening;
    if (slip.evening <= bend_wave) continue;
    slip.cap.constant *= bend_wave / slip.evening;
    slip.cap.per_mean *= bend_wave / slip.evening;
    slip.evening = bend_wave;
    slip.elastic = elastic_share(of.jacket_stiffness, of.axial_stiffness, bend_wave);
  }
  return result;
}

}  // namespace dresslife::strain
