// Checks of a routing by geometry only, in milliseconds: whether it can work, and its distance from each limit.
//
// The dresspack is a smooth curve of its length through its clamps and rings (start_curve.h), without weight, contact
// or speed, in those poses of the program that differ most. For each limit: g <= 0 is the margin, g > 0 the violation.
//
// (V1) too short   g = (w - (1 - s_least) L)/L     w: largest straight distance over the program, L: length
// (V2) too long    g = ((1 - s_most) L - w)/L      s_least, s_most: shares of slack in checks.h
// (V3) bend        g = ln(R_limit/R)               R: least radius of the curve over the poses
// (V4) twist       g = |Phi|/(L t_limit) - 1       Phi: rotation about the tangent since mounting
// (V5) overlap     g = (depth - d/2)/d             depth: in the links' capsules, the cell and the floor
//                                                  d: diameter
// (V6) tension     g = ln(F/F_limit)               F: largest tension, which only a run gives (short_run.h)
// (V7) bracket     bracket.h: whether brackets can carry the clamps and rings, at all moments of the program
// (V8) way out     bracket.h: from the link of a clamp, as (V3)
//
// Phi counts full turns: the direction is transported from clamp to chord to clamp at every moment of the
// program and followed without jumps; in the drawn poses the transport along the curve itself is used instead.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
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
  return pipeline::word_at(
      {"too short", "too long", "bent too tightly", "twisted too far", "in the robot", "pulled too hard", "bracket"},
      value);
}

/// A routing with a larger violation cannot work: the values are the largest possible errors of the curve, which has no weight
/// and no contact. In a test with 350 random routings no rejected one kept its limits in a full run. Overlap with the
/// robot is never certain, because the hose is pushed aside. For brackets geometry is exact.
inline constexpr std::array<double, screened_limits> surely_beyond{
    0, 0, 1, 0.5, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};

/// Results of the worst span or dresspack for each limit.
struct Screening {
  std::array<double, screened_limits> beyond;  ///< (limit) g; the most negative number if the limit is not requested
  std::array<double, screened_limits> time;    ///< (limit) time of the decisive moment [s]

  bool rejected() const;  ///< some limit is certainly exceeded
};

/// (V7) of one clamp or ring.
struct BracketBeyond {
  std::size_t dresspack = 0;
  BracketPlace place;
  double beyond = 0;       ///< g
  std::size_t moment = 0;  ///< BracketFit::moment
};

class Screener {
 public:
  /// Computes the motion and selects the poses that differ most. brackets: whether (V7) and (V8) are evaluated.
  /// Errors: InputError, as RobotPath, RecordedPath and Surfaces.
  explicit Screener(const pipeline::Setup& setup, bool brackets = false);
  ~Screener();

  /// Returns the screening of a routing. setup: with the same robot, motion and cell as in the constructor; dresspacks, routings
  /// and other keys may differ. built: brackets whose own violation of (V7) is allowed, as long as the clamp or ring is less than
  /// a millimetre from its place. Errors: InputError for a clamp or ring on a link that the robot does not have.
  Screening screen(const pipeline::Setup& setup, std::span<const BracketBeyond> built = {}) const;

  /// Returns (V7) of all clamps and rings; empty without a robot or `brackets`. Errors: as screen().
  std::vector<BracketBeyond> brackets(const pipeline::Setup& setup) const;

  /// Returns (V3) with the hose at rest under its weight in some of the poses (equilibrium.h), without twist; five
  /// times as slow. Large if no equilibrium is found.
  double bend_at_rest(const pipeline::Setup& setup) const;

  /// Returns the fit of a bracket for this clamp over the program. Precondition: a robot, and `brackets` was set.
  BracketFit bracket(const BracketPlace& place) const;
  /// Returns the time of BracketFit::moment [s].
  double time_of(std::size_t moment) const;

  /// Returns w of (V1), (span) [m]; 0: a free end.
  std::vector<double> longest_ways(const pipeline::Setup& setup) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dresslife::sim
