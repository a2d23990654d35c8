// Why a motion breaks a limit, and which key with which value cures it, as words of its warning.
//
// What geometry and statics can say is computed: slack follows from the longest distance of the clamps; twist from
// the net turn of the clamps, which a pre-twist centres about zero and a longer hose spreads. A bend that is not there at
// rest comes from a swing, and that is proportional to the acceleration:
//     a = a_now (k_limit - k_rest) / (k - k_rest)        k: curvature
// Lengths, directions of the clamps, pre-twists and accelerations are tried before they are named, by the checks of
// quick_checks.h: with the remedy the job keeps its limits of bend and slack at rest and in a short run, and passes no
// other one. If nothing that was tried does so, the remedy says it and names the search for other clamps.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "sim/run/quick_checks.h"
#include "sim/run/routing.h"

namespace dresslife::sim {

/// A motion whose checks are known.
struct CheckedMotion {
  const pipeline::Setup& setup;
  std::function<std::string(double)> moment;  ///< "at 1.2 s, program step 3 'text'"
  const Rod* rod = nullptr;                   ///< null: a prescribed deformation
  const ClampPath* path = nullptr;            ///< null: a prescribed deformation
  mutable double work = 0;                    ///< of short runs that tried remedies, as World::work
  mutable std::map<int, std::string> remedies{};  ///< (dresspack) routing that keeps its limits, in words; empty: none was found yet
};

struct Cure {
  std::string cause, remedy;
};

/// Precondition: `broken` is one of the checks, and its limit is broken.
Cure cure_of(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken);

/// Of a dresspack that a short run drew taut. Precondition: run.taut_at.
pipeline::Warning taut_warning(const CheckedMotion& motion, const ShortRun& run);

/// What would let a refused job run.
std::string refusal_remedy(const pipeline::Setup& setup, const RoutingRefusal& refusal);

/// Of checks whose limits are broken: value, limit, place, time, cause and remedy.
std::vector<pipeline::Warning> check_warnings(const CheckedMotion& motion, const std::vector<Check>& checks);

/// Largest curvature of a span at rest between two clamps, free of twist [1/m]; infinite: no rest is found.
double curvature_at_rest(RodProperties span, const ClampFrames& clamps);

}  // namespace dresslife::sim
