// The routing: clamps and guides of the dresspack, and its lengths between them.
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

/// A sleeve or spring around the dresspack beside a clamp, on the free side (on both sides of an intermediate clamp). It
/// increases the bending stiffness there (S24). It has no effect if its length or stiffness is 0.
struct BendRelief {
  double length = 0;     ///< measured from the clamp [m]
  double stiffness = 0;  ///< in addition to the dresspack's own [N m2]
};

struct Clamp {
  std::string link;                        ///< link of the robot
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack at the clamp, base to tool, in the link's frame
  std::optional<double>
      roll;  ///< about the direction [rad]; absent: 0 at the base clamp, twist-free at the other clamps
  Where where;
  std::string mounting_point{};  ///< of the robot, replaces link, position and direction; empty after reading
  std::optional<BendRelief> bend_relief{};
};

/// A clamp between the two ends. It fixes position, direction and twist of the dresspack.
struct IntermediateClamp {
  Clamp clamp;
  double at_length = 0;  ///< unstretched length of dresspack from the base clamp [m]
};

/// A ring in which the dresspack slides and turns.
struct GuideRing {
  std::string link;
  Vector3d position = Vector3d::Zero();    ///< of its centre, in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of its axis, base to tool, in the link's frame
  double radius = 0;                       ///< clear inner [m]
  double friction = 0;                     ///< Coulomb
  double width = 0;                        ///< along its axis, like a short tube [m]
  std::optional<double> at_length;         ///< length of dresspack from the base clamp to the ring at mounting [m]
  Where where;
};

/// Retraction unit: the base clamp slides along its direction, and a spring pulls it back.
struct Retraction {
  double force = 0;     ///< at travel 0 [N]
  double spring = 0;    ///< increase of the force per travel [N/m]
  double stroke = 0;    ///< [m]
  double damping = 0;   ///< [N s/m]
  double friction = 0;  ///< Coulomb [N]
  double mass = 1;      ///< of the sliding parts, without the hose between the clamps [kg]
  Where where;
};

enum class ToolEnd { clamped, free };
constexpr std::string_view word(ToolEnd value) { return word_at({"clamped", "free"}, value); }
/// Returns whether a clamp of the robot holds the tool end; otherwise the dresspack hangs from its last clamp.
constexpr bool is_clamped(ToolEnd value) { return value == ToolEnd::clamped; }

/// Side to which a dresspack bulges when it is mounted, seen from its base clamp to its tool clamp with gravity downward.
enum class Side { either, left, right };
constexpr std::string_view word(Side value) { return word_at({"either", "left", "right"}, value); }

struct Routing {
  double free_length = 0;                       ///< length of dresspack between the clamps, unstretched [m]
  std::optional<Clamp> base_clamp, tool_clamp;  ///< absent only with clamp_poses
  std::vector<IntermediateClamp> clamps;        ///< intermediate clamps, in order along the dresspack
  std::vector<GuideRing> rings;                 ///< in order along the dresspack
  std::optional<Retraction> retraction;         ///< of the base clamp
  double pre_twist = 0;                         ///< of the tool clamp relative to twist-free [rad]
  ToolEnd tool_end = ToolEnd::clamped;          ///< free: the dresspack hangs from its last clamp and has no tool_clamp
  double tool_mass = 0;                         ///< at a free end [kg]
  Side side = Side::either;                     ///< at mounting; either: the left if it rests on both sides
  std::vector<double>
      mounting_pose;  ///< joint angles at which the dresspack was clamped without twist [rad]; empty: start of the motion
  std::optional<double> longest_bracket;  ///< see longest_bracket_of()
  Where where;
};
/// Returns the longest allowed bracket between a link's surface and a clamp or ring [m].
inline double longest_bracket_of(const Routing& routing) {
  return routing.longest_bracket.value_or(usual_longest_bracket);
}

void describe(Fields& f, BendRelief& relief);
void describe(Fields& f, Clamp& clamp);
void describe(Fields& f, IntermediateClamp& between);
void describe(Fields& f, GuideRing& ring);
void describe(Fields& f, Retraction& retraction);
void describe(Fields& f, Routing& routing);

/// Replaces the mounting points of clamps by link, position and direction. Errors: InputErrors with the names of the robot's
/// mounting points.
void place_clamps(Routing& routing, const Robot& robot);

/// The bend at a clamp is computed from the first four links beside it (W39). All four must be within the relief.
inline constexpr int fewest_relief_segments = 4;
/// A relief of this many times the dresspack's stiffness acts as a longer clamp: the dresspack in it bends less than a tenth as
/// much as beside it.
inline constexpr double rigid_relief = 10;
/// Returns a relief for a first trial. Its length is three diameters, so that it bends as a beam, and at least
/// fewest_relief_segments segments. It is as stiff as the dresspack, which halves the curvature at the clamp. A stiffer relief
/// moves the bend to its end (fatigue/measurements.md). The length is rounded up to mm, the stiffness to three digits. diameter,
/// segment [m] and stiffness [N m2] are those of the dresspack. segment 0: the three diameters alone.
BendRelief first_relief(double diameter, double stiffness, double segment);
/// Returns "{length_mm: 180, bending_stiffness_Nm2: 6.7}".
std::string relief_text(const BendRelief& relief);

/// Returns " between the base clamp and clamp 1" for the piece with this number; empty: the dresspack is one piece. Clamp 1 is
/// `routing.clamps.1`.
std::string between_clamps(const Routing& routing, std::size_t piece);

/// Returns for each piece between two clamps the reliefs at its base end and at its tool end.
std::vector<std::array<BendRelief, 2>> bend_reliefs(const Routing& routing);

/// recorded: the motion contains the clamps' poses. diameter: of the dresspack [m]. Errors: InputErrors at each clamp or ring
/// that does not fit the robot or the dresspack.
void check_routing(const Routing& routing, double diameter, const Robot& robot, bool recorded);

}  // namespace dresslife::pipeline
