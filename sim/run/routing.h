// The spans of the chain, from the job's dresspacks and their routing; dresspack after dresspack.
//
// Each dresspack has `simulation.segments` = n segments, distributed to its spans by their lengths: with the length
// L, the span from s_a to s_b has round(n s_b/L) - round(n s_a/L) segments, at least fewest_segments.
#pragma once

#include <optional>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/warnings.h"
#include "pipeline/job/routing.h"
#include "sim/rod/rod.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Fewest segments of a span: with fewer, its end corrections (S5) overlap.
inline constexpr int fewest_segments = 4;

Rod rod_of(const pipeline::Setup& setup);

/// A dresspack that cannot be clamped or moved in this way.
struct RoutingRefusal : pipeline::InputError {
  RoutingRefusal(const pipeline::Where& of, const std::string& what, const std::string& what_to_do, int index,
                 std::optional<double> when = {})
      : InputError(of, what, what_to_do), where(of), problem(what), remedy(what_to_do), dresspack(index), time(when) {}
  pipeline::Where where;
  std::string problem, remedy;
  int dresspack;
  std::optional<double> time;  ///< time of the program [s]; absent: before the program
  double work = 0;             ///< work until the refusal, in the unit of World::work
  bool taut = false;           ///< the dresspack is pulled tight: the motion tears it or pulls it out of its clamps
};

/// Returns warnings for dresspacks with all clamps and rings on one link: they hardly bend.
std::vector<pipeline::Warning> one_link_warnings(const pipeline::Setup& setup);

/// A guide ring and the span that passes through it; the rings of all dresspacks, in their order.
struct RoutedRing {
  const pipeline::GuideRing& ring;
  int span;
  double clearance;  ///< between the hose in its middle and the ring [m]
};
std::vector<RoutedRing> routed_rings(const pipeline::Setup& setup);
/// Returns, (span), the length of the straight lines from end to end through the rings' centres, minus the largest saving by an
/// off-centre hose: a shorter hose does not reach.
std::vector<double> shortest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampFrames& clamps,
                                  const std::vector<Frame>& rings);

/// Joins the states of single spans to one state of the whole rod.
RodState joined(const Rod& rod, const std::vector<RodState>& spans);

/// Returns the clamps of a state in the order of motion.h5: for each dresspack the base clamp, the clamps between, the tool
/// clamp.
std::vector<Frame> listed_clamps(const Rod& rod, const ClampFrames& clamps);
/// Returns, (clamp), the number of segments before it, in the order of listed_clamps().
std::vector<int> clamp_segments(const Rod& rod);

/// Returns words about a cell far from the usual temperature, which changes a stiffness from the construction; empty: it is near.
std::string warmth_words(const pipeline::Setup& setup);

}  // namespace dresslife::sim
