#include "pipeline/job/robot.h"

#include <algorithm>
#include <set>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

std::size_t Robot::axes() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(joints, [](const Joint& joint) { return joint.follows.empty(); }));
}

std::vector<std::string> Robot::axis_names() const {
  std::vector<std::string> names;
  for (const Joint& joint : joints)
    if (joint.follows.empty()) names.push_back(joint.name);
  return names;
}

void describe(Fields& f, Joint& joint) {
  f.place(joint.where);
  f.text("name", joint.name, Need::required, "The name of the joint.");
  f.vector("origin_m", joint.origin, Need::required,
           "The origin of the joint frame in the frame of the previous link.");
  f.vector("rpy_deg", joint.orientation, Need::optional,
           "Roll, pitch and yaw of the joint frame about the fixed axes x, y, z.");
  f.vector("axis", joint.axis, Need::required, "The axis of rotation in the joint frame.");
  f.text("follows", joint.follows, Need::optional,
         "The name of the joint that moves this one through a rod. This joint then has no limits and no "
         "drive.");
  f.number("ratio", joint.ratio, Need::optional, any_number(),
           "The angle of a following joint over the angle of the other.");
  f.number("offset_deg", joint.offset, Need::optional, any_number(),
           "The angle of a following joint where the other is at 0.");
  if (!joint.follows.empty()) return;
  f.number("lower_deg", joint.lower, Need::required, any_number(), "The lowest angle.");
  f.number("upper_deg", joint.upper, Need::required, any_number(), "The highest angle.");
  f.number("speed_deg_per_s", joint.speed, Need::required, above(0), "The highest speed.");
  f.number("acceleration_deg_per_s2", joint.acceleration, Need::required, above(0), "The highest acceleration.");
  f.place_of("acceleration_deg_per_s2", joint.acceleration_where);
}

void describe(Fields& f, ExternalAxis& axis) {
  f.place(axis.where);
  f.text("name", axis.name, Need::required, "The name of the axis.");
  f.choice("kind", axis.kind, "The kind of the axis: linear or rotary.");
  f.choice("carries", axis.carries,
           "The load of the axis: the robot's base, or nothing. The latter affects only the time of a move.");
  f.vector("origin_m", axis.origin, Need::optional,
           "The origin of its frame in the world, or on the previous axis that carries the robot.");
  f.vector("rpy_deg", axis.orientation, Need::optional, "Roll, pitch and yaw of its frame.");
  f.vector("axis", axis.axis, Need::optional, "The direction of the axis in its frame.");
  const bool manual = axis.name.empty();
  if (axis.kind == ExternalAxis::Kind::linear) {
    f.number("lower_mm", axis.lower, Need::required, any_number(), "The lowest position.");
    f.number("upper_mm", axis.upper, Need::required, any_number(), "The highest position.");
    f.number("speed_mm_per_s", axis.speed, Need::required, above(0), "The highest speed.");
    f.number("acceleration_mm_per_s2", axis.acceleration, Need::required, above(0), "The highest acceleration.");
  }
  if (axis.kind == ExternalAxis::Kind::linear && !manual) return;
  const Need need = manual ? Need::optional : Need::required;
  f.number("lower_deg", axis.lower, need, any_number(), "The lowest angle of a rotary axis.");
  f.number("upper_deg", axis.upper, need, any_number(), "The highest angle of a rotary axis.");
  f.number("speed_deg_per_s", axis.speed, need, above(0), "The highest speed of a rotary axis.");
  f.number("acceleration_deg_per_s2", axis.acceleration, need, above(0), "The highest acceleration of a rotary axis.");
}

void describe(Fields& f, MountingPoint& point) {
  f.text("name", point.name, Need::required, "The name by which clamps refer to the place.");
  f.text("link", point.link, Need::required, "The link of the robot at this place.");
  f.vector("position_m", point.position, Need::required, "The position in the link's frame.");
  f.vector("direction", point.direction, Need::required,
           "The direction of the dresspack there, from base to tool, in the link's frame.");
}

