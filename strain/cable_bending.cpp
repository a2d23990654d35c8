#include "strain/cable_bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "strain/construction.h"
#include "strain/slip.h"

namespace dresslife::strain {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int phases = 36;                // around a layer: whole harmonics are exact, what yields is to 1e-3
constexpr double small_curvature = 1e-4;  // [1/m]; strains of 1e-6: first order to 1e-6, rounding 1e-10
void scale_friction(std::vector<pipeline::Component>& parts, double factor) {
  for (pipeline::Component& part : parts) {
    if (part.friction) *part.friction *= factor;
    scale_friction(part.components, factor);
  }
}

constexpr double no_friction = 0, all_friction = 1e12;  // levels

}  // namespace

/// A part of the cable at rest and slightly bent.
struct CableBending::Bent {
  Rod<double> rest, now;
  double per_length;  ///< how many of it, times their length, per length of the cable
  double evening;     ///< path length of the nearest helix' pitch in it or above; 0: none [m]
  int depth;
};

CableBending::CableBending(const pipeline::Dresspack& dresspack, const pipeline::Component& cable) {
  constexpr int order = Series<double>::capacity - 1;
  const Bent straight{uniform_rod<double>(0, 0, 0, 0, order),
                      uniform_rod<double>(0, small_curvature, 0, 0, order), 1, 0, 0};
  for (const pipeline::Component& layer : cable.components) add(dresspack, layer, straight);
}

void CableBending::add(const pipeline::Dresspack& dresspack, const pipeline::Component& layer,
                       const Bent& parent) {
  const double signed_angle = sign_of(layer.hand) * layer.lay_angle, sine = std::sin(layer.lay_angle);
  const double cosine = std::cos(layer.lay_angle), R = layer.helix_radius;
  const bool helical = R > 0 && layer.lay_angle != 0;
  if (R > 0 && !helical && parent.evening == 0)
    throw pipeline::InputError(
        layer.where,
        fmt::format(
            "'{}' lies straight beside the axis of a cable with measured_bending_stiffness_Nm2 (how far "
            "it slides in a bent sample depends on the sample's length)",
            layer.name),
        "give its lay_angle_deg, or leave out the measured stiffness");
  const double evening = helical ? 2 * pi * R / sine : parent.evening / cosine;
  const double EA = axial_stiffness(dresspack, layer);
  const double press = R > 0 ? sine * sine / R : 0, reach = layer.friction.value_or(0) * evening / 4;
  const double share = radial_share(EA, layer.lay_angle, R, layer.radial_stiffness.value_or(HUGE_VAL));
  const double weight = parent.per_length * layer.count / phases / cosine;
  const int depth = parent.depth + 1;
  depth_ = std::max(depth_, depth);
  for (int k = 0; k < phases; ++k) {
    const Placement place =
        make_placement(pipeline::Kinematics::exact, R, signed_angle, 2 * pi * (k + 0.5) / phases);
    const Rod<double> rest = child(parent.rest, place), glued = child(parent.now, place);
    const double strain = glued.stretch.at[0] / rest.stretch.at[0] - 1;
    const double mean = helical ? mean_path_rate(parent.now, place) / mean_path_rate(parent.rest, place) - 1
                                : (R == 0 ? strain : 0);
    const double away = (strain - mean) / small_curvature, lever = weight * EA * away;
    if (R > 0 && EA > 0)
      held_.push_back({depth, share * away, lever, reach * layer.tension * press / EA,
                       reach * layer.radial_line_load.value_or(0) / EA,
                       elastic_share(layer.jacket_stiffness, EA, evening)});
    const Rod<double> now = slid(glued, share * mean, rest, pipeline::Kinematics::exact);
    if (!layer.components.empty()) {
      const Bent bent{rest, now, weight, evening, depth};
      for (const pipeline::Component& inner : layer.components) add(dresspack, inner, bent);
      continue;
    }
    const pipeline::Material* const material = pipeline::find_material(dresspack, layer.material);
    if (material == nullptr) continue;
    const auto rate = [&](const Series<double>& of, const Series<double>& at_rest) {
      return (of.at[0] - at_rest.at[0]) / small_curvature;
    };
    const double bend1 = rate(now.bend1, rest.bend1), bend2 = rate(now.bend2, rest.bend2);
    const double twist = rate(now.twist, rest.twist), stretch = mean / small_curvature;
    const double EI = EA * layer.radius * layer.radius / 4, GJ = EI / (1 + material->poisson_ratio);
    own_stiffness_ +=
        weight * (EI * (bend1 * bend1 + bend2 * bend2) + GJ * twist * twist + share * EA * stretch * stretch);
  }
}

double CableBending::moment(double curvature, double friction_level) const {
  double sum = own_stiffness_ * curvature;
  for (const Held& of : held_) {
    const double away = of.strain_rate * curvature, cap = of.by_tension + friction_level * of.by_line_load;
    const double held = of.elastic * away + std::clamp((1 - of.elastic) * away, -cap, cap);
    sum += of.moment_per_strain * held;
  }
  return sum;
}

double CableBending::free_stiffness() const {
  double sum = own_stiffness_;
  for (const Held& of : held_) sum += of.moment_per_strain * of.elastic * of.strain_rate;
  return sum;
}

double CableBending::stuck_stiffness(int levels) const {
  double sum = own_stiffness_;
  for (const Held& of : held_)
    sum +=
        of.moment_per_strain * of.strain_rate * (levels == 0 || of.depth > depth_ - levels ? 1 : of.elastic);
  return sum;
}

double friction_level(const pipeline::Dresspack& dresspack, const pipeline::Component& cable) {
  const CableBending bending(dresspack, cable);
  const double curvature = cable.measured_at_curvature, polymer = cable.polymer_bending_stiffness;
  const auto stiffness = [&](double level) { return polymer + bending.moment(curvature, level) / curvature; };
  const double wanted = *cable.measured_bending_stiffness;
  const double least = stiffness(no_friction), most = stiffness(all_friction);
  if (wanted < least || wanted > most)
    throw pipeline::InputError(
        cable.where,
        fmt::format(
            "'{}' has measured_bending_stiffness_Nm2 {:.4g} at {:.4g} 1/m (its wires and polymer have "
            "{:.4g} without friction and {:.4g} where friction holds all that it presses)",
            cable.name, wanted, curvature, least, most),
        "check the measurement, polymer_bending_stiffness_Nm2, the radii and lay angles, and that the layers "
        "have a friction_coefficient and a radial_line_load_N_per_m");
  double low = 1e-9, high = all_friction;  // M grows with the level
  for (int halving = 0; halving < 80; ++halving) {
    const double middle = std::sqrt(low * high);
    (stiffness(middle) < wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

std::vector<double> bending_moments(const pipeline::Dresspack& dresspack, pipeline::Component cable, double friction,
                                    const std::vector<double>& curvature) {
  const double level = cable.measured_bending_stiffness ? friction_level(dresspack, cable) : 1;
  scale_friction(cable.components, friction);
  const CableBending bending(dresspack, cable);
  std::vector<double> moments;
  for (const double k : curvature) moments.push_back(cable.polymer_bending_stiffness * k + bending.moment(k, level));
  return moments;
}

}  // namespace dresslife::strain
