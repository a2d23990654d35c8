// The cause of an exceeded limit of a motion, and the key and value that cure it, as text of the warning.
//
// Results of geometry and statics are computed: slack follows from the longest distance of the clamps; twist from the net
// rotation of the clamps, which a pre-twist centres about zero and a longer hose distributes. A bend that does not exist at
// rest comes from a swing, which is proportional to the acceleration:
//     a = a_now (k_limit - k_rest) / (k - k_rest)        k: curvature
// Lengths, directions of the clamps, pre-twists and accelerations are tried before they are proposed, with the checks of
// quick_checks.h: with the remedy the job keeps its limits of bend and slack at rest and in a short run, and exceeds no
// additional limit. If no length and no direction does so, clamps within same_place of theirs are searched (sim/route), and
// after these a slower program is tried, whose remedy states the longer repeat. If nothing is found, the remedy states this and
// names the search for other clamps.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/warning_words.h"
#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "sim/run/quick_checks.h"
#include "sim/run/routing.h"

namespace dresslife::sim {

/// Distance within which a clamp counts as at the same place [m]. ESTIMATE: the foot of a dresspack's bracket is about this long, so
/// that an adapter plate on the same screws carries the moved clamp. Beyond it a fitter drills and taps other holes.
inline constexpr double same_place = 0.1;

/// A motion whose checks are known.
struct CheckedMotion {
  const pipeline::Setup& setup;
  std::function<std::string(double)> moment;  ///< "at 1.2 s, program step 3 'text'"
  const Rod* rod = nullptr;                   ///< null for a prescribed deformation
  const ClampPath* path = nullptr;            ///< null for a prescribed deformation
  /// Returns a remedy with clamps within same_place of theirs, if no length and no direction is one; may be empty.
  std::function<pipeline::Remedy()> other_places = {};
  double own_stiffness = 1;  ///< factor of setup's stiffness at which a remedy must keep the limits, too
  mutable double work = 0;   ///< work of the short runs that tried remedies, in the unit of World::work
  /// (dresspack, kinds of limits) a routing that keeps these; empty: none was found
  mutable std::map<std::pair<int, std::vector<pipeline::WarningKind>>, pipeline::Remedy> remedies{};
};

struct Cure {
  std::string cause;
  pipeline::Remedy remedy;
};

/// Returns cause and remedy. Precondition: `broken` is one of the checks, and its limit is exceeded.
Cure cure_of(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken);

/// Returns what a dresspack may wind around: "the robot", with the cell's obstacles if there are any.
std::string obstacle_words(const pipeline::Setup& setup);

/// Returns the warning for a dresspack that was pulled taut in a short run. Precondition: run.taut_at is set.
pipeline::Warning taut_warning(const CheckedMotion& motion, const ShortRun& run);

/// Returns a remedy with which a refused job would run.
std::string refusal_remedy(const pipeline::Setup& setup, const RoutingRefusal& refusal);

/// Returns value, limit, place and time of a check: "smallest bend radius: 187 mm (limit 200 mm), 0.50 m from the base clamp ..".
std::string check_words(const CheckedMotion& motion, const Check& check);

/// Returns warnings for the checks with exceeded limits: value, limit, place, time, cause and remedy.
std::vector<pipeline::Warning> check_warnings(const CheckedMotion& motion, const std::vector<Check>& checks);

/// Returns the largest curvature of a span at rest between two clamps, without twist [1/m]; infinite: no equilibrium was found.
double curvature_at_rest(RodProperties span, const ClampFrames& clamps);

}  // namespace dresslife::sim
