// The results of a search for its page and for the terminal.
#pragma once

#include <optional>
#include <string>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// Pages of jobs are linked to where they are already written.
ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second,
                          const StudyPlaces& places);

/// What a candidate gains over the original jobs, in sentences; empty: they do not run. longer_in: ImprovementStory.
std::string gain_words(const Merit& best, const Outcome& after, const Merit& original, const Outcome& before,
                       const std::optional<double>& longer_in);

/// Lines: the original jobs, the best candidate, its gain and its changes, or why none is feasible.
std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, const MountingTolerance& tolerance,
                              const StudyPlaces& places);

}  // namespace dresslife::pipeline
