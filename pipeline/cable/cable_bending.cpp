#include "pipeline/cable/cable_bending.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/polymer.h"
#include "pipeline/cable/shares.h"

namespace dresslife::pipeline {
namespace {

using helices::ComponentState;
using helices::Placement;
using helices::Series;

// Angles around a layer: the summed quantity has 2 d harmonics at level d, so 12 angles are exact for five levels.
constexpr int phases = 12;
constexpr double small = 1e-4;  // [1/m], [rad/m]; strains of 1e-6: the error of the first order is 1e-6, rounding 1e-10
// Length of a cable in its bending test [m], as config/observations/your_cable.md requires. Over longer waves, wires slide out at
// the ends. This length matters only for parts with a longer turn; those of the shipped dresspacks turn within 66 mm.
constexpr double bent_sample = 0.5;
constexpr double reach =
    1e-3;  // [m]; elongation per twist of similar effect, a typical distance of a wire from the axis

constexpr double no_friction = 0, all_friction = 1e12;  // friction levels

/// A part of the cable, undeformed and slightly deformed.
struct BentPart {
  ComponentState<double> rest, now;
  double per_length;      ///< number of such parts times their length, per length of the cable
  double turning;         ///< about the cable's axis, per length of the part [rad/m]
  bool helical;           ///< the part or one of its parents is helical
  double friction_level;  ///< of the parts in it
  int depth;
  bool alike_around = false;  ///< all parts at one radius have the same strain at every angle
};

/// Deformation of a layer of parts or wires at one angle, per size of the cable's deformation.
struct Answer {
  const Component& layer;
  const BentPart& parent;
  double EA, weight;
  double evening;  ///< length over which its strain evens out; 0: straight in straight parts [m]
  double share;
  double away, mean;                       ///< deviation of the strain from the mean over its pitch, and that mean
  double bend1 = 0, bend2 = 0, twist = 0;  ///< of wires
  int depth;
};

/// Visits the levels below a deformed parent; calls take(answer) for each layer at each of its angles.
template <class Take>
void descend(const Dresspack& dresspack, const Component& layer, const BentPart& parent, const Take& take) {
  const double signed_angle = sign_of(layer.hand) * layer.lay_angle, R = layer.helix_radius;
  const double cosine = std::cos(layer.lay_angle);
  const bool helical = R > 0 && layer.lay_angle != 0;
  const double turns = helices::turning(parent.turning, signed_angle, R);
  const double evening = helical || parent.helical ? helices::evening_length(turns, bent_sample) : 0;
  const double EA = axial_stiffness(dresspack, layer);
  const double share = helices::radial_share(EA, layer.lay_angle, R, layer.radial_stiffness.value_or(HUGE_VAL));
  const int angles = parent.alike_around ? 1 : phases;
  const double weight = parent.per_length * layer.count / angles / cosine;
  const double inside = layer.measured_bending_stiffness ? friction_level(dresspack, layer) : parent.friction_level;
  for (int k = 0; k < angles; ++k) {
    const Placement place =
        helices::make_placement(Kinematics::exact, R, std::tan(signed_angle), std::cos(signed_angle),
                                2 * pi * (k + 0.5) / angles, parent.rest.stretch.order);
    const ComponentState<double> rest = helices::child(parent.rest, place), glued = helices::child(parent.now, place);
    const double strain = glued.stretch.at[0] / rest.stretch.at[0] - 1;
    const double mean =
        R == 0 ? strain : helices::mean_path_rate(parent.now, place) / helices::mean_path_rate(parent.rest, place) - 1;
    const ComponentState<double> now = helices::slid(glued, share * mean, rest, Kinematics::exact);
    const auto rate = [&](const Series<double>& of, const Series<double>& at_rest) {
      return (of.at[0] - at_rest.at[0]) / small;
    };
    take(Answer{layer, parent, EA, weight, evening, share, (strain - mean) / small, mean / small,
                rate(now.bend1, rest.bend1), rate(now.bend2, rest.bend2), rate(now.twist, rest.twist),
                parent.depth + 1});
    const BentPart bent{rest, now, weight, turns, helical || parent.helical, inside, parent.depth + 1};
    for (const Component& inner : layer.components) descend(dresspack, inner, bent, take);
  }
}

/// Returns the number of levels of parts in a part, at least one. Each level needs one order (series.h).
int levels_in(const Component& part) {
  return largest_of(part.components, 0, [](const Component& inner) { return levels_in(inner) + 1; });
}

/// Returns a uniformly deformed cable with enough orders for its deepest wires.
BentPart straight_cable(const Component& cable, double elongation, double curvature, double twist) {
  const int order = std::clamp(levels_in(cable), 1, Series<double>::capacity - 1);
  return {helices::uniform_rod<double>(0, 0, 0, 0, order),
          helices::uniform_rod<double>(elongation, curvature, 0, twist, order),
          1,
          0,
          false,
          1,
          0,
          curvature == 0};
}

/// Returns the stiffness of a layer whose deviation is free, per size of the deformation and per length of the cable: of wires,
/// and of the bed under a helix of parts. Bed and helix are in series: the helix has the share s of the mean strain m and the
/// force E A s m, the bed has the rest. So twice their energy is E A s m^2. The wires in the parts contribute E A s^2 m^2, and
/// the bed contributes E A s (1 - s) m^2.
double own_stiffness(const Dresspack& dresspack, const Answer& of) {
  if (!of.layer.components.empty()) return of.weight * of.EA * of.share * (1 - of.share) * of.mean * of.mean;
  const Material* const material = find_material(dresspack, of.layer.material);
  if (material == nullptr) return 0;
  const double EI = of.EA * of.layer.radius * of.layer.radius / 4, GJ = EI / (1 + material->poisson_ratio);
  return of.weight * (EI * (of.bend1 * of.bend1 + of.bend2 * of.bend2) + GJ * of.twist * of.twist +
                      of.share * of.EA * of.mean * of.mean);
}

/// Returns the mean of held(phi) sin(phi) around a layer with the deviation `away` sin(phi) (W29). cap: at phi = pi/2.
double held_by_friction(double away, double cap) {
  const double slope = 2 * cap / pi;  // of the accumulated friction, per angle from the neutral axis
  if (away <= slope) return away / 2;
  double slides = pi / 2;  // up to this angle, at which both are equal
  if (away < cap)
    for (double low = 0, high = pi / 2; slides = (low + high) / 2, high - low > 1e-14;)
      (away * std::sin(slides) > slope * slides ? low : high) = slides;
  return 2 / pi *
         (slope * (std::sin(slides) - slides * std::cos(slides)) +
          away * ((pi / 2 - slides) / 2 + std::sin(2 * slides) / 4));
}

void refuse_straight(const Component& layer) {
  throw InputError(
      layer.where,
      fmt::format("'{}' lies straight beside the axis of its cable (how far it slides in a bent sample depends on "
                  "the sample's length)",
                  layer.name),
      "give its lay_angle_deg, or leave out measured_bending_stiffness_Nm2");
}

}  // namespace

double axial_stiffness(const Dresspack& dresspack, const Component& part) {
  if (part.plain) return properties_of(*part.plain, part.radius).axial;
  if (part.components.empty()) {
    const Material* const material = find_material(dresspack, part.material);
    return material ? material->youngs_modulus * pi * part.radius * part.radius : 0;
  }
  return sum_of(part.components, [&](const Component& inner) {
    return inner.count * axial_stiffness(dresspack, inner) * std::pow(std::cos(inner.lay_angle), 3) *
           left_by_bed(dresspack, inner);
  });
}

double left_by_bed(const Dresspack& dresspack, const Component& part) {
  if (part.helix_radius == 0 || !part.radial_stiffness) return 1;
  return helices::radial_share(axial_stiffness(dresspack, part), part.lay_angle, part.helix_radius,
                               *part.radial_stiffness);
}

CableBending::CableBending(const Dresspack& dresspack, const Component& cable, StraightParts straight) {
  std::vector<const Component*> layers;
  const auto take = [&](const Answer& of) {
    depth_ = std::max(depth_, of.depth);
    own_stiffness_ += own_stiffness(dresspack, of);
    const Component& layer = of.layer;
    if (layer.helix_radius == 0 || of.EA == 0) return;
    if (of.evening == 0 && straight == StraightParts::refused) refuse_straight(layer);
    const double sine = std::sin(layer.lay_angle), press = sine * sine / layer.helix_radius;
    const double gathers = layer.friction.value_or(0) * of.evening / 4;  // (W16) [m]
    const double line_load = of.parent.friction_level * layer.radial_line_load.value_or(0);
    auto known = std::ranges::find(layers, &layer);
    if (known == layers.end()) layers.push_back(&layer), held_.emplace_back(), known = layers.end() - 1;
    HeldLayer& held = held_[known - layers.begin()];
    held.depth = of.depth;
    held.stiffness += of.weight * of.EA;
    held.glued += of.weight * of.EA * of.away * of.away;
    held.share = of.share;
    held.by_tension = gathers * layer.tension * press / of.EA;
    held.by_line_load = gathers * line_load / of.EA;
    held.elastic = helices::elastic_share(layer.jacket_stiffness, of.EA, of.evening);
  };
  for (const Component& layer : cable.components) descend(dresspack, layer, straight_cable(cable, 0, small, 0), take);
}

double CableBending::moment(double curvature, double friction_level) const {
  double sum = own_stiffness_ * curvature;
  for (const HeldLayer& of : held_) {
    const double rate = std::sqrt(2 * of.glued / of.stiffness);
    const double cap = of.by_tension + friction_level * of.by_line_load;
    const double away = of.share * rate * curvature;
    sum += of.elastic * of.share * of.glued * curvature +
           of.stiffness * rate * held_by_friction((1 - of.elastic) * away, cap);
  }
  return sum;
}

double CableBending::friction(double curvature, double friction_level) const {
  return moment(curvature, friction_level) - free_stiffness() * curvature;
}

double CableBending::free_stiffness() const {
  return sum_of(
      held_, [](const HeldLayer& of) { return of.elastic * of.share * of.glued; }, own_stiffness_);
}

double CableBending::stuck_stiffness(int levels) const {
  const auto stiffness = [&](const HeldLayer& of) {
    return of.share * of.glued * (levels == 0 || of.depth > depth_ - levels ? 1 : of.elastic);
  };
  return sum_of(held_, stiffness, own_stiffness_);
}

double PullAndTwist::relaxed() const {
  return pull_by_elongation > 0 ? torque_by_twist - coupling * coupling / pull_by_elongation : torque_by_twist;
}

PullAndTwist pull_and_twist(const Dresspack& dresspack, const Component& cable) {
  // Twice the energy of a deformation is quadratic in it: three deformations give the three constants.
  const auto twice_energy = [&](double elongation, double twist) {
    double sum = 0;
    for (const Component& layer : cable.components)
      descend(dresspack, layer, straight_cable(cable, elongation * reach * small, 0, twist * small),
              [&](const Answer& of) { sum += own_stiffness(dresspack, of); });
    return sum;
  };
  const double pulled = twice_energy(1, 0), twisted = twice_energy(0, 1), both = twice_energy(1, 1);
  return {pulled / (reach * reach), (both - pulled - twisted) / (2 * reach), twisted};
}

double friction_level(const Dresspack& dresspack, const Component& cable) {
  const CableBending bending(dresspack, cable);
  const double curvature = cable.measured_at_curvature, polymer = cable.polymer_bending_stiffness;
  const auto stiffness = [&](double level) { return polymer + bending.moment(curvature, level) / curvature; };
  const double wanted = *cable.measured_bending_stiffness;
  const double least = stiffness(no_friction), most = stiffness(all_friction);
  if (wanted < least || wanted > most)
    throw InputError(
        cable.where,
        fmt::format("'{}' has measured_bending_stiffness_Nm2 {:.4g} at {:.4g} 1/m (its wires and polymer have "
                    "{:.4g} without friction and {:.4g} where friction holds all that it presses)",
                    cable.name, wanted, curvature, least, most),
        "check the measurement, polymer_bending_stiffness_Nm2, the radii and lay angles, and that the layers "
        "have a friction_coefficient and a radial_line_load_N_per_m");
  double low = 1e-9, high = all_friction;  // M increases with the level
  for (int halving = 0; halving < 80; ++halving) {
    const double middle = std::sqrt(low * high);
    (stiffness(middle) < wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double jacket_bending(double radius) { return jacketed_modulus * pi / 4 * std::pow(radius, 4); }

double polymer_bending(const Component& part) {
  if (part.components.empty()) return 0;
  if (part.polymer_bending_stiffness > 0 || part.measured_bending_stiffness) return part.polymer_bending_stiffness;
  return part.stiffness_factor * jacket_bending(part.radius);
}

double cable_stiffness(const Dresspack& dresspack, const Component& cable) {
  if (cable.measured_bending_stiffness) return *cable.measured_bending_stiffness;
  const double curvature = cable.measured_at_curvature;
  return polymer_bending(cable) + CableBending(dresspack, cable, StraightParts::slide).moment(curvature, 1) / curvature;
}

std::vector<double> bending_moments(const Dresspack& dresspack, const Component& cable, double friction,
                                    const std::vector<double>& curvature) {
  const double level = cable.measured_bending_stiffness ? friction_level(dresspack, cable) : 1;
  const CableBending bending(dresspack, cable);
  const double sliding = polymer_bending(cable) + bending.free_stiffness();
  return mapped(curvature, [&](double k) {
    return sliding * k +
           (friction > 0 ? friction * bending.friction(k / friction, level) : 0);  // M - E I k is homogeneous
  });
}

}  // namespace dresslife::pipeline
