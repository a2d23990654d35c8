#include "pipeline/job/routing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, BendRelief& relief) {
  constexpr double stiffest = 1e6;  // [N m2] a steel bar of 100 mm diameter
  f.number("length_mm", relief.length, Need::required, at_least(0),
           "The length of the relief from the clamp. At most half the dresspack between two clamps.");
  f.number(
      "bending_stiffness_Nm2", relief.stiffness, Need::required, between(0, stiffest),
      "The bending stiffness of the sleeve or spring without the dresspack. A relief as stiff as the dresspack helps. "
      "A much stiffer one moves the bend to its end.");
}

void describe(Fields& f, Clamp& clamp) {
  f.place(clamp.where);
  f.text(
      "mounting_point", clamp.mounting_point, Need::optional,
      "The name of a mounting point of the robot, instead of link, position_m and direction. A position_m or direction beside it "
      "replaces the point's.");
  const Need need = clamp.mounting_point.empty() ? Need::required : Need::optional;
  f.text("link", clamp.link, need, "The link of the robot with the clamp.");
  f.vector("position_m", clamp.position, need, "The position of the clamp in the link's frame.");
  f.vector("direction", clamp.direction, need,
           "The direction of the dresspack there, from base to tool, in the link's frame.");
  f.maybe_number("roll_deg", clamp.roll, between(-360, 360),
                 "The angle of the clamp about the direction. Default: 0 at the base clamp, and the angle "
                 "without twist at the others.");
  f.maybe_group(
      "bend_relief", clamp.bend_relief,
      "A sleeve or spring that makes the dresspack stiffer beside the clamp, on its free side. Default: none.");
}

void describe(Fields& f, IntermediateClamp& between) {
  describe(f, between.clamp);
  f.number("at_length_m", between.at_length, Need::required, above(0),
           "The unstretched length of the dresspack from the base clamp to this one.");
}

void describe(Fields& f, GuideRing& ring) {
  f.place(ring.where);
  f.text("link", ring.link, Need::required, "The link of the robot with the ring.");
  f.vector("position_m", ring.position, Need::required, "The position of the ring's centre in the link's frame.");
  f.vector("direction", ring.direction, Need::required,
           "The direction of the ring's axis, from base to tool, in the link's frame.");
  f.number("radius_mm", ring.radius, Need::required, above(0), "The clear inner radius.");
  f.number("friction_coefficient", ring.friction, Need::optional, between(0, 2),
           "The Coulomb friction of the dresspack on the ring.");
  f.number("width_mm", ring.width, Need::optional, at_least(0),
           "The width of the ring along its axis. Both edges guide the dresspack.");
  f.maybe_number("at_length_m", ring.at_length, above(0),
                 "The length of dresspack from the base clamp to the ring when mounted. Default: all pieces have the "
                 "same relative slack.");
}

void describe(Fields& f, Retraction& retraction) {
  f.place(retraction.where);
  f.number("force_N", retraction.force, Need::required, at_least(0),
           "The force that pulls the base clamp back against its direction in the retracted position.");
  f.number("spring_N_per_m", retraction.spring, Need::optional, at_least(0), "The additional force per distance.");
  f.number("stroke_m", retraction.stroke, Need::required, above(0),
           "The largest distance along the direction of the clamp.");
  f.number("damping_Ns_per_m", retraction.damping, Need::optional, at_least(0),
           "The viscous damping of the sliding clamp.");
  f.number("friction_N", retraction.friction, Need::optional, at_least(0),
           "The Coulomb friction of the sliding clamp.");
  f.number("mass_kg", retraction.mass, Need::optional, above(0),
           "The mass that slides with the clamp, without the dresspack between the clamps.");
}

