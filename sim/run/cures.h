// Why a motion breaks a limit, and which key with which value would cure it, as words of its warning.
//
// What geometry and statics can say is computed: slack follows from the longest distance of the clamps; twist from
// the net turn of the clamps, which a pre-twist centres about zero and a longer hose spreads; the bend radius at rest
// is tried with other lengths and with other directions of the clamps, in poses of the program that differ. A bend
// that is not there at rest comes from a swing, and that is proportional to the acceleration:
//     a = a_now (k_limit - k_rest) / (k - k_rest)        k: curvature
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// A motion whose checks are known.
struct CheckedMotion {
  const pipeline::Setup& setup;
  std::function<std::string(double)> moment;  ///< "at 1.2 s, program step 3 'text'"
  const Rod* rod = nullptr;                   ///< null: a prescribed deformation
  const ClampPath* path = nullptr;            ///< null: a prescribed deformation
};

struct Cure {
  std::string cause, remedy;
};

/// Precondition: `broken` is one of the checks, and its limit is broken.
Cure cure_of(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken);

/// Of checks whose limits are broken: value, limit, place, time, cause and remedy.
std::vector<pipeline::Warning> check_warnings(const CheckedMotion& motion, const std::vector<Check>& checks);

/// Largest curvature of a span at rest between two clamps, free of twist [1/m]; infinite: no rest is found.
double curvature_at_rest(RodProperties span, const ClampFrames& clamps);

}  // namespace dresslife::sim
