#include "pipeline/job/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

namespace {

/// How a kind of rig uses one of the optional keys.
enum class Use { none, optional, required };

struct Parameter {
  const char* key;
  std::optional<double> Rig::*value;
  std::array<Use, 6> uses;  ///< in the order of RigKind

  Use of(RigKind kind) const { return uses[static_cast<std::size_t>(kind)]; }
};

constexpr Use no = Use::none, may = Use::optional, must = Use::required;
/// radius_mm or radius_diameters: see check_radius().
const Parameter parameters[] = {
    // key, member, torsion, rolling_flex, two_pulley, tick_tock, swivel, axial
    {"length_m", &Rig::length, {may, no, no, no, no, no}},
    {"twist_deg_per_m", &Rig::twist, {must, no, no, no, no, no}},
    {"radius_mm", &Rig::radius, {no, may, no, may, may, no}},
    {"radius_diameters", &Rig::radius_diameters, {no, may, no, may, may, no}},
    {"pulley_diameter_mm", &Rig::pulley_diameter, {no, no, must, no, no, no}},
    {"travel_m", &Rig::travel, {no, must, may, no, no, no}},
    {"angle_deg", &Rig::angle, {no, no, may, may, must, no}},
    {"weight_kg", &Rig::weight, {may, no, may, may, must, no}},
    {"elongation_percent", &Rig::elongation, {no, no, no, no, no, must}},
    {"mean_elongation_percent", &Rig::mean_elongation, {no, no, no, no, no, may}},
};

std::vector<std::string_view> keys_of(RigKind kind) {
  std::vector<std::string_view> keys;
  for (const Parameter& parameter : parameters)
    if (parameter.of(kind) != Use::none) keys.push_back(parameter.key);
  return keys;
}

void fill(std::optional<double>& value, double usual) {
  if (!value) value = usual;
}

void check_radius(const Rig& rig) {
  const bool bends = rig.kind == RigKind::rolling_flex || rig.kind == RigKind::tick_tock;
  if (rig.radius && rig.radius_diameters)
    throw InputError(rig.where, "both radius_mm and radius_diameters are given", "keep one of the two");
  if (bends && !rig.radius && !rig.radius_diameters)
    throw InputError(rig.where, fmt::format("a rig of kind {} has no radius_mm", word(rig.kind)),
                     "give radius_mm, or radius_diameters in diameters of the cable");
}

}  // namespace

void describe(Fields& f, Rig& rig) {
  f.place(rig.where);
  f.choice("kind", rig.kind,
           "The kind of test. torsion: twist between two grips. rolling_flex: a bend of 180 deg rolls along the cable, "
           "as in an energy chain. two_pulley: a carriage with two pulleys runs along the cable (EN 50396). tick_tock: "
           "bending over two mandrels. swivel: bending at a clip. axial: pull and release.");
  f.maybe_number("length_m", rig.length, between(1e-3, 1000), "torsion: the length between the grips. Default: 1.");
  f.maybe_number("twist_deg_per_m", rig.twist, between(1e-3, 1e5), "torsion: the twist to either side.");
  f.maybe_number("radius_mm", rig.radius, between(1e-3, 1e5),
                 "rolling_flex: the bend radius of the cable's axis. tick_tock: the radius of the mandrels. "
                 "swivel: the radius of the clip's edge, by default sharp.");
  f.maybe_number("radius_diameters", rig.radius_diameters, between(1e-2, 1e4),
                 "The same radius in diameters of the cable.");
  f.maybe_number("pulley_diameter_mm", rig.pulley_diameter, between(1, 1e5),
                 "two_pulley: the diameter at the ground of the groove.");
  f.maybe_number("travel_m", rig.travel, between(1e-3, 1000),
                 "The one-way travel of the moving end (rolling_flex) or of the carriage (two_pulley, "
                 "default 1).");
  f.maybe_number("angle_deg", rig.angle, between(1e-2, 180),
                 "The angle to either side (swivel; tick_tock, default 90), or the angle of contact at each pulley "
                 "(two_pulley, default 180).");
  f.maybe_number("weight_kg", rig.weight, at_least(0),
                 "The mass that pulls on the cable. torsion: its lower end is then free to rise, and without it both "
                 "ends keep their distance. tick_tock, two_pulley: default 0.");
  f.maybe_number("elongation_percent", rig.elongation, between(1e-6, 10),
                 "axial: the elongation to either side of the mean.");
  f.maybe_number("mean_elongation_percent", rig.mean_elongation, between(-10, 10),
                 "axial: the mean elongation. Default: 0.");
  f.number("cycles_per_minute", rig.cycles_per_minute, Need::optional, between(1e-3, 1e5),
           "The rate of the test. It converts cycles into hours and has no other effect.");
}

