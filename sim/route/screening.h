// Checks of a routing by geometry alone, in milliseconds: whether it can work at all, and how far it is from
// that.
//
// The dresspack is drawn as a smooth curve of its length through its clamps and rings (start_curve.h) in
// poses of the program that differ most, without weight, contact or speed. Each limit is graded: g <= 0 keeps
// it with so much to spare, g > 0 passes it by so much.
//
// (V1) too short   g = (w - (1 - s_least) L)/L     w: longest straight way over the program, L: length
// (V2) too long    g = ((1 - s_most) L - w)/L      s_least, s_most: shares of slack in checks.h
// (V3) bend        g = ln(R_limit/R)               R: least radius of the curve over the poses
// (V4) twist       g = |Phi|/(L t_limit) - 1       Phi: turn about the tangent since it was clamped
// (V5) overlap     g = (depth - d/2)/d             depth: in the links' capsules, the cell and the floor
//                                                  d: diameter
// (V6) tension     g = ln(F/F_limit)               F: largest pull, which only a run knows (rehearsal.h)
// (V7) bracket     bracket.h: whether brackets can carry the clamps and rings, at all moments of the program
//
// Phi counts whole turns: the direction is transported from clamp to chord to clamp at every moment of the
// program and followed without jumps; in the poses the transport along the curve itself takes its place.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "sim/rod/rotation.h"
#include "sim/route/bracket.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

enum class ScreenedLimit { too_short, too_long, bend, twist, overlap, tension, bracket };
inline constexpr int screened_limits = 7;
constexpr std::string_view word(ScreenedLimit value) {
  return pipeline::word_at({"too short", "too long", "bent too tightly", "twisted too far", "in the robot",
                            "pulled too hard", "bracket"},
                           value);
}

/// What is further beyond than this cannot work: by so much the curve may err that knows no weight and no
/// contact. Of 350 random routings none that was rejected kept its limits in a full run (README.md). In the
/// robot: the hose is pushed aside, so nothing is sure. Of brackets geometry knows all.
inline constexpr std::array<double, screened_limits> surely_beyond{
    0, 0, 1, 0.5, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};

/// Of a point to the nearest one of the line between two others [m].
double distance_to_axis(const Vector3& point, const Vector3& from, const Vector3& to);

/// Of the worst span or dresspack each.
struct Screening {
  std::array<double, screened_limits>
      beyond;  ///< (limit) g; the most negative number where nothing asks for it
  std::array<double, screened_limits> time;  ///< (limit) of the moment that decides [s]

  bool rejected() const;     ///< some limit is surely passed
  double violation() const;  ///< sum of what is beyond
};

class Screener {
 public:
  /// Computes the motion and looks for the poses that differ most. brackets: (V7) is asked.
  /// Errors: InputError, as RobotPath, RecordedPath and Surfaces.
  explicit Screener(const pipeline::Setup& setup, bool brackets = false);
  ~Screener();

  /// setup: with the robot and motion that this was made with; dresspacks, their routings and the rest may
  /// differ. Errors: InputError for a clamp or ring on a link that the robot has not.
  Screening screen(const pipeline::Setup& setup) const;

  /// (V3) with the hose at rest under its weight in some of the poses (equilibrium.h), free of twist: five
  /// times as dear. Large where it finds no rest.
  double bend_at_rest(const pipeline::Setup& setup) const;

  /// How a bracket carries this over the program. Precondition: a robot, and brackets are asked for.
  BracketFit bracket(const Carried& carried) const;
  /// Of BracketFit::moment [s].
  double time_of(std::size_t moment) const;

  /// (span) w of (V1) [m]; 0: a free end.
  std::vector<double> longest_ways(const pipeline::Setup& setup) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dresslife::sim
