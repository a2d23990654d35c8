// What a search found, told: for its page, and in lines for the terminal.
#pragma once

#include <string>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// The best is run with each clamp and length off by `off` [m] (nudges.h); 0: it is not. Pages of jobs are
/// linked to where they are already written.
ImprovementStory story_of(const Improvement& found, const Finals& finals, const ImproveRequest& request,
                          double off, const StudyPlaces& places, const MakeRows& make_rows);

/// Lines: how it was, the best and what was changed for it, or what stands against it. off: as of the story
/// [m].
std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, double off, const StudyPlaces& places);

}  // namespace dresslife::pipeline
