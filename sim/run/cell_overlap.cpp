#include "sim/run/cell_overlap.h"

#include <fmt/format.h>

#include "pipeline/base/warning_words.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {
namespace {

constexpr double largest_depth = 0.05;   // [m]
constexpr int moments = 100, parts = 8;  // of the motion, of a capsule's axis: a few centimetres

/// How far a ball reaches into a box: its radius and more, if its centre is inside [m].
double depth_in(const pipeline::Box& box, const Vector3& centre, double radius) {
  const Vector3 at = pipeline::from_roll_pitch_yaw(box.orientation).conjugate() * (centre - box.position);
  const Vector3 beyond = at.cwiseAbs() - box.sides / 2;
  const double largest = beyond.maxCoeff();
  return radius - (largest <= 0 ? largest : beyond.cwiseMax(0).norm());
}

}  // namespace

std::vector<pipeline::Warning> overlaps_with_cell(const pipeline::Setup& setup, const RobotPath& path) {
  std::vector<pipeline::Warning> warnings;
  for (std::size_t b = 0; b < setup.cell.boxes.size(); ++b) {
    double deepest = largest_depth, when = 0;
    std::string link;
    for (int moment = 0; moment < moments; ++moment) {
      const double time = path.duration() * moment / moments;
      const std::vector<Frame> frames = path.at(time).links;
      for (std::size_t l = 1; l < frames.size(); ++l)
        for (const pipeline::Capsule& capsule : setup.robot.links[l].capsules)
          for (int part = 0; part <= parts; ++part) {
            const Vector3 local = capsule.from + (capsule.to - capsule.from) * part / parts;
            const double depth = depth_in(setup.cell.boxes[b],
                                          frames[l].position + frames[l].orientation * local, capsule.radius);
            if (depth > deepest) deepest = depth, when = time, link = setup.robot.links[l].name;
          }
    }
    if (link.empty()) continue;
    const Vector3 centre = setup.cell.boxes[b].position + setup.cell.boxes[b].sides / 2;
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::motion, "",
        fmt::format("{} enters cell.boxes[{}] by {:.0f} mm after {:.1f} s (limit {:.0f} mm)", link, b + 1,
                    1e3 * deepest, when, 1e3 * largest_depth),
        "a corner instead of the centre as position_m, another frame than the world, or another unit",
        fmt::format("position_m: [{:.4g}, {:.4g}, {:.4g}] if that was its lowest corner", centre.x(),
                    centre.y(), centre.z())));
  }
  return warnings;
}

}  // namespace dresslife::sim