void describe(Fields& f, Routing& routing) {
  f.place(routing.where);
  f.number("free_length_m", routing.free_length, Need::required, above(0),
           "The free length of the dresspack between the clamps.");
  f.maybe_group("base_clamp", routing.base_clamp, "The clamp nearer to the robot's base.");
  f.maybe_group("tool_clamp", routing.tool_clamp, "The clamp nearer to the tool.");
  f.list("clamps", routing.clamps, Need::optional,
         "Further clamps between the two, in their order along the dresspack. They fix its place, direction "
         "and twist.");
  f.list("rings", routing.rings, Need::optional,
         "Guide rings in which the dresspack slides and turns, in their order along it.");
  f.maybe_group("retraction", routing.retraction,
                "A spring return: the base clamp slides along its direction and a spring pulls it back.");
  f.number("pre_twist_deg", routing.pre_twist, Need::optional, between(-36000, 36000),
           "The angle by which the tool clamp is turned when it is mounted, in addition to its roll_deg.");
  f.choice("tool_end", routing.tool_end,
           "The end at the tool. free: the dresspack hangs from its last clamp, without a tool_clamp.");
  f.number("tool_mass_kg", routing.tool_mass, Need::optional, at_least(0),
           "The mass at the end of a dresspack whose tool_end is free.");
  f.choice(
      "side", routing.side,
      "The side to which the dresspack bulges when it is mounted, seen from the base clamp to the tool clamp: left or right. "
      "Between clamps that lie in one plane with the arm it can rest on both, and may keep this side for the whole program. "
      "either: the left side if both are alike.");
  f.numbers("mounting_pose_deg", routing.mounting_pose, Need::optional,
            "The joint angles at which the dresspack was clamped without twist. Default: the first target. "
            "It is one pose for all dresspacks. For joint_3 of a Fanuc robot add J3 and J2 of the pendant.");
  f.maybe_number(
      "longest_bracket_mm", routing.longest_bracket, between(0, 10'000),
      "The longest bracket that can be built between a link's surface and a clamp or ring. Default: 150. route and "
      "improve keep it, and the preview draws longer ones red.");
}

namespace {

/// Replaces a mounting point by its link, position and direction.
void place_clamp(Clamp& clamp, const Robot& robot) {
  if (clamp.mounting_point.empty()) return;
  if (!clamp.link.empty())
    throw InputError(clamp.where, "a clamp has both a mounting_point and a link", "keep one of the two");
  std::vector<std::string> names;
  for (const MountingPoint& point : robot.mounting_points) {
    names.push_back(point.name);
    if (point.name != clamp.mounting_point) continue;
    clamp.link = point.link;
    // A position or direction beside the point was set by improve, route or a mounting tolerance. It has priority, so that a
    // search has an effect.
    if (clamp.position == Clamp{}.position) clamp.position = point.position;
    if (clamp.direction == Clamp{}.direction) clamp.direction = point.direction;
    clamp.mounting_point.clear();
    return;
  }
  throw InputError(clamp.where, fmt::format("the robot has no mounting point '{}'", clamp.mounting_point),
                   names.empty() ? "give link, position_m and direction of the clamp"
                                 : fmt::format("one of: {}", joined(names, ", ")));
}

/// Checks the place of a clamp or a ring.
template <class Place>
void check_place(const Place& place, const std::string& name, const Robot& robot) {
  constexpr double farthest =
      30;  // [m] from a link's frame: more than the size of a cell, so the value was in millimetres
  if (!(place.direction.norm() > 1e-9))
    throw InputError(place.where, fmt::format("routing.{}.direction is zero", name), "give where the dresspack points");
  if (!(place.position.norm() <= farthest))
    throw InputError(place.where,
                     fmt::format("routing.{}.position_m is {:.4g} m away from the frame of {} (at most {:g})", name,
                                 place.position.norm(), place.link, farthest),
                     "give it in metres, in the link's frame");
  if (!find_in(robot.links, &Link::name, place.link))
    throw InputError(place.where, fmt::format("routing.{}.link '{}' is not a link of the robot", name, place.link),
                     fmt::format("one of: {}", joined(mapped(robot.links, &Link::name), ", ")));
}

void check_clamp(const std::optional<Clamp>& clamp, const std::string& name, const Routing& routing,
                 const Robot& robot) {
  if (!clamp)
    throw InputError(routing.where, fmt::format("routing.{} is missing", name),
                     "give link, position_m and direction of the clamp");
  check_place(*clamp, name, robot);
}

/// Refuses keys that need a robot if the motion is recorded poses.
void check_robot_only(const Routing& routing) {
  const auto refuse = [&](bool given, const char* key, const Where& where) {
    if (given)
      throw InputError(where, fmt::format("routing.{} needs a robot (motion.clamp_poses brings two poses only)", key),
                       "describe the motion by a robot, or leave it out");
  };
  if (!routing.clamps.empty()) refuse(true, "clamps", routing.clamps.front().clamp.where);
  if (!routing.rings.empty()) refuse(true, "rings", routing.rings.front().where);
  if (routing.retraction) refuse(true, "retraction", routing.retraction->where);
  refuse(!is_clamped(routing.tool_end), "tool_end: free", routing.where);
  refuse(routing.pre_twist != 0, "pre_twist_deg", routing.where);
}

void check_rings(const Routing& routing, double diameter, const Robot& robot, Problems& problems) {
  double before = 0;
  for (std::size_t k = 0; k < routing.rings.size(); ++k) {
    const GuideRing& ring = routing.rings[k];
    const std::string name = fmt::format("rings[{}]", k + 1);
    problems.attempt("", ring.where, [&] { check_place(ring, name, robot); });
    if (2 * ring.radius <= diameter)
      problems.add(ring.where,
                   fmt::format("routing.{}.radius_mm is {} (the dresspack's own radius is {} mm)", name,
                               1e3 * ring.radius, 1e3 * diameter / 2),
                   "take a wider ring");
    if (!ring.at_length) continue;
    if (!(*ring.at_length > before && *ring.at_length < routing.free_length))
      problems.add(ring.where,
                   fmt::format("routing.{}.at_length_m is {} (must lie between {} and {}, the ring or clamp before "
                               "it and the dresspack's end)",
                               name, *ring.at_length, before, routing.free_length),
                   "list the rings in their order along the dresspack");
    before = *ring.at_length;
  }
  if (!routing.rings.empty() && !routing.clamps.empty())
    for (const GuideRing& ring : routing.rings)
      if (!ring.at_length)
        problems.add(ring.where, "a ring beside routing.clamps has no at_length_m (its place between the clamps)",
                     "give the length of dresspack from the base clamp to the ring");
}

void check_intermediate_clamps(const Routing& routing, const Robot& robot, Problems& problems) {
  double before = 0;
  for (std::size_t k = 0; k < routing.clamps.size(); ++k) {
    const auto& [clamp, at_length] = routing.clamps[k];
    problems.attempt("", clamp.where,
                     [&, &clamp = clamp] { check_clamp(clamp, fmt::format("clamps[{}]", k + 1), routing, robot); });
    if (!(at_length > before && at_length < routing.free_length))
      problems.add(clamp.where,
                   fmt::format("routing.clamps[{}].at_length_m is {} (must lie between {} and {}, the clamps "
                               "before and after it)",
                               k + 1, at_length, before, routing.free_length),
                   "list the clamps in their order along the dresspack");
    before = at_length;
  }
}

/// Checks that each relief ends within its half of the piece between two clamps.
void check_bend_reliefs(const Routing& routing, Problems& problems) {
  double begin = 0;
  const Clamp* before = routing.base_clamp ? &*routing.base_clamp : nullptr;
  const auto check_piece = [&](double end, const Clamp* after) {
    for (const Clamp* const clamp : {before, after})
      if (clamp && clamp->bend_relief && begin < end && clamp->bend_relief->length > (end - begin) / 2)
        problems.add(
            clamp->where,
            fmt::format(
                "bend_relief.length_mm is {:.5g} (at most {:.5g}, half the dresspack between this clamp and the next)",
                1e3 * clamp->bend_relief->length, 5e2 * (end - begin)),
            "give the length from the clamp's edge to the end of the sleeve");
    begin = end, before = after;
  };
  for (const IntermediateClamp& between : routing.clamps) check_piece(between.at_length, &between.clamp);
  check_piece(routing.free_length, routing.tool_clamp ? &*routing.tool_clamp : nullptr);
}

}  // namespace

void place_clamps(Routing& routing, const Robot& robot) {
  Problems problems;
  const auto place = [&](Clamp& clamp) { problems.attempt("", clamp.where, [&] { place_clamp(clamp, robot); }); };
  for (std::optional<Clamp>* clamp : {&routing.base_clamp, &routing.tool_clamp})
    if (*clamp) place(**clamp);
  for (IntermediateClamp& between : routing.clamps) place(between.clamp);
  problems.finish();
}

BendRelief first_relief(double diameter, double stiffness, double segment) {
  constexpr double diameters = 3, rounding = 1e-9;
  const double length = std::max(diameters * diameter, fewest_relief_segments * segment);
  return {std::ceil(1e3 * length - rounding) / 1e3, std::stod(fmt::format("{:.3g}", stiffness))};
}

std::string relief_text(const BendRelief& relief) {
  return fmt::format("{{length_mm: {:.6g}, bending_stiffness_Nm2: {:.6g}}}", 1e3 * relief.length, relief.stiffness);
}

std::string between_clamps(const Routing& routing, std::size_t piece) {
  const std::size_t between = routing.clamps.size();
  if (between == 0) return "";
  const auto name = [&](std::size_t clamp) {
    if (clamp == 0) return std::string("the base clamp");
    if (clamp <= between) return fmt::format("clamp {}", clamp);
    return std::string(is_clamped(routing.tool_end) ? "the tool clamp" : "the free end");
  };
  return fmt::format(" between {} and {}", name(piece), name(piece + 1));
}

std::vector<std::array<BendRelief, 2>> bend_reliefs(const Routing& routing) {
  const auto of = [](const std::optional<Clamp>& clamp) {
    return clamp ? clamp->bend_relief.value_or(BendRelief{}) : BendRelief{};
  };
  std::vector<std::array<BendRelief, 2>> reliefs{{of(routing.base_clamp), {}}};
  for (const IntermediateClamp& between : routing.clamps) {
    reliefs.back()[1] = of(between.clamp);
    reliefs.push_back({of(between.clamp), {}});
  }
  reliefs.back()[1] = of(routing.tool_clamp);
  return reliefs;
}

void check_routing(const Routing& routing, double diameter, const Robot& robot, bool recorded) {
  Problems problems;
  const auto attempt = [&](const auto& check) { problems.attempt("", routing.where, check); };
  if (!recorded) {
    attempt([&] { check_clamp(routing.base_clamp, "base_clamp", routing, robot); });
    if (is_clamped(routing.tool_end)) attempt([&] { check_clamp(routing.tool_clamp, "tool_clamp", routing, robot); });
  } else if (routing.base_clamp || routing.tool_clamp) {
    problems.add(routing.where, "clamps are given although motion.clamp_poses brings their poses",
                 "keep one of the two");
  }
  if (recorded) attempt([&] { check_robot_only(routing); });
  check_intermediate_clamps(routing, robot, problems);
  check_rings(routing, diameter, robot, problems);
  check_bend_reliefs(routing, problems);
  if (!is_clamped(routing.tool_end) && routing.tool_clamp)
    problems.add(routing.tool_clamp->where, "routing.tool_clamp is given although routing.tool_end is free",
                 "keep one of the two");
  if (!is_clamped(routing.tool_end) && routing.pre_twist != 0)
    problems.add(routing.where, "routing.pre_twist_deg is given although routing.tool_end is free",
                 "keep one of the two");
  if (routing.tool_mass > 0 && is_clamped(routing.tool_end))
    problems.add(routing.where, "routing.tool_mass_kg is given although the tool end is clamped",
                 "add tool_end: free, or leave the mass out");
  if (!routing.mounting_pose.empty() && routing.mounting_pose.size() != robot.axes())
    problems.add(routing.where,
                 fmt::format("mounting_pose_deg has {} angles (the robot has {} axes)", routing.mounting_pose.size(),
                             robot.axes()),
                 "give one angle per axis");
  problems.finish();
}

}  // namespace dresslife::pipeline
