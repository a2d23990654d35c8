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

/// A turning joint. One that follows another (a parallelogram's rod) has no drive: q = ratio q_other +
/// offset.
struct Joint {
  std::string name;
  Vector3d origin = Vector3d::Zero();       ///< in the frame of the link before [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw of the joint frame, fixed axes x, y, z [rad]
  Vector3d axis = Vector3d::UnitZ();        ///< in the joint frame
  double lower = 0, upper = 0;              ///< [rad]
  double speed = 0;                         ///< largest [rad/s]
  double acceleration = 0;                  ///< largest [rad/s2]
  std::string follows;                      ///< name of the joint whose angle moves it; empty: a driven axis
  double ratio = 1, offset = 0;             ///< of a joint that follows [1, rad]
  Where where;
  Where acceleration_where;  ///< of a robot from a URDF in the job
};

/// A drive besides the robot's axes: a track that carries the robot, or one that only takes its time.
struct ExternalAxis {
  std::string name;
  enum class Kind { linear, rotary } kind = Kind::linear;
  enum class Carries { robot, nothing } carries = Carries::robot;
  Vector3d origin = Vector3d::Zero();       ///< in the world, or on the axis before that carries [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d axis = Vector3d::UnitX();        ///< slides along or turns about it
  double lower = 0, upper = 0;              ///< [m or rad, as all below]
  double speed = 0, acceleration = 0;
  Where where;
};
constexpr std::string_view word(ExternalAxis::Kind value) { return word_at({"linear", "rotary"}, value); }
constexpr std::string_view word(ExternalAxis::Carries value) { return word_at({"robot", "nothing"}, value); }

struct Link {
  std::string name;  ///< link k > 0 is moved by joint k - 1 (counted from 0); link 0 is the base
  std::vector<Capsule> capsules;
  std::vector<Box> boxes{};
  std::vector<MeshFile> meshes{};
};

/// A place on a link to which dresspacks are clamped.
struct MountingPoint {
  std::string name, link;
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack there, base to tool
};

struct Robot {
  std::string name, source;
  Vector3d base_position = Vector3d::Zero();     ///< of link 0 in the world [m]
  Vector3d base_orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d program_base = Vector3d::Zero();  ///< origin of the frame programs are written in, in link 0 [m]
  Vector3d program_orientation = Vector3d::Zero();  ///< of that frame there: roll, pitch, yaw [rad]
  Vector3d flange_position = Vector3d::Zero();     ///< of the flange frame in the last link [m]
  Vector3d flange_orientation = Vector3d::Zero();  ///< roll, pitch, yaw; its z axis leaves the flange [rad]
  std::vector<ExternalAxis> external_axes;         ///< those that carry the robot from the world on
  std::vector<Joint> joints;                       ///< serial, from the base
  std::vector<Link> links;                         ///< joints + 1
  std::vector<MountingPoint> mounting_points;

  std::size_t axes() const;  ///< joints that follow no other
};

void describe(Fields& f, Joint& joint);
void describe(Fields& f, ExternalAxis& axis);
void describe(Fields& f, MountingPoint& point);
void describe(Fields& f, Link& link);
void describe(Fields& f, Robot& robot);

/// Errors: InputError where axes, limits and links do not fit together; `where`: the robot's key.
void check_robot(const Robot& robot, const Where& where);

}  // namespace dresslife::pipeline
