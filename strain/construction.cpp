#include "strain/construction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/corrugation.h"

namespace dresslife::strain {
namespace {

static_assert(Series<double>::capacity >= highest_level + 2);

std::string element(const Layer& layer, int number) {
  return (layer.label.empty() ? "" : layer.label + "/") + layer.name + " " + std::to_string(number);
}

}  // namespace

double Layer::pitch() const {
  if (helix_radius == 0 || lay_angle == 0) return std::numeric_limits<double>::infinity();
  return 2 * pi * helix_radius / std::abs(std::tan(lay_angle));
}

Construction::Construction(const pipeline::Dresspack& dresspack, pipeline::Kinematics kinematics,
                           const pipeline::StrainFactors& factors)
    : kinematics_(kinematics),
      rest_curvature_(dresspack.rest_curvature),
      section_{pipeline::inner_radius(dresspack).value_or(without_limit), dresspack.core_diameter / 2, factors.play},
      hose_bending_stiffness_(dresspack.bending_stiffness) {
  for (const auto& component : dresspack.components) add(dresspack, component, dresspack_itself, 1);
  if (!dresspack.hose_material.empty()) {
    const pipeline::WallFactors profile = pipeline::wall_factors(dresspack);
    pipeline::Component wall;
    wall.name = pipeline::hose_wall_name;
    wall.count = hose_places;
    wall.radius = wall.helix_radius = profile.radius;
    wall.material = dresspack.hose_material;
    add(dresspack, wall, dresspack_itself, 1);
    layers_.back().is_hose = true;
    layers_.back().strain_factor = profile.strain;
    layers_.back().shear_factor = profile.shear;
  }
  for (Layer& layer : layers_) {
    layer.lay_tangent = std::tan(lay_angle(layer));
    layer.lay_cosine = std::cos(lay_angle(layer));
    scale(layer, factors);
  }
  list_parts(dresspack_itself, dresspack_itself);
}

/// Applies the factors. Call after friction_level(), because they also scale the values that a measured stiffness has set.
void Construction::scale(Layer& layer, const pipeline::StrainFactors& factors) const {
  const bool in_hose = layer.is_cable() && section_.inner_radius < without_limit;
  layer.friction *= in_hose ? factors.hose_friction : factors.friction;
  pipeline::Laying& laying = layer.laying;
  laying.slack *= factors.slack;
  for (std::optional<double>* grip : {&laying.base_grip, &laying.tool_grip})
    if (*grip) **grip *= factors.grip;
}

void Construction::check(const pipeline::Component& component, int parent_layer, int level) const {
  const std::string name = "'" + component.name + "'";
  if (level > highest_level)
    throw pipeline::InputError(
        component.where,
        fmt::format("component {} lies {} levels deep (at most {} are computed)", name, level, highest_level),
        "join the outermost levels that have no lay of their own");
  if (component.helix_radius == 0 && (component.count > 1 || component.lay_angle != 0))
    throw pipeline::InputError(component.where,
                               fmt::format("component {} has helix radius 0 (one straight part fits on the axis, not "
                                           "several, and without a lay angle)",
                                           name),
                               "give the radius from the parent's axis to the part's, or count 1 and lay angle 0");
  for (const Layer& other : layers_)
    if (other.parent == parent_layer && other.name == component.name && other.label == component.layer)
      throw pipeline::InputError(
          component.where, fmt::format("two components {} lie in the same part (their paths would be the same)", name),
          "give each its own `layer`, for example 'layer 1'");
}

void Construction::add(const pipeline::Dresspack& dresspack, const pipeline::Component& component, int parent_layer,
                       int level, double friction_level) {
  check(component, parent_layer, level);
  Layer layer;
  layer.name = component.name;
  layer.label = component.layer;
  layer.material = component.material;
  layer.is_wire = is_wire(component);
  layer.level = level;
  layer.parent = parent_layer;
  layer.count = component.count;
  layer.part_radius = component.radius;
  layer.helix_radius = component.helix_radius;
  layer.lay_angle = sign_of(component.hand) * component.lay_angle;
  layer.phase = component.phase;
  layer.friction = component.friction.value_or(0);
  layer.line_load = friction_level * component.radial_line_load.value_or(0);
  layer.tension = component.tension;
  layer.jacket_stiffness = component.jacket_stiffness;
  layer.radial_stiffness = component.radial_stiffness.value_or(layer.radial_stiffness);
  layer.axial_stiffness = pipeline::axial_stiffness(dresspack, component);
  if (layer.is_cable()) {
    layer.loose = pipeline::lies_loose(dresspack, component);
    layer.laying = component.laying;
    layer.component = static_cast<int>(&component - dresspack.components.data());
    layer.force = pipeline::CableForce(dresspack, component);
    layer.shortening = pipeline::twist_shortening(dresspack, component);
  }
  const int index = static_cast<int>(layers_.size());
  layers_.push_back(layer);
  levels_ = std::max(levels_, level);
  const bool measured = component.measured_bending_stiffness.has_value();
  if (measured && friction_level != 1)
    throw pipeline::InputError(component.where,
                               fmt::format("'{}' has measured_bending_stiffness_Nm2 and lies in a part that has it "
                                           "too (one friction level belongs to both)",
                                           component.name),
                               "keep one of the two");
  const double inside = measured ? pipeline::friction_level(dresspack, component) : friction_level;
  for (const auto& inner : component.components) add(dresspack, inner, index, level + 1, inside);
}

void Construction::list_parts(int parent_layer, int parent_part) {
  Bundle bundle{parent_part, {}};
  for (std::size_t k = 0; k < layers_.size(); ++k)
    if (layers_[k].parent == parent_layer && layers_[k].is_wire) bundle.wire_layers.push_back(static_cast<int>(k));
  if (!bundle.wire_layers.empty()) bundles_.push_back(bundle);
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (layers_[k].parent != parent_layer || layers_[k].is_wire) continue;
    for (int number = 1; number <= layers_[k].count; ++number) {
      const int index = static_cast<int>(parts_.size()), layer = static_cast<int>(k);
      parts_.push_back({layer, number, parent_part, wire_path(layer, number, parent_part),
                        length_rate(parent_part) / layers_[k].lay_cosine});
      if (layers_[k].is_cable()) cables_.push_back(index);
      list_parts(layer, index);
    }
  }
}

