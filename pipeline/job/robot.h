// The robot: its axes with their limits and drives, its links with their shapes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/job/shapes.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// A rotary joint. A joint that follows another one (the rod of a parallelogram) has no drive: q = ratio q_other + offset.
struct Joint {
  std::string name;
  Vector3d origin = Vector3d::Zero();       ///< in the frame of the preceding link [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw of the joint frame, fixed axes x, y, z [rad]
  Vector3d axis = Vector3d::UnitZ();        ///< in the joint frame
  double lower = 0, upper = 0;              ///< [rad]
  double speed = 0;                         ///< largest [rad/s]
  double acceleration = 0;                  ///< largest [rad/s2]
  std::string follows;                      ///< name of the joint that it follows; empty: a driven axis
  double ratio = 1, offset = 0;             ///< of a joint that follows [1, rad]
  Where where;
  Where acceleration_where;  ///< for a robot that a job reads from a URDF
};

/// A drive in addition to the robot's axes: a track that carries the robot, or an axis that only affects timing.
struct ExternalAxis {
  std::string name;
  enum class Kind { linear, rotary } kind = Kind::linear;
  enum class Carries { robot, nothing } carries = Carries::robot;
  Vector3d origin = Vector3d::Zero();       ///< in the world, or on the preceding axis that carries the robot [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d axis = Vector3d::UnitX();        ///< direction of sliding or axis of rotation
  double lower = 0, upper = 0;              ///< [m or rad, also speed and acceleration]
  double speed = 0, acceleration = 0;
  Where where;
};
constexpr std::string_view word(ExternalAxis::Kind value) { return word_at({"linear", "rotary"}, value); }
constexpr std::string_view word(ExternalAxis::Carries value) { return word_at({"robot", "nothing"}, value); }

struct Link {
  std::string name;  ///< joint k - 1 (counted from 0) moves link k > 0; link 0 is the base
  std::vector<Capsule> capsules;
  std::vector<Box> boxes{};
  std::vector<MeshFile> meshes{};
};

/// A place on a link to which dresspacks are clamped.
struct MountingPoint {
  std::string name, link;
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack at this point, base to tool
};

struct Robot {
  std::string name, source;
  Vector3d base_position = Vector3d::Zero();        ///< of link 0 in the world [m]
  Vector3d base_orientation = Vector3d::Zero();     ///< roll, pitch, yaw [rad]
  Vector3d program_base = Vector3d::Zero();         ///< origin of the programs' base frame, in link 0 [m]
  Vector3d program_orientation = Vector3d::Zero();  ///< of that frame in link 0: roll, pitch, yaw [rad]
  Vector3d flange_position = Vector3d::Zero();      ///< of the flange frame in the last link [m]
  Vector3d flange_orientation = Vector3d::Zero();   ///< roll, pitch, yaw; the z axis points away from the flange [rad]
  std::vector<ExternalAxis> external_axes;          ///< axes that carry the robot, from the world on
  std::vector<Link> fixed_links;                    ///< before the tracks, in the frame of the world
  std::string links_left_out;                       ///< between two tracks, without their shapes: "bridge"; empty: none
  std::vector<Joint> joints;                        ///< serial, from the base
  std::vector<Link> links;                          ///< joints + 1
  std::vector<MountingPoint> mounting_points;

  std::size_t axes() const;                     ///< Returns the number of joints that follow no other joint.
  std::vector<std::string> axis_names() const;  ///< Returns their names.
};

void describe(Fields& f, Joint& joint);
void describe(Fields& f, ExternalAxis& axis);
void describe(Fields& f, MountingPoint& point);
void describe(Fields& f, Link& link);
void describe(Fields& f, Robot& robot);

/// Errors: InputErrors if axes, limits and links do not fit together; `where`: place of the robot's key.
void check_robot(const Robot& robot, const Where& where);

}  // namespace dresslife::pipeline
