#include "pipeline/advise/improve/rehearsed.h"

#include <algorithm>

#include "pipeline/advise/improve/outcome.h"

namespace dresslife::pipeline {

void add_rehearsal(Look& look, const ScreenedList& list, const ScreenedCandidate& candidate) {
  const bool runs = candidate.refusal.empty();
  if (!runs && look.ran) look = {look.place, false, {}, {}};
  if (runs != look.ran) return;
  const std::vector<double> beyond =
      runs ? limits_of_rehearsal(list.limits, candidate.beyond) : candidate.beyond;
  if (runs) add_bends(look.pieces, candidate.bends);
  if (look.beyond.empty()) look.beyond = beyond;
  for (std::size_t k = 0; k < beyond.size(); ++k) look.beyond[k] = std::max(look.beyond[k], beyond[k]);
}

}  // namespace dresslife::pipeline
