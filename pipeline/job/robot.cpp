#include "pipeline/job/robot.h"

#include <algorithm>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

std::size_t Robot::axes() const {
  return static_cast<std::size_t>(
      std::count_if(joints.begin(), joints.end(), [](const Joint& joint) { return joint.follows.empty(); }));
}

void describe(Fields& f, Joint& joint) {
  f.place(joint.where);
  f.text("name", joint.name, Need::required, "name of the joint");
  f.vector("origin_m", joint.origin, Need::required,
           "origin of the joint frame in the frame of the link before");
  f.vector("rpy_deg", joint.orientation, Need::optional,
           "roll, pitch, yaw of the joint frame, fixed axes x, y, z");
  f.vector("axis", joint.axis, Need::required, "axis of rotation in the joint frame");
  f.text("follows", joint.follows, Need::optional,
         "name of the joint that moves this one through a rod; it has then no limits and drive of its own");
  f.number("ratio", joint.ratio, Need::optional, any_number(),
           "of a joint that follows: its angle over the other's");
  f.number("offset_deg", joint.offset, Need::optional, any_number(),
           "of a joint that follows: its angle at 0");
  if (!joint.follows.empty()) return;
  f.number("lower_deg", joint.lower, Need::required, any_number(), "lowest angle");
  f.number("upper_deg", joint.upper, Need::required, any_number(), "highest angle");
  f.number("speed_deg_per_s", joint.speed, Need::required, above(0), "highest speed");
  f.number("acceleration_deg_per_s2", joint.acceleration, Need::required, above(0), "highest acceleration");
}

void describe(Fields& f, ExternalAxis& axis) {
  f.place(axis.where);
  f.text("name", axis.name, Need::required, "name of the axis");
  f.choice("kind", axis.kind, "slides along, or turns about its axis");
  f.choice("carries", axis.carries,
           "what it moves: the robot's base, or nothing that matters here but the time that it takes");
  f.vector("origin_m", axis.origin, Need::optional,
           "of its frame in the world, or on the axis before that carries");
  f.vector("rpy_deg", axis.orientation, Need::optional, "roll, pitch, yaw of its frame");
  f.vector("axis", axis.axis, Need::optional, "its direction in its frame");
  const bool manual = axis.name.empty();
  if (axis.kind == ExternalAxis::Kind::linear) {
    f.number("lower_mm", axis.lower, Need::required, any_number(), "lowest position");
    f.number("upper_mm", axis.upper, Need::required, any_number(), "highest position");
    f.number("speed_mm_per_s", axis.speed, Need::required, above(0), "highest speed");
    f.number("acceleration_mm_per_s2", axis.acceleration, Need::required, above(0), "highest acceleration");
  }
  if (axis.kind == ExternalAxis::Kind::linear && !manual) return;
  const Need need = manual ? Need::optional : Need::required;
  f.number("lower_deg", axis.lower, need, any_number(), "of a rotary axis, likewise");
  f.number("upper_deg", axis.upper, need, any_number(), "likewise");
  f.number("speed_deg_per_s", axis.speed, need, above(0), "likewise");
  f.number("acceleration_deg_per_s2", axis.acceleration, need, above(0), "likewise");
}

void describe(Fields& f, MountingPoint& point) {
  f.text("name", point.name, Need::required, "by which clamps refer to it");
  f.text("link", point.link, Need::required, "link of the robot that carries it");
  f.vector("position_m", point.position, Need::required, "in the link's frame");
  f.vector("direction", point.direction, Need::required,
           "of the dresspack there, from base to tool, in the link's frame");
}

void describe(Fields& f, Link& link) {
  f.text("name", link.name, Need::required, "name of the link, by which clamps refer to it");
  f.list("capsules", link.capsules, Need::optional, "shape of the link for contact with the dresspack");
  f.list("boxes", link.boxes, Need::optional, "more of its shape, in the link's frame");
  f.list("meshes", link.meshes, Need::optional, "more of its shape, in the link's frame");
}

void describe(Fields& f, Robot& robot) {
  f.text("name", robot.name, Need::required, "type designation");
  f.text("source", robot.source, Need::required, "where the numbers come from");
  f.vector("base_position_m", robot.base_position, Need::optional, "of the base link in the world");
  f.vector("base_rpy_deg", robot.base_orientation, Need::optional,
           "roll, pitch, yaw of the base link in the world");
  f.vector("program_base_m", robot.program_base, Need::optional,
           "origin of the frame that robot programs are written in, in the base link (Fanuc: at the height "
           "of axis 2)");
  f.vector("program_base_rpy_deg", robot.program_orientation, Need::optional,
           "roll, pitch, yaw of that frame in the base link (Universal Robots in ROS: 0, 0, 180)");
  f.vector("flange_position_m", robot.flange_position, Need::optional,
           "of the flange frame (tool0) in the last link");
  f.vector("flange_rpy_deg", robot.flange_orientation, Need::optional,
           "its roll, pitch, yaw; z leaves the flange");
  f.list("external_axes", robot.external_axes, Need::optional,
         "drives besides the robot's own; tracks under it from the world on");
  f.list("joints", robot.joints, Need::required, "the axes, from the base to the flange");
  f.list("links", robot.links, Need::required, "base link first, then the link that each joint moves");
  f.list("mounting_points", robot.mounting_points, Need::optional, "places to which dresspacks are clamped");
}

namespace {

void check_direction(const Vector3d& axis, const std::string& name, const Where& where) {
  if (!(axis.norm() > 1e-9))
    throw InputError(where, fmt::format("axis of {} is zero", name), "give its direction");
}

void check_range(double lower, double upper, const std::string& name, const Where& where) {
  if (!(lower < upper))
    throw InputError(where, fmt::format("limits of {} are empty (lower >= upper)", name), "mend them");
}

void check_joint(const Joint& joint, const Robot& robot) {
  check_direction(joint.axis, joint.name, joint.where);
  if (joint.follows.empty()) return check_range(joint.lower, joint.upper, joint.name, joint.where);
  const bool driven = std::any_of(robot.joints.begin(), robot.joints.end(), [&](const Joint& other) {
    return other.name == joint.follows && other.follows.empty();
  });
  if (!driven)
    throw InputError(joint.where,
                     fmt::format("{} follows '{}', which is no driven joint", joint.name, joint.follows),
                     "name a joint that follows no other");
}

}  // namespace

void check_robot(const Robot& robot, const Where& where) {
  Problems problems;
  if (robot.links.size() != robot.joints.size() + 1)
    problems.add(where,
                 fmt::format("robot has {} joints and {} links (must be one link more)", robot.joints.size(),
                             robot.links.size()),
                 "list the base link and one link per joint");
  for (const Joint& joint : robot.joints)
    problems.attempt("", joint.where, [&] { check_joint(joint, robot); });
  for (const ExternalAxis& axis : robot.external_axes)
    problems.attempt("", axis.where, [&] {
      if (axis.name.empty()) throw InputError(axis.where, "an external axis has no name", "name it");
      check_direction(axis.axis, axis.name, axis.where);
      check_range(axis.lower, axis.upper, axis.name, axis.where);
    });
  problems.finish();
}

}  // namespace dresslife::pipeline
