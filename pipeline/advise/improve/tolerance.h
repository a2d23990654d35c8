// The best routings within the mounting tolerance.
//
// (T1) m_w = min(m, m_1, ..., m_n)   m: merit (merit.h) as drawn; m_i: with one clamp, ring, length or the turn of the end off by the
//                                    tolerance (nudges.h); the least merit where that does not run
//
// m_w is at most m. So finalists are evaluated by falling m, until no other can have the largest m_w. One is given up
// when its m_w falls below that of another. Three are evaluated, and more while all of them have an m_i that does not run.
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
  /// Runs `count` of its nudges from `first` on; outcomes in their order.
  std::function<std::vector<Outcome>(std::size_t first, std::size_t count)> run;
};

struct WithinTolerance {
  std::vector<ImprovementStory::Nudge> nudges;  ///< evaluated
  Merit worst;                                  ///< upper bound of m_w; m_w itself if whole
  Outcome worst_outcome;                        ///< with that merit
  bool whole = false;                           ///< all were evaluated
};

/// One finalist, its nudges until `enough` of the worst merit so far.
WithinTolerance within_tolerance(const Finalist& finalist, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough);

/// Results of as many finalists as had to be evaluated, in their order. best_first: by merit. as_it_is: the job before any change (merit_of()).
std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first,
                                              const Outcome& as_it_is);

/// Index of the largest m_w. Precondition: at least one, of which the first is whole.
std::size_t best_within(const std::vector<WithinTolerance>& judged);

/// "With a clamp or length off by 10 mm, .. or an end turned by 10 deg the wires live at least 0.7 times as long, ..."; a line, empty
/// without nudges.
std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges,
                            const MountingTolerance& tolerance);

}  // namespace dresslife::pipeline
