// The result of a routing in a short run, as numbers for a search: violation or margin of each limit.
//
// A short run is a complete run of the motion with few segments and without output: a tenth of a second. It includes
// effects that geometry (screening.h) does not: weight, speed, contact, and the twist that bends a clamped hose out
// of its plane. Values as in screening.h: g <= 0 is the margin to the limit, g > 0 the violation.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "pipeline/job/setup.h"
#include "sim/route/screening.h"

namespace dresslife::sim {

struct RoutingRun {
  /// (V1) to (V4) and (V6) from the checks of the run; (V5) is -infinity, because the run itself includes the obstacles.
  Screening seen;
  std::string refusal;  ///< reason why it does not run; empty: it runs
  /// (dresspack, moment, stretch) (V3) of the bends in one of bend_moments equal parts of the motion's time
  /// and one of bend_stretches equal parts of the hose. They are smoother functions of the routing than their maximum,
  /// which has an edge if another pose or another place of the hose becomes the largest. Evaluated at the samples, so
  /// the maximum may be a little below that of the run.
  std::vector<double> bends;
  /// Largest change of a link's bend and twist over the last repeat, with which a life decreases: the root of the sum of the
  /// squared ranges of both curvatures and of the twist [1/m]. Infinite: it does not run.
  double swing = std::numeric_limits<double>::infinity();
  double rubbing = 0;  ///< mean power of rubbing [W] (RunSummary::rubbing_power)
  double work = 0;     ///< in the unit of World::work
};

/// Few enough that all are modelled with one matrix (pipeline/advise/search), and enough that a part
/// of a program contains only some moves, and a third of the hose contains eight of the 24 segments. Other numbers were not
/// tried.
inline constexpr int bend_moments = 16, bend_stretches = 3;

/// Values that a search uses.
inline constexpr int routing_run_segments = 24, routing_run_repeats = 1;

/// Returns the result of a short run. segments: of each dresspack, at most those of the job. repeats: of the motion, at most
/// those of the job. with_bends: whether `bends` is evaluated; without them a motion with loops takes less time. useless_beyond:
/// (V3) of the first dresspack above which the run ends.
RoutingRun short_run_of(pipeline::Setup setup, int segments, int repeats, bool with_bends = true,
                        double useless_beyond = std::numeric_limits<double>::infinity());

}  // namespace dresslife::sim
