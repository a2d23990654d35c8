// The life of the best routings within the mounting tolerance.
//
// (T1) h_w = min(h, h_1, ..., h_n)   h: p10 life as drawn; h_i: with one clamp, ring or the length off by the
//                                    tolerance (nudges.h); 0 where that does not run
//
// h_w is at most h. So finalists are evaluated by falling h, until no other can have the largest h_w. One is given up
// when its h_w falls below that of another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/nudges.h"
#include "pipeline/advise/improve/outcome.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

struct Finalist {
  double hours = 0;  ///< h
  std::vector<Nudge> nudges;
  /// Runs `count` of its nudges from `first` on; outcomes in their order.
  std::function<std::vector<Outcome>(std::size_t first, std::size_t count)> run;
};

struct WithinTolerance {
  std::vector<ImprovementStory::Nudge> nudges;  ///< evaluated
  double least_hours = 0;                       ///< lower bound of h_w; h_w itself if whole
  bool whole = false;                           ///< all were evaluated
};

/// As many finalists as had to be evaluated. by_life: longest first.
std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& by_life);

/// Index of the largest h_w. Precondition: at least one, of which the first is whole.
std::size_t best_within(const std::vector<WithinTolerance>& judged);

/// "With a clamp or the length off by 10 mm it lives at least 0.7 times as long, ..."; a line, empty without nudges.
std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges, double off);

}  // namespace dresslife::pipeline
