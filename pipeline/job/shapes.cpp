#include "pipeline/job/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

Eigen::Quaterniond from_roll_pitch_yaw(const Vector3d& angles) {
  return Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vector3d::UnitX());
}

double distance_from(const std::vector<Capsule>& capsules, const std::vector<Box>& boxes, const Vector3d& point) {
  double nearest = HUGE_VAL;
  for (const Capsule& capsule : capsules) {
    const Vector3d axis = capsule.to - capsule.from;
    const double square = axis.squaredNorm();
    const double share = square > 0 ? std::clamp((point - capsule.from).dot(axis) / square, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (point - capsule.from - share * axis).norm() - capsule.radius);
  }
  for (const Box& box : boxes) {
    const Vector3d local = from_roll_pitch_yaw(box.orientation).conjugate() * (point - box.position);
    const Vector3d beyond = local.cwiseAbs() - box.sides / 2;
    nearest = std::min(nearest, beyond.maxCoeff() > 0 ? beyond.cwiseMax(0).norm() : beyond.maxCoeff());
  }
  return nearest;
}

void describe(Fields& f, Capsule& capsule) {
  f.vector("from_m", capsule.from, Need::required,
           "One end of the capsule's axis, in the frame of the link or the world.");
  f.vector("to_m", capsule.to, Need::required, "The other end of the capsule's axis.");
  f.number("radius_mm", capsule.radius, Need::required, above(0), "The radius of the capsule.");
}

void describe(Fields& f, Box& box) {
  f.vector("position_m", box.position, Need::optional, "The position of the box's centre.");
  f.vector("rpy_deg", box.orientation, Need::optional, "Roll, pitch and yaw of the box.");
  f.vector("sides_m", box.sides, Need::required, "The full lengths of the box along its own axes.");
}

void describe(Fields& f, MeshFile& mesh) {
  f.path("file", mesh.file, Need::required, "A file of triangles as STL or OBJ.");
  f.number("scale", mesh.scale, Need::optional, above(0), "The metres per unit of the file: 0.001 for millimetres.");
  f.vector("position_m", mesh.position, Need::optional, "The position of the file's origin.");
  f.vector("rpy_deg", mesh.orientation, Need::optional, "Roll, pitch and yaw of the file's axes.");
}

void describe(Fields& f, Cell& cell) {
  std::optional<double> other;  // absent at the usual temperature, so that the files of such jobs do not change
  if (cell.temperature != Cell::usual_temperature) other = cell.temperature;
  f.maybe_number(
      "temperature_C", other, between(Cell::coldest, Cell::warmest),
      "The temperature of the dresspack. Polymers soften and wear faster when it rises; metals stay the same. Other "
      "temperatures are beyond the published data. Default: 23, at which most polymers are tested.");
  cell.temperature = other.value_or(Cell::usual_temperature);
  f.list("capsules", cell.capsules, Need::optional, "Posts, pipes and round edges, in the world's frame.");
  f.list("boxes", cell.boxes, Need::optional, "Tables and cabinets, in the world's frame.");
  f.list("meshes", cell.meshes, Need::optional, "Fixtures, in the world's frame.");
}

void check_boxes(const std::vector<Box>& boxes, const Where& where, double longest) {
  for (const Box& box : boxes) {
    if (!(box.sides.minCoeff() > 0))
      throw InputError(where, "a box has a side of length 0 or less", "correct its sides_m");
    if (const double side = box.sides.maxCoeff(); side > longest)
      throw InputError(where, fmt::format("a box has a side of {:.4g} m (at most {:g})", side, longest),
                       fmt::format("give sides_m in metres: {:.4g} if that was in mm", side / 1000));
  }
}

}  // namespace dresslife::pipeline
