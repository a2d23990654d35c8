// How a routing does in a run, as a number for a search: how far each limit is kept or passed.
//
// A whole run of the motion with few segments, of which nothing is written: a tenth of a second. It knows
// what geometry (screening.h) does not: weight, speed, contact, and the twist that bends a clamped hose out
// of its plane. Grades as in screening.h: g <= 0 keeps the limit with so much to spare, g > 0 passes it by so
// much.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "pipeline/job/setup.h"
#include "sim/route/screening.h"

namespace dresslife::sim {

struct Rehearsal {
  /// (V1) to (V4) and (V6) of what the run's checks saw; (V5) is -infinity: the run itself looks after
  /// obstacles.
  Screening seen;
  std::string refusal;  ///< why it does not run; empty: it does
  /// (dresspack, moment, stretch) (V3) of what bends in one of bend_moments equal parts of the motion's time
  /// and one of bend_stretches equal parts of the hose: smoother functions of the routing than their largest,
  /// which has an edge wherever another posture or another place of the hose takes over. At the samples, so
  /// that the largest may miss a little of the run's.
  std::vector<double> bends;
  /// Largest change of a link's bend and twist over the last repeat, which a life falls with: the root of the sum of the
  /// squared ranges of both curvatures and of the twist [1/m]. Infinite: it does not run.
  double swing = std::numeric_limits<double>::infinity();
};

/// Few enough that all are modelled at the cost of one matrix (pipeline/advise/search), and many enough that a part
/// of a program holds some moves, and a third of the hose eight of the 24 segments. Other numbers were not
/// tried.
inline constexpr int bend_moments = 16, bend_stretches = 3;

/// What a search asks for.
inline constexpr int rehearsed_segments = 24, rehearsed_repeats = 1;

/// segments: of each dresspack, at most as many as the job asks for. repeats: of the motion, at most
/// likewise.
Rehearsal rehearsed(pipeline::Setup setup, int segments, int repeats);

}  // namespace dresslife::sim