void check_rig(Rig& rig) {
  for (const Parameter& parameter : parameters) {
    const Use use = parameter.of(rig.kind);
    const bool given = (rig.*parameter.value).has_value();
    if (given && use == Use::none)
      throw InputError(rig.where,
                       fmt::format("a rig of kind {} has no {} (it has {})", word(rig.kind), parameter.key,
                                   joined(keys_of(rig.kind), ", ")),
                       "leave it out, or choose another kind");
    if (!given && use == Use::required)
      throw InputError(rig.where, fmt::format("a rig of kind {} needs {}", word(rig.kind), parameter.key), "give it");
  }
  check_radius(rig);
  switch (rig.kind) {
    case RigKind::torsion:
      fill(rig.length, 1);
      break;
    case RigKind::two_pulley:
      fill(rig.travel, 1);
      fill(rig.angle, 180 * degree);
      fill(rig.weight, 0);
      break;
    case RigKind::tick_tock:
      fill(rig.angle, 90 * degree);
      fill(rig.weight, 0);
      break;
    case RigKind::axial:
      fill(rig.mean_elongation, 0);
      break;
    case RigKind::rolling_flex:
    case RigKind::swivel:
      break;
  }
}

double axis_radius(const Rig& rig, double diameter) {
  const double given = rig.kind == RigKind::two_pulley ? *rig.pulley_diameter / 2
                       : rig.radius                    ? *rig.radius
                                                       : *rig.radius_diameters * diameter;
  // A chain's radius is measured at the cables' axes; those of mandrel, pulley and clip at the cable's surface.
  return rig.kind == RigKind::rolling_flex ? given : given + diameter / 2;
}

BendWay bend_way(const Rig& rig, double diameter) {
  constexpr double followed = 1.25;
  BendWay way;
  switch (rig.kind) {
    case RigKind::rolling_flex:  // the bend moves by half the travel of the moving end
      way.bend = std::numbers::pi * axis_radius(rig, diameter);
      way.sweep = std::min(*rig.travel / 2, followed * way.bend);
      way.lead = way.bend / 4;
      break;
    case RigKind::two_pulley:
      way.bend = 2 * *rig.angle * axis_radius(rig, diameter);
      way.sweep = std::min(*rig.travel, followed * way.bend);
      way.lead = way.bend / 10;
      break;
    case RigKind::tick_tock:
      way.bend = *rig.angle * axis_radius(rig, diameter);
      way.lead = 2.5 * way.bend;  // conductors slide into this length
      break;
    case RigKind::torsion:
    case RigKind::swivel:
    case RigKind::axial:
      break;
  }
  return way;
}

double rig_length(const Rig& rig, double diameter) {
  constexpr double any = 0.1;  // the cable deforms equally along its whole length, so any length gives the same result
  if (rig.kind == RigKind::torsion) return *rig.length;
  const double way = bend_way(rig, diameter).length();
  return way > 0 ? way : any;
}

double clamped_length(const Rig& rig, double diameter) {
  // The length of a cable beyond its clip or mandrel is not known, and the evaluated part is an arbitrary piece of it. So its
  // parts even out over whole turns. A kilometre has many turns of any lay.
  constexpr double many_turns = 1000;
  if (rig.kind == RigKind::swivel || rig.kind == RigKind::axial || rig.kind == RigKind::tick_tock) return many_turns;
  const double evaluated = rig_length(rig, diameter);
  if (rig.kind != RigKind::rolling_flex && rig.kind != RigKind::two_pulley) return evaluated;
  const double passed = rig.kind == RigKind::rolling_flex ? *rig.travel / 2 : *rig.travel;
  return std::max(evaluated, bend_way(rig, diameter).bend + passed);
}

}  // namespace dresslife::pipeline