void describe(Fields& f, Link& link) {
  f.text("name", link.name, Need::required, "The name of the link. Clamps refer to it.");
  f.list("capsules", link.capsules, Need::optional, "Capsules that form the link for contact with the dresspack.");
  f.list("boxes", link.boxes, Need::optional, "Boxes that form the link, in its frame.");
  f.list("meshes", link.meshes, Need::optional, "Meshes that form the link, in its frame.");
}

void describe(Fields& f, Robot& robot) {
  f.text("name", robot.name, Need::required, "The type designation.");
  f.text("source", robot.source, Need::required, "The source of the numbers.");
  f.vector("base_position_m", robot.base_position, Need::optional, "The position of the base link in the world.");
  f.vector("base_rpy_deg", robot.base_orientation, Need::optional,
           "Roll, pitch and yaw of the base link in the world.");
  f.vector("program_base_m", robot.program_base, Need::optional,
           "The origin of the frame of robot programs in the base link. For Fanuc it is at the height of "
           "axis 2.");
  f.vector("program_base_rpy_deg", robot.program_orientation, Need::optional,
           "Roll, pitch and yaw of that frame in the base link. For Universal Robots in ROS: 0, 0, 180.");
  f.vector("flange_position_m", robot.flange_position, Need::optional,
           "The position of the flange frame (tool0) in the last link.");
  f.vector("flange_rpy_deg", robot.flange_orientation, Need::optional,
           "Roll, pitch and yaw of the flange frame. Its z axis points away from the flange.");
  f.list("external_axes", robot.external_axes, Need::optional,
         "Drives beside the robot's own. Tracks under the robot come first, from the world upwards.");
  f.text("links_left_out", robot.links_left_out, Need::written,
         "The links between two tracks, whose shapes are not evaluated. dresslife writes them for a URDF.");
  f.list("joints", robot.joints, Need::required, "The axes from the base to the flange.");
  f.list("links", robot.links, Need::required, "The base link, then the link behind each joint.");
  f.list("fixed_links", robot.fixed_links, Need::optional,
         "The links under the tracks, which do not move, in the frame of the world: the bed of a track, a portal.");
  f.list("mounting_points", robot.mounting_points, Need::optional, "The places at which dresspacks can be clamped.");
}

namespace {

void check_direction(const Vector3d& axis, const std::string& name, const Where& where) {
  if (!(axis.norm() > 1e-9)) throw InputError(where, fmt::format("axis of {} is zero", name), "give its direction");
}

void check_range(double lower, double upper, const std::string& name, const Where& where) {
  if (!(lower < upper))
    throw InputError(where, fmt::format("limits of {} are empty (lower >= upper)", name), "correct them");
}

/// Refuses equal names, because a clamp or a key names a link or a joint by it.
void check_names(const auto& parts, const char* words, const Where& where, Problems& problems) {
  std::set<std::string> names;
  for (const auto& part : parts)
    if (!names.insert(part.name).second)
      problems.add(where, fmt::format("two {} of the robot are named '{}'", words, part.name),
                   "give each another name");
}

void check_joint(const Joint& joint, const Robot& robot) {
  check_direction(joint.axis, joint.name, joint.where);
  if (joint.follows.empty()) return check_range(joint.lower, joint.upper, joint.name, joint.where);
  const bool driven = std::ranges::any_of(
      robot.joints, [&](const Joint& other) { return other.name == joint.follows && other.follows.empty(); });
  if (!driven)
    throw InputError(joint.where, fmt::format("{} follows '{}', which is no driven joint", joint.name, joint.follows),
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
  check_names(robot.joints, "joints", where, problems);
  check_names(robot.links, "links", where, problems);
  for (const Joint& joint : robot.joints) problems.attempt("", joint.where, [&] { check_joint(joint, robot); });
  for (const ExternalAxis& axis : robot.external_axes)
    problems.attempt("", axis.where, [&] {
      if (axis.name.empty()) throw InputError(axis.where, "an external axis has no name", "name it");
      check_direction(axis.axis, axis.name, axis.where);
      check_range(axis.lower, axis.upper, axis.name, axis.where);
    });
  problems.finish();
}

}  // namespace dresslife::pipeline
