// A routing from nothing: a search over the routing box of a draft (sim/route/routing_box.h) by dresslife-sim.
//
// Geometry screens places that are drawn anywhere, with a margin to each limit, as a run bends, twists and
// sways on top of it. The best of them are tried in short runs, and the search goes on with these (Q6) to
// where all limits are kept. Such a routing is a trial: it runs through the whole chain. A trial that passes
// a limit is told to the search, which asks for another one.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/outcome.h"
#include "pipeline/advise/route/draft.h"

namespace dresslife::pipeline {

struct RoutingRequest {
  int tried = 400;       ///< places that geometry looks at
  int rehearsals = 160;  ///< short runs before the first trial, at most
  int trials = 3;        ///< runs through the whole chain, at most, until one keeps all limits
  std::uint64_t seed = 1;
  std::string ring_link;  ///< of a guide ring; empty: none
};

struct RoutingTrial {
  std::string routing;  ///< YAML
  Outcome outcome;
};

/// What a search in one size of the dresspack came to.
struct RoutingFound {
  std::string motion;  ///< YAML of the draft's exercise; empty: it has a motion
  std::vector<RoutingTrial> trials;
  std::optional<std::size_t> best;  ///< trial that ran: feasible, else least beyond its limits, or a longer life
  /// The short run that was nearest to keeping all limits.
  std::string nearest;                                          ///< YAML of its routing; empty: none runs
  double violation = std::numeric_limits<double>::infinity();  ///< of it
  std::string obstacle;                                         ///< what it passes, or why nothing runs

  bool feasible() const { return best && trials[*best].outcome.feasible(); }
  void add(RoutingTrial trial);
};

/// Whether a trial that ran is to be preferred.
bool better(const RoutingTrial& a, const RoutingTrial& b);

/// Runs a routing and its motion (YAML) through the whole chain; trial: its number.
using RunRouting =
    std::function<Outcome(const std::string& routing, const std::string& motion, std::size_t trial)>;

/// factor: of the dresspack's size. folder: for what dresslife-sim reads. Errors: InputError for a draft that
/// has no routing box.
RoutingFound find_routing(const Draft& draft, double factor, const RoutingRequest& request,
                          const std::filesystem::path& folder, const RunRouting& run);

}  // namespace dresslife::pipeline
