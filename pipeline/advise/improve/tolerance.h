// Selection of the best routing within the mounting tolerance.
//
// (T1) m_w = min(m, m_1, ..., m_n)   m: merit (merit.h) without offset; m_i: merit with one offset by the tolerance, of a clamp,
//                                    a ring, a length or the turn of the end (nudges.h); the least merit if the job does not run
//
// The merits m_i so far are upper bounds of m_w. The finalist with the largest bound is evaluated next, until all its m_i are
// known: then no other finalist can have a larger m_w. Three finalists are compared, and more as long as each of them has an m_i
// that does not run. Cases in which another finalist lost most are evaluated first. Both rules save runs with the same result.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/nudges.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

struct Finalist {
  Outcome drawn;
  std::vector<Nudge> nudges;
  /// Runs the nudges with these indices. Returns the outcomes in the same order.
  std::function<std::vector<Outcome>(const std::vector<std::size_t>&)> run;
};

/// Nudges of one step. The first are the lengths and the turn of the end, which show a narrow optimum soonest.
inline constexpr std::size_t tolerance_runs_at_once = 4;

/// State before the next runs. likely: all runs if the leading finalist stays the best; most: all runs if every finalist must be
/// evaluated completely.
struct ToleranceCount {
  std::size_t done = 0, likely = 0, most = 0;
};
using ToleranceProgress = std::function<void(const ToleranceCount&)>;

struct WithinTolerance {
  std::vector<ImprovementStory::Nudge> nudges;  ///< evaluated nudges
  std::vector<std::size_t> numbers;             ///< (evaluated) index in Finalist::nudges, rising
  Merit worst;                                  ///< upper bound of m_w; equal to m_w if `whole`
  Outcome worst_outcome;                        ///< outcome with this merit
  bool whole = false;                           ///< whether all nudges were evaluated
};

/// Evaluates the nudges of one finalist until `enough` returns true for the worst merit so far. others: finalists of the same
/// job, which determine the order.
WithinTolerance within_tolerance(const Finalist& finalist, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others,
                                 const ToleranceProgress& progress);

/// Returns the results of the finalists that had to be evaluated, in their order; at least one is whole. best_first: finalists by
/// falling merit. as_it_is: outcome of the original job (merit_of()).
std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first,
                                              const Outcome& as_it_is,
                                              const ToleranceProgress& progress = {});

/// Returns the index of the largest m_w among the whole results. own: index of the original job. It stays the choice if no other
/// result is clearly better than its bound (merit.h). Precondition: at least one is whole.
std::size_t best_within(const std::vector<WithinTolerance>& judged, std::optional<std::size_t> own = {});

/// Returns a line: "With a clamp or length off by 10 mm, .. or an end turned by 10 deg the wires live at least 0.7 times as long,
/// ..."; empty without nudges.
std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges,
                            const MountingTolerance& tolerance);

}  // namespace dresslife::pipeline
