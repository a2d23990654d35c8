#include "pipeline/cable/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {
namespace {

constexpr double allowed = 0.02;   // share of the diameter without a warning
constexpr double rounding = 1e-9;  // share of the diameter: six straight parts around one of equal diameter touch
constexpr double hopeless = 0.5;   // share of the diameter, between the axes
constexpr int steps = 64;          // of phi, to find the minimum
constexpr const char* rough = "radii and lay angles that were measured or estimated roughly";

/// Returns the distance of two helices of these radii [m] with one rate of rotation [rad/m]. turned: angle between them in a
/// cross-section, 0 .. pi. The distance has one minimum between phi = -turned, where the neighbour is beside the point, and 0, where
/// it is a lay before it. It is found by steps, then by ternary search.
double helix_distance(double R, double r, double rate, double turned) {
  const auto squared = [&](double phi) {
    return R * R + r * r - 2 * R * r * std::cos(turned + phi) + (phi == 0 ? 0 : std::pow(phi / rate, 2));
  };
  if (rate == 0) return std::sqrt(squared(0));
  int nearest = 0;
  for (int k = 1; k <= steps; ++k)
    if (squared(-turned * k / steps) < squared(-turned * nearest / steps)) nearest = k;
  double low = -turned * std::min(nearest + 1, steps) / steps, high = -turned * std::max(nearest - 1, 0) / steps;
  for (int third = 0; third < 40;
       ++third) {  // the width becomes 2/3 each time: 1e-7 of a step in the end, squared in the distance
    const double left = (2 * low + high) / 3, right = (low + 2 * high) / 3;
    (squared(left) < squared(right) ? high : low) = squared(left) < squared(right) ? right : left;
  }
  return std::sqrt(squared((low + high) / 2));
}

bool fits(const Component& of, double lay_angle, int count, double give = rounding) {
  return count < 2 || neighbour_distance(of.helix_radius, lay_angle, count) >= 2 * of.radius * (1 - give);
}

int largest_count(const Component& of) {
  int count = of.count;
  while (!fits(of, of.lay_angle, count)) --count;
  return count;
}

/// Returns the largest lay angle that fits, by bisection between 0, which fits, and the component's angle, which does not.
double largest_lay_angle(const Component& of) {
  return halved(0, of.lay_angle, 40, [&](double lay_angle) { return fits(of, lay_angle, of.count); }).low;
}

/// Returns the least radius of the circle on which the parts fit at this lay angle [m].
double least_helix_radius(const Component& of) {
  const double enough = of.count * of.radius / std::cos(of.lay_angle);  // a circle of 2 pi R > K 2 r / cos
  const auto overlap = [&](double radius) {
    return neighbour_distance(radius, of.lay_angle, of.count) < 2 * of.radius;
  };
  return halved(of.helix_radius, enough, 40, overlap).high;
}

/// Returns keys with values, each of which is a remedy by itself.
std::string what_fits(Component of) {
  constexpr double steepest = 30 * pi / 180;  // cores of moved cables have 8 to 25 deg
  if (of.lay_angle > steepest) {
    const double number = of.lay_angle * 180 / pi, meant = std::atan(2 * pi * of.helix_radius / (1e-3 * number));
    const std::string angle =
        (meant <= steepest
             ? fmt::format("lay_angle_deg: {:.3g} if {:.4g} is the lay length in mm, or ", meant * 180 / pi, number)
             : std::string("lay_angle_deg: ")) +
        "the angle of the cable (8 to 25)";
    of.lay_angle = std::min(meant, steepest);
    return fits(of, of.lay_angle, of.count, allowed) ? angle : angle + "; with it " + what_fits(std::move(of));
  }
  std::string keys = fmt::format("count: {} or less", largest_count(of));
  if (of.lay_angle > 0 && fits(of, 0, of.count))
    keys = fmt::format("lay_angle_deg: {:.1f} or less, or ", std::floor(10 * largest_lay_angle(of) * 180 / pi) / 10) +
           keys;
  return keys + fmt::format(", or helix_radius_mm: {:.4g} or more", std::ceil(1e6 * least_helix_radius(of)) / 1e3);
}

/// Returns the rotation about the parent's axis along the parent [rad/m].
double turn_rate(const Component& of) {
  if (of.helix_radius == 0) return 0;
  return (of.hand == Hand::left ? -1 : 1) * std::tan(of.lay_angle) / of.helix_radius;
}

/// Returns whether parts stay beside each other; otherwise they cross within a metre.
bool go_on_alike(const Component& one, const Component& other) {
  constexpr double along = 1;  // [m]
  if (one.helix_radius == 0 || other.helix_radius == 0) return true;
  return std::abs(turn_rate(one) - turn_rate(other)) * along < 2 * pi / std::max(one.count, other.count);
}

void add_overlaps_between(const std::vector<Component>& components, Problems& problems,
                          std::vector<Warning>* warnings) {
  for (std::size_t a = 0; a < components.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Component &one = components[b], &other = components[a];
      if (!overlap_each_other(one, other)) continue;
      const double apart = nearest_distance(one, other), needed = one.radius + other.radius;
      const bool other_is_outer = other.helix_radius >= one.helix_radius;
      const Component &outer = other_is_outer ? other : one, &inner = other_is_outer ? one : other;
      const auto name = [](const Component& of) { return of.layer.empty() ? of.name : of.layer + "/" + of.name; };
      const std::string what = fmt::format(
          "'{}' and '{}' come as near as {:.4g} mm between their axes, {:.3f} mm less than their "
          "radii together",
          name(one), name(other), 1e3 * apart, 1e3 * (needed - apart));
      const std::string remedy =
          go_on_alike(one, other)
              ? fmt::format("check phase_deg, helix_radius_mm and radius_mm of both, or write place: auto for both")
              : fmt::format("give '{}' helix_radius_mm: {:.4g} or more", name(outer),
                            1e3 * (inner.helix_radius + needed));
      if (apart < hopeless * needed && go_on_alike(one, other))
        problems.add(other.where, what + " (nearer than half of these)", remedy);
      else if (warnings)
        warnings->push_back(warning_of(WarningKind::overlap, other.where.text(), what, rough, remedy));
    }
}

/// Adds a problem for a gross overlap, and a warning for a smaller one if warnings are requested.
void add_overlaps(const Component& of, Problems& problems, std::vector<Warning>* warnings) {
  for (const Component& inner : of.components) add_overlaps(inner, problems, warnings);
  add_overlaps_between(of.components, problems, warnings);
  if (!overlaps(of)) return;
  const double apart = neighbour_distance(of.helix_radius, of.lay_angle, of.count), needed = 2 * of.radius;
  const std::string name = of.layer.empty() ? of.name : of.layer + "/" + of.name;
  const std::string what =
      fmt::format("the {} parts '{}' are {:.4g} mm apart between their axes, {:.3f} mm less than their diameter",
                  of.count, name, 1e3 * apart, 1e3 * (needed - apart));
  if (apart < hopeless * needed)
    problems.add(of.where, fmt::format("{} (nearer than half of it)", what), "give " + what_fits(of));
  else if (warnings)
    warnings->push_back(warning_of(WarningKind::overlap, of.where.text(), what, rough, what_fits(of)));
}

/// Adds warnings about parts outside of an estimated bore.
void add_outside(const Dresspack& dresspack, std::vector<Warning>& warnings) {
  const PartsRoom room = room_of_parts(dresspack);
  for (const Component& of : dresspack.components)
    if (const double by = outside_bore(room, of); by > 0 && room.estimated)
      warnings.push_back(warning_of(
          WarningKind::overlap, of.where.text(),
          fmt::format("'{}' reaches {:.4g} mm from the axis, {:.3g} mm outside a bore of {:.4g} mm radius, which is an "
                      "ESTIMATE",
                      of.name, 1e3 * (of.helix_radius + of.radius), 1e3 * by, 1e3 * room.bore),
          fmt::format("the bore is not given and counts as {:g} of diameter_mm, as of corrugated hoses",
                      usual_bore_share),
          fmt::format("give inner_diameter_mm as measured; or of parts that fit, helix_radius_mm: {:.4g} or less",
                      1e3 * std::max(0.0, room.bore - of.radius))));
}

/// Adds a warning about a hose that its parts fill too much. A maker's clearance of a tenth of a cable's diameter is less strict.
void add_filling(const Dresspack& dresspack, std::vector<Warning>& warnings) {
  constexpr double most = 0.7;  // of the bore, in moved conduits: PMA, recommendation for filling grade
  const std::optional<double> bore = inner_radius(dresspack);
  if (!bore) return;
  double squares = dresspack.core_components.empty() ? dresspack.core_diameter * dresspack.core_diameter / 4 : 0;
  for (const auto* const parts : {&dresspack.components, &dresspack.core_components})
    for (const Component& part : *parts) squares += part.count * part.radius * part.radius;
  if (const double share = squares / (*bore * *bore); share > most)
    warnings.push_back(warning_of(
        WarningKind::overlap, dresspack.where.text(),
        fmt::format(
            "the parts fill {:.0f} % of the bore of {:.4g} mm (limit {:g} % of a hose that moves: the parts rub more on each other)",
            100 * share, 2e3 * *bore, 100 * most),
        "a hose that is too narrow for its parts",
        fmt::format("a hose with {}, or fewer parts",
                    wider_hose(std::ceil(2e4 * std::sqrt(squares / most)) / 10, dresspack))));
}

}  // namespace

