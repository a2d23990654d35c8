// A job with one clamp, ring, its length or the turn of its end off by the mounting tolerance.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// What a fitter can miss. 10 mm: a bracket's holes and the place of a hose in its clamp. 10 deg: 5 mm on the surface of a hose of 60 mm,
/// which has no line along it.
struct MountingTolerance {
  double off = 0.01;                          ///< of each coordinate of a clamp or ring, and of lengths [m]
  double turn = 10 * std::numbers::pi / 180;  ///< of the hose's end about its axis [rad]
  /// Of a clamp's or ring's direction [rad]: one end of a base of 100 mm, an ESTIMATE, is off.
  double tilt() const { return std::atan(off / 0.1); }
  bool none() const { return !(off > 0) && !(turn > 0); }
};

/// Of command line options [mm, deg]. Without off_deg the usual turn, or none without off_mm.
MountingTolerance tolerance_of(double off_mm, const std::optional<double>& off_deg = {});

struct Nudge {
  std::string what;               ///< "base clamp, x + 10 mm"
  std::vector<std::string> sets;  ///< "KEY.PATH=VALUE"
};

/// Each length, the turn of the end, each coordinate and two tilts of each clamp and ring, off to both sides. Empty if
/// the routings of the jobs differ.
std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, const MountingTolerance& by);

/// Whether an error in the value of a key (a path) is in nudges_of().
bool has_mounting_tolerance(const std::string& key);

/// "a clamp or length off by 10 mm, a clamp tilted by 6 deg or an end turned by 10 deg"
std::string tolerance_text(const MountingTolerance& by);

}  // namespace dresslife::pipeline
