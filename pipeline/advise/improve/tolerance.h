// The best routings within the mounting tolerance.
//
// (T1) m_w = min(m, m_1, ..., m_n)   m: merit (merit.h) as drawn; m_i: with one clamp, ring, length or the turn of the end off by the
//                                    tolerance (nudges.h); the least merit where that does not run
//
// The merits of the m_i so far bound m_w from above. The finalist with the largest bound is evaluated next, until it is whole: no
// other can have a larger m_w. Three finalists are candidates, and more while all of them have an m_i that does not run. The cases of a
// finalist with which another one lost most come first. Both save runs and leave the result as it is.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/nudges.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

struct Finalist {
  Outcome drawn;
  std::vector<Nudge> nudges;
  /// Runs nudges by their index; outcomes in the same order.
  std::function<std::vector<Outcome>(const std::vector<std::size_t>&)> run;
};

/// The length and the turn of the end first, in which a narrow optimum shows soonest.
inline constexpr std::size_t tolerance_runs_at_once = 4;

/// Before the next runs. likely: all runs if the finalist that leads stays the best; most: if every finalist has to be whole.
struct ToleranceCount {
  std::size_t done = 0, likely = 0, most = 0;
};
using ToleranceProgress = std::function<void(const ToleranceCount&)>;

struct WithinTolerance {
  std::vector<ImprovementStory::Nudge> nudges;  ///< evaluated
  std::vector<std::size_t> numbers;             ///< (evaluated) index in Finalist::nudges, rising
  Merit worst;                                  ///< upper bound of m_w; m_w itself if whole
  Outcome worst_outcome;                        ///< with that merit
  bool whole = false;                           ///< all were evaluated
};

/// One finalist, its nudges until `enough` of the worst merit so far. others: finalists of the same job, for the order.
WithinTolerance within_tolerance(const Finalist& finalist, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others,
                                 const ToleranceProgress& progress);

/// Results of as many finalists as had to be evaluated, in their order; at least one is whole. best_first: by merit. as_it_is: the job
/// before any change (merit_of()).
std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first,
                                              const Outcome& as_it_is,
                                              const ToleranceProgress& progress = {});

/// Index of the largest m_w of those that are whole. Precondition: one is.
std::size_t best_within(const std::vector<WithinTolerance>& judged);

/// "With a clamp or length off by 10 mm, .. or an end turned by 10 deg the wires live at least 0.7 times as long, ..."; a line, empty
/// without nudges.
std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges,
                            const MountingTolerance& tolerance);

}  // namespace dresslife::pipeline
