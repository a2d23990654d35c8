// What a search found, told: for its page, and in lines for the terminal.
#pragma once

#include <string>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// Pages of jobs are linked to where they are already written.
ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second,
                          const StudyPlaces& places);

/// Lines: how it was, the best and what was changed for it, or what stands against it. off: the
/// tolerance by which finals were judged [m].
std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, double off, const StudyPlaces& places);

}  // namespace dresslife::pipeline
