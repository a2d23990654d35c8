// The results of a search for its page and for the terminal.
#pragma once

#include <string>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// Pages of jobs are linked to where they are already written.
ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second,
                          const StudyPlaces& places);

/// Lines: the original jobs, the best candidate and its changes, or why none is feasible. off: mounting tolerance
/// [m].
std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, double off, const StudyPlaces& places);

}  // namespace dresslife::pipeline
