// Where a bracket can carry a clamp: near the surface of its link, and clear of all other links over the whole motion.
//
// (V7) bracket  g = max((b - b_most)/d, -c/d)   b: from the link's surface to the dresspack's at the clamp
//                                               b_most: the longest allowed (--bracket of dresslife-sim)
//                                               c: least distance of the dresspack at the clamp to any other link or the
//                                               cell over the motion; negative inside
//                                               d: diameter
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/job/setup.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Surfaces of all links and of the cell. A link without shapes has none, but the last one has its flange, as a point.
class Surfaces {
 public:
  /// Reads meshes. Errors: InputError for a mesh that cannot be read.
  explicit Surfaces(const pipeline::Setup& setup);
  ~Surfaces();

  /// From a point in the link's frame to its surface [m], below 0 inside of a capsule or box; at most `most`.
  double of_link(int link, const Vector3& point, double most) const;
  double of_cell(const Vector3& point, double most) const;
  bool has_shapes(int link) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// That the space of the gripper or gun is not known: half of a tool's reach and more from the flange is beyond all shapes of the
/// last link. tools: origins of the motion's tools in the flange's frame [m]. Empty: there is no such tool.
std::string gripper_note(const pipeline::Setup& setup, const std::vector<Vector3>& tools);

/// A clamp or ring on its link.
struct Carried {
  int link = 0;
  Vector3 position = Vector3::Zero();  ///< in the link's frame [m]
  double radius = 0;                   ///< of the dresspack [m]
};

struct BracketFit {
  double length = 0;           ///< b [m]; 0 on the surface, or where the link has no shapes
  double clearance = 0;        ///< c [m]; infinite: nothing is within 0.3 m
  int neighbour = -1;          ///< link that is nearest; -1: the cell
  std::size_t moment = 0;      ///< of the link poses
  double beyond(double most_length, double diameter) const;  ///< (V7)
};

/// poses: (moment, link) frames in the world.
BracketFit fit_of(const Carried& carried, const Surfaces& surfaces, std::span<const std::vector<Frame>> poses);

}  // namespace dresslife::sim
