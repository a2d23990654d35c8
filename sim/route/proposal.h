// A routing from nothing: clamps on two links, and a ring on a third if wanted, that the screening finds
// nothing against.
//
// Places are drawn at random beside the links' shapes (beside the flange on the last link) where a bracket can carry
// them over the whole motion (V7), directions about
// the way from clamp to clamp, the length by the slack that it leaves where the way is longest (V1). The best
// of what was tried are then changed a little, again and again (an evolution strategy without recombination;
// it needs no derivatives, of which the screening has none). Goodness is the sum of what misses a wished
// margin to each limit, the hose at rest under its weight. Then, if wanted, the best are changed likewise by
// how they do in short runs (rehearsal.h): first by their limits, and among those that keep all by how little the hose bends
// and twists to and fro, as no life is known here. What keeps all limits is looked at as the job itself runs, and as
// `dresslife check` looks at it. Equal seeds, equal proposals.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/job/bracket.h"
#include "pipeline/job/setup.h"
#include "sim/route/rehearsal.h"
#include "sim/route/screening.h"

namespace dresslife::sim {

struct ProposalSettings {
  int count = 1;     ///< proposals, best first, each of a search of its own
  int tried = 1200;  ///< routings that are screened, by all searches: some milliseconds each
  int rehearsals =
      0;  ///< runs with few segments, a tenth of a second each, that try the best and better them; 0: none
  int further = 0;  ///< rehearsals once `count` proposals keep all limits: for those that bend and twist less
  std::uint64_t seed = 1;
  std::string ring_link;  ///< a guide ring on it; empty: none
  /// Share of the most work that there may be, and what is tried; may be empty.
  std::function<void(double, const std::string&)> progress{};
};

struct Proposal {
  pipeline::Routing routing;
  Screening screening;
  double missing = 0;   ///< sum of what misses the wished margins; 0: all are kept
  Rehearsal rehearsal;  ///< of the last run, if there were some
};

/// setup: its first dresspack's clamps name the links, its routing says the longest bracket; all else of that is not
/// read. Errors: InputError as of Screener, for a motion without a robot, and for a link near which no place has a
/// bracket. Where geometry surely excludes all that was tried nothing is rehearsed, and the proposals' rehearsals say
/// why.
std::vector<Proposal> propose(const pipeline::Setup& setup, const ProposalSettings& settings);

}  // namespace dresslife::sim
