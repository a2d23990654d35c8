// Short runs as a search sees them.
#pragma once

#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/search/search.h"

namespace dresslife::pipeline {

/// Adds to a place what the short run of one more job says: the most of each limit. Once one of the jobs does
/// not run, the place does not, and only geometry grades it, (V1) to (V5). Precondition: look.ran of a place
/// without jobs.
void add_rehearsal(Look& look, const ScreenedList& list, const ScreenedCandidate& candidate);

}  // namespace dresslife::pipeline