std::vector<int> Construction::ancestry(int part) const {
  std::vector<int> line;
  for (; part != dresspack_itself; part = parts_[part].parent) line.insert(line.begin(), part);
  return line;
}

int Construction::cable_of(int part) const {
  if (part == dresspack_itself) return no_cable;
  while (parts_[part].parent != dresspack_itself) part = parts_[part].parent;
  return static_cast<int>(std::ranges::lower_bound(cables_, part) - cables_.begin());
}

/// Returns the lay angle of the kinematics. The thesis does not know hands: all its lay angles are positive.
double Construction::lay_angle(const Layer& layer) const {
  return is_thesis(kinematics_) ? std::abs(layer.lay_angle) : layer.lay_angle;
}

double Construction::phase(int layer, int number, int parent, double arc) const {
  const Layer& of = layers_[layer];
  double phase = of.phase + 2 * pi * (number - 1) / of.count;
  if (of.helix_radius > 0) phase += arc * length_rate(parent) * of.lay_tangent / of.helix_radius;
  if (is_thesis(kinematics_) && parent != dresspack_itself) {  // (19)
    const Part& in = parts_[parent];
    phase += pi - this->phase(in.layer, in.number, in.parent, arc);
  }
  return phase - 2 * pi * std::nearbyint(phase / (2 * pi));
}

Placement Construction::placement(int layer, int number, int parent, double arc, double turn, int order) const {
  const Layer& of = layers_[layer];
  return make_placement(kinematics_, of.helix_radius, of.lay_tangent, of.lay_cosine,
                        phase(layer, number, parent, arc) + turn, order);
}

std::string Construction::wire_path(int layer, int number, int parent) const {
  const std::string own = element(layers_[layer], number);
  return parent == dresspack_itself ? own : parts_[parent].path + "/" + own;
}

}  // namespace dresslife::strain