double neighbour_distance(double helix_radius, double lay_angle, int count) {
  return helix_distance(helix_radius, helix_radius, std::tan(lay_angle) / helix_radius, 2 * pi / count);
}

double nearest_distance(const Component& one, const Component& other) {
  if (one.helix_radius == 0 || other.helix_radius == 0 || !go_on_alike(one, other))
    return std::abs(one.helix_radius - other.helix_radius);
  double nearest = one.helix_radius + other.helix_radius;
  for (int k = 0; k < one.count; ++k)
    for (int j = 0; j < other.count; ++j) {
      const double between = one.phase + 2 * pi * k / one.count - other.phase - 2 * pi * j / other.count;
      nearest = std::min(nearest, helix_distance(one.helix_radius, other.helix_radius, std::abs(turn_rate(one)),
                                                 std::abs(std::remainder(between, 2 * pi))));
    }
  return nearest;
}

bool overlaps(const Component& component) {
  return component.helix_radius > 0 && !fits(component, component.lay_angle, component.count, allowed);
}

bool overlap_each_other(const Component& one, const Component& other) {
  return nearest_distance(one, other) < (one.radius + other.radius) * (1 - allowed);
}

std::vector<Warning> overlap_warnings(const Dresspack& dresspack) {
  Problems problems;
  std::vector<Warning> warnings;
  for (const Component& component : dresspack.components) add_overlaps(component, problems, &warnings);
  add_overlaps_between(dresspack.components, problems, &warnings);
  add_outside(dresspack, warnings);
  add_filling(dresspack, warnings);
  problems.finish();
  return warnings;
}

void refuse_gross_overlap(const Dresspack& dresspack) {
  if (crowd_in(dresspack)) return;  // check_dresspack() reports it
  Problems problems;
  for (const Component& component : dresspack.components) add_overlaps(component, problems, nullptr);
  add_overlaps_between(dresspack.components, problems, nullptr);
  problems.finish();
}

}  // namespace dresslife::pipeline
