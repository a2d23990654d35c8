#include "pipeline/job/shapes.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

Eigen::Quaterniond from_roll_pitch_yaw(const Vector3d& angles) {
  return Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vector3d::UnitX());
}

void describe(Fields& f, Capsule& capsule) {
  f.vector("from_m", capsule.from, Need::required, "one end of the capsule's axis, in the link's frame");
  f.vector("to_m", capsule.to, Need::required, "the other end");
  f.number("radius_mm", capsule.radius, Need::required, above(0), "radius of the capsule");
}

void describe(Fields& f, Box& box) {
  f.vector("position_m", box.position, Need::optional, "of the box's centre");
  f.vector("rpy_deg", box.orientation, Need::optional, "roll, pitch, yaw of the box");
  f.vector("sides_m", box.sides, Need::required, "its full lengths along its own axes");
}

void describe(Fields& f, MeshFile& mesh) {
  f.path("file", mesh.file, Need::required, "triangles as STL or OBJ");
  f.number("scale", mesh.scale, Need::optional, above(0),
           "metres per unit of the file: 0.001 for millimetres");
  f.vector("position_m", mesh.position, Need::optional, "of the file's origin");
  f.vector("rpy_deg", mesh.orientation, Need::optional, "roll, pitch, yaw of the file's axes");
}

void describe(Fields& f, Cell& cell) {
  f.list("capsules", cell.capsules, Need::optional, "posts, pipes and round edges, in the world's frame");
  f.list("boxes", cell.boxes, Need::optional, "tables and cabinets, in the world's frame");
  f.list("meshes", cell.meshes, Need::optional, "fixtures, in the world's frame");
}

void check_boxes(const std::vector<Box>& boxes, const Where& where) {
  for (const Box& box : boxes)
    if (!(box.sides.minCoeff() > 0))
      throw InputError(where, "a box has a side of length 0 or less", "mend its sides_m");
}

}  // namespace dresslife::pipeline
