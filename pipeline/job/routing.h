// The routing: where the dresspack is clamped and guided, and how long it is in between.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/job/bracket.h"
#include "pipeline/job/robot.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// A sleeve or spring around the dresspack beside a clamp, on its free side (both sides of a clamp between the ends): it makes
/// the dresspack stiffer in bending there (S24). Without a length or a stiffness it does nothing.
struct BendRelief {
  double length = 0;     ///< from the clamp [m]
  double stiffness = 0;  ///< beside the dresspack's own [N m2]
};

struct Clamp {
  std::string link;                        ///< of the robot
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack there, base to tool, in the link's frame
  std::optional<double> roll;  ///< about the direction [rad]; absent: 0 at the base clamp, else twist-free
  Where where;
  std::string mounting_point{};  ///< of the robot, instead of link, position, direction; empty once read
  std::optional<BendRelief> bend_relief{};
};

/// A clamp between the two ends: the dresspack is gripped there, in position, direction and twist.
struct IntermediateClamp {
  Clamp clamp;
  double at_length = 0;  ///< of the dresspack from the base clamp, unstretched [m]
};

/// A ring through which the dresspack slides and turns.
struct GuideRing {
  std::string link;
  Vector3d position = Vector3d::Zero();    ///< of its centre, in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of its axis, base to tool, in the link's frame
  double radius = 0;                       ///< clear inner [m]
  double friction = 0;                     ///< Coulomb
  double width = 0;                        ///< along its axis: a short tube [m]
  std::optional<double> at_length;         ///< of dresspack from the base clamp to the ring when mounted [m]
  Where where;
};

/// Spring-returned slack: the base clamp slides along its direction and is pulled back.
struct Retraction {
  double force = 0;     ///< at travel 0 [N]
  double spring = 0;    ///< more per way pulled out [N/m]
  double stroke = 0;    ///< [m]
  double damping = 0;   ///< [N s/m]
  double friction = 0;  ///< Coulomb [N]
  double mass = 1;      ///< of what slides, without the hose between the clamps [kg]
  Where where;
};

enum class ToolEnd { clamped, free };
constexpr std::string_view word(ToolEnd value) { return word_at({"clamped", "free"}, value); }
/// Whether a clamp of the robot ends the dresspack; else it hangs from its last clamp.
constexpr bool is_clamped(ToolEnd value) { return value == ToolEnd::clamped; }

struct Routing {
  double free_length = 0;                       ///< of dresspack between the clamps, unstretched [m]
  std::optional<Clamp> base_clamp, tool_clamp;  ///< absent with clamp_poses only
  std::vector<IntermediateClamp> clamps;        ///< between them, in order along the dresspack
  std::vector<GuideRing> rings;                 ///< in order along the dresspack
  std::optional<Retraction> retraction;         ///< of the base clamp
  double pre_twist = 0;                         ///< of the tool clamp on top of twist-free [rad]
  ToolEnd tool_end = ToolEnd::clamped;          ///< free: it hangs from its last clamp, no tool_clamp
  double tool_mass = 0;                         ///< at a free end [kg]
  std::vector<double>
      mounting_pose;  ///< joints when the dresspack was clamped free of twist [rad]; empty: start
  std::optional<double> longest_bracket;  ///< see longest_bracket_of()
  Where where;
};
/// Longest bracket between a link's surface and a clamp or ring [m].
inline double longest_bracket_of(const Routing& routing) {
  return routing.longest_bracket.value_or(usual_longest_bracket);
}

void describe(Fields& f, BendRelief& relief);
void describe(Fields& f, Clamp& clamp);
void describe(Fields& f, IntermediateClamp& between);
void describe(Fields& f, GuideRing& ring);
void describe(Fields& f, Retraction& retraction);
void describe(Fields& f, Routing& routing);

/// Clamps at mounting points of the robot become clamps with link, position and direction. Errors: InputError
/// with the names of the robot's mounting points.
void place_clamps(Routing& routing, const Robot& robot);

/// The bend at a clamp is computed from its first four links (W39), which must all lie in a relief.
inline constexpr int fewest_relief_segments = 4;
/// A relief to try first: three diameters long, so that it bends as a beam, and at least fewest_relief_segments; as stiff as the
/// dresspack, which halves the curvature at the clamp. Stiffer ones move the bend to their end (fatigue/measurements.md). Rounded
/// up to mm, and to three digits. diameter, segment [m], stiffness [N m2] of the dresspack.
BendRelief first_relief(double diameter, double stiffness, double segment);
/// "{length_mm: 180, bending_stiffness_Nm2: 6.7}"
std::string relief_text(const BendRelief& relief);

/// (piece between two clamps) at its base and at its tool end.
std::vector<std::array<BendRelief, 2>> bend_reliefs(const Routing& routing);

/// recorded: the motion brings the clamps' poses. diameter: of the dresspack [m]. Errors: InputError at the
/// clamp or ring that the robot or the dresspack does not fit.
void check_routing(const Routing& routing, double diameter, const Robot& robot, bool recorded);

}  // namespace dresslife::pipeline
