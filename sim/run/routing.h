// From the job's dresspacks and their routing to the chain's spans, dresspack after dresspack.
//
// Each dresspack has `simulation.segments` = n segments, dealt to its spans by their lengths: of its length
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

/// Of a span: below, its end corrections (S5) overlap.
inline constexpr int fewest_segments = 4;

Rod rod_of(const pipeline::Setup& setup);

/// A dresspack that cannot be clamped or moved so.
struct RoutingRefusal : pipeline::InputError {
  RoutingRefusal(const pipeline::Where& of, const std::string& what, const std::string& what_to_do, int index,
                 std::optional<double> when = {})
      : InputError(of, what, what_to_do), where(of), problem(what), remedy(what_to_do), dresspack(index), time(when) {}
  pipeline::Where where;
  std::string problem, remedy;
  int dresspack;
  std::optional<double> time;  ///< of the program [s]; absent: before it
  double work = 0;             ///< that was in vain, as World::work
};

/// Of dresspacks whose clamps and rings all are on one link: they hardly bend.
std::vector<pipeline::Warning> one_link_warnings(const pipeline::Setup& setup);

/// A guide ring and the span that passes it; the rings of all dresspacks, in their order.
struct RoutedRing {
  const pipeline::GuideRing& ring;
  int span;
};
std::vector<RoutedRing> routed_rings(const pipeline::Setup& setup);
/// (span) length of the straight ways from end to end through the rings' centres, less what an off-centre
/// hose saves at most: no shorter hose reaches.
std::vector<double> shortest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampFrames& clamps,
                                  const std::vector<Frame>& rings);

/// The states of single spans as one state of the whole rod.
RodState joined(const Rod& rod, const std::vector<RodState>& spans);

/// Clamps of a state in the order of motion.h5: of each dresspack the base clamp, those between, the tool
/// clamp.
std::vector<Frame> listed_clamps(const Rod& rod, const ClampFrames& clamps);
/// (clamp) segments before it, in the same order.
std::vector<int> clamp_segments(const Rod& rod);

}  // namespace dresslife::sim
