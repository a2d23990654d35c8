// Search for a routing without a first guess: clamps on two links, and a ring on a third link if wanted, that satisfy all
// limits of the screening.
//
// Positions are sampled near the links' shapes (near the flange on the last link), where a bracket can carry
// them over the whole motion (V7); directions around the direction from clamp to clamp; the length by its slack at the largest
// distance of the clamps (V1). The best candidates are then changed a little, many times (an evolution strategy without
// recombination; it needs no derivatives, which the screening does not have). The objective is the sum of the violations of a
// wished margin to each limit, for the hose at rest under its weight. If wanted, the best candidates are then changed in the same
// way by their results in short runs (short_run.h): first by their limits; among those that keep all limits by the limits with a
// softer hose, then by a margin of the bend, then by the smallest changes of bend and twist, multiplied by a factor for rubbing, because
// no life is known here.
//
// Candidates that keep all limits are checked in the job's own run and by the checks of `dresslife check`. Equal seeds give equal
// proposals.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/bracket.h"
#include "pipeline/job/setup.h"
#include "sim/route/screening.h"
#include "sim/route/short_run.h"

namespace dresslife::sim {

struct ProposalSettings {
  int count = 1;     ///< number of proposals, best first, each from a separate search
  int tried = 1200;  ///< number of routings that are screened by all searches together, some milliseconds each
  int short_runs =
      0;  ///< number of runs with few segments, a tenth of a second each, that test and improve the best candidates; 0: none
  int further =
      0;  ///< number of short runs after `count` proposals keep all limits: they search for less bend and twist
  double softer = 1;  ///< stiffness of a softer hose that should keep the limits, too, as a share of the job's; 1: none
  std::uint64_t seed = 1;
  std::string ring_link;  ///< link with a guide ring; empty: none
  /// Called with the finished share of the largest possible work, and the present task; may be empty.
  std::function<void(double, const std::string&)> progress{};
};

struct Proposal {
  pipeline::Routing routing;
  Screening screening;
  double missing = 0;    ///< sum of the violations of the wished margins; 0: all are kept
  RoutingRun short_run;  ///< last short run, if any
};

/// Returns proposals. setup: the clamps of its first dresspack name the links, and its routing gives the longest bracket; other
/// values of the routing are not used. Errors: InputError as of Screener, for a motion without a robot, and for a link without a
/// place for a bracket. If geometry certainly excludes all tried routings, there are no short runs, and the short runs of the
/// proposals contain the reason.
std::vector<Proposal> propose(const pipeline::Setup& setup, const ProposalSettings& settings);

/// Returns a routing near the given one, with clamps on the same links within same_place of theirs (sim/run/cures.h), that keeps all limits as
/// propose() does; absent: none of some tens was found. Precondition: one dresspack with one span between two clamps of a robot, without rings and without a
/// retraction unit. Errors: InputError as of Screener.
std::optional<pipeline::Routing> routing_near(const pipeline::Setup& setup);

}  // namespace dresslife::sim
