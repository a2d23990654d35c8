// Places where a bracket can carry a clamp: near the surface of its link, and clear of all other links over the whole motion.
//
// (V7) bracket  g = max(b - b_most, -c, i)/d    b: distance from the link's surface to the dresspack's surface at the clamp
//                                               b_most: longest allowed bracket (--bracket of dresslife-sim)
//                                               c: least distance over the motion between the dresspack at the clamp and
//                                               any other link or the cell; negative inside
//                                               i: depth of the dresspack's axis in its own link, or in the adapter by which
//                                               a tool is bolted to the flange
//                                               d: diameter
// (V8) way out  kappa >= 2 p/d^2                p: depth of the dresspack in its clamp's link at d from the clamp, where the
//                                               contact with this link begins, if it goes straight on; a bend that comes out
//                                               there by a circular arc has this curvature, by other shapes a larger one
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/base/warning_words.h"
#include "pipeline/base/warnings.h"
#include "pipeline/job/setup.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Surfaces of all links and of the cell. A link without shapes has no surface; the last link without shapes has its flange, as a
/// point.
class Surfaces {
 public:
  /// Reads meshes. Errors: InputError for a mesh that cannot be read.
  explicit Surfaces(const pipeline::Setup& setup);
  ~Surfaces();

  /// Returns the distance from a point in the link's frame to its surface [m], below 0 inside a capsule, a box or a closed mesh; at
  /// most `most`.
  double of_link(int link, const Vector3& point, double most) const;
  double of_cell(const Vector3& point, double most) const;
  bool has_shapes(int link) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Returns the least distance of a clamp from the axis of the flange [m]: the radius of the flange of the smallest robots (ISO
/// 9409-1-31.5), which the adapter of every tool covers, and that of the dresspack.
inline double adapter_radius(double diameter) { return 0.02 + diameter / 2; }
/// Returns the distance of a place in the last link's frame from the axis of the flange [m]; infinite: it lies more than a diameter
/// behind the flange.
double off_flange_axis(const pipeline::Robot& robot, const Vector3& position, double diameter);

/// The space of a tool whose shape is not known.
struct ToolSpace {
  double reach = 0;  ///< distance of the tool's tip from the flange [m]
  std::string link;  ///< name of the last link
  pipeline::KeyValue
      line;  ///< key of a job and YAML of a shape between flange and tip (ESTIMATE); empty: the link has all kinds of shapes
};

/// Returns the space of the longest tool with a tip that is farther from the shapes of the last link than half of its distance from
/// the flange; absent: no such tool, or no contact with the robot. tools: origins of the motion's tools in the flange's frame [m].
std::optional<ToolSpace> unknown_tool_space(const pipeline::Setup& setup, const std::vector<Vector3>& tools);

/// Warns of tool clamps on the last link that lie inside the part of this space that every tool fills: its adapter at the flange.
std::vector<pipeline::Warning> tool_clamp_warnings(const pipeline::Setup& setup, const std::optional<ToolSpace>& space);
/// Returns way_out_warnings() and tool_clamp_warnings(): check and run give the same.
std::vector<pipeline::Warning> clamp_warnings(const pipeline::Setup& setup, const std::optional<ToolSpace>& space);

/// Returns a note about this space; empty: absent.
std::string tool_space_note(const std::optional<ToolSpace>& space);

/// Returns the curvature of the way out of the clamp's link (V8) [1/m]; 0: it is outside. out: direction of the dresspack away from
/// the clamp.
double way_out(const Surfaces& surfaces, int link, const Vector3& position, const Vector3& out, double diameter);

/// The way of a dresspack out of the link of a clamp. An intermediate clamp has two.
struct WayOut {
  std::size_t dresspack = 0;
  const pipeline::Clamp* clamp = nullptr;
  std::string key;       ///< "routing.base_clamp"
  double curvature = 0;  ///< as way_out()
};

/// Returns the ways out of all links with shapes; empty without contact.
std::vector<WayOut> ways_out(const pipeline::Setup& setup, const Surfaces& surfaces);

/// Warns of clamps whose dresspack cannot come out of the clamp's link within its bend radius, whatever the mesh. Without contact: none.
std::vector<pipeline::Warning> way_out_warnings(const pipeline::Setup& setup);

/// A clamp or ring on its link.
struct BracketPlace {
  int link = 0;
  Vector3 position = Vector3::Zero();  ///< in the link's frame [m]
  double radius = 0;                   ///< of the dresspack [m]
};

struct BracketFit {
  double inside = 0;       ///< depth of the dresspack in the link itself [m]; 0: outside
  double unbuildable = 0;  ///< i [m]; below 0 outside
  double length = 0;       ///< b [m]; 0 on the surface, or if the link has no shapes
  double clearance = 0;    ///< c [m]; infinite: no object within 0.3 m
  int neighbour = -1;      ///< nearest link; -1: the cell
  std::size_t moment = 0;  ///< index of the link poses
  double beyond(double most_length, double diameter) const;  ///< (V7)
};

/// Returns the fit of a bracket. poses: (moment, link) frames in the world.
BracketFit fit_of(const BracketPlace& place, const pipeline::Robot& robot, const Surfaces& surfaces,
                  std::span<const std::vector<Frame>> poses);

}  // namespace dresslife::sim
