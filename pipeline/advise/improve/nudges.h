// Variants of a job with one offset by the mounting tolerance: of a clamp, a ring, a length or the turn of the hose's end.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// Errors of mounting. 10 mm: holes of a bracket, and position of a hose in its clamp. 10 deg: 5 mm on the surface of a hose of
/// 60 mm, which has no line along it.
struct MountingTolerance {
  double off = 0.01;                          ///< offset of each coordinate of a clamp or ring, and of lengths [m]
  double turn = 10 * std::numbers::pi / 180;  ///< rotation of the hose's end about its axis [rad]
  /// Returns the error of a clamp's or ring's direction [rad]: an offset of one end of a base of 100 mm, an ESTIMATE.
  double tilt() const { return std::atan(off / 0.1); }
  bool none() const { return !(off > 0) && !(turn > 0); }
};

/// Returns the tolerance for options [mm, deg]. Without off_deg: the default turn, or 0 if off_mm is 0.
MountingTolerance tolerance_of(double off_mm, const std::optional<double>& off_deg = {});

struct Nudge {
  std::string what;               ///< "base clamp, x + 10 mm"
  std::vector<std::string> sets;  ///< "KEY.PATH=VALUE"
};

/// Returns both signs of each offset: each length, the turn of the end, each coordinate and two tilts of each clamp and ring.
/// Empty if the routings of the jobs differ.
std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, const MountingTolerance& by);

/// Returns whether nudges_of() contains an error in the value of a key (a path).
bool has_mounting_tolerance(const std::string& key);

/// Returns "a clamp or length off by 10 mm, a clamp tilted by 6 deg or an end turned by 10 deg".
std::string tolerance_text(const MountingTolerance& by);

}  // namespace dresslife::pipeline
