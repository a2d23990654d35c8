// Shapes that a dresspack can touch: robot links and the cell around the robot.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

using Eigen::Vector3d;

/// Returns the rotation of roll, pitch, yaw about the fixed axes x, y, z [rad]: roll first, then pitch, then yaw.
Eigen::Quaterniond from_roll_pitch_yaw(const Vector3d& angles);

struct Capsule {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();  ///< ends of its axis, in the link's frame [m]
  double radius = 0;                                        ///< [m]
};

struct Box {
  Vector3d position = Vector3d::Zero();     ///< of its centre, in the link's frame [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d sides = Vector3d::Zero();        ///< full lengths along its own axes [m]
};

struct MeshFile {
  std::filesystem::path file;               ///< STL or OBJ
  double scale = 1;                         ///< metres per unit of the file
  Vector3d position = Vector3d::Zero();     ///< of the file's origin, in the link's frame [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
};

/// Fixed objects around the robot, in the world's frame, and the air temperature.
struct Cell {
  static constexpr double usual_temperature = 23;      ///< [C], temperature of most tests of polymers (ISO 291)
  static constexpr double coldest = 10, warmest = 60;  ///< [C], range of the law in pipeline/cable/warmth.h
  double temperature = usual_temperature;              ///< [C]
  std::vector<Capsule> capsules;
  std::vector<Box> boxes;
  std::vector<MeshFile> meshes;
};

/// Returns the distance of a point in the shapes' frame from the nearest surface [m]; negative: depth inside; HUGE_VAL: no shapes.
double distance_from(const std::vector<Capsule>& capsules, const std::vector<Box>& boxes, const Vector3d& point);

void describe(Fields& f, Capsule& capsule);
void describe(Fields& f, Box& box);
void describe(Fields& f, MeshFile& mesh);
void describe(Fields& f, Cell& cell);

/// Errors: InputError at `where` for a box without volume, or with a side above `longest` [m].
void check_boxes(const std::vector<Box>& boxes, const Where& where, double longest);

}  // namespace dresslife::pipeline
