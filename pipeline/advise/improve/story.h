// The results of a search for its page and for the terminal.
#pragma once

#include <optional>
#include <string>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// Returns the results for the page. Existing pages of jobs are linked.
ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second, const StudyPlaces& places);

/// Returns sentences about the gain of a candidate over the original jobs; empty: these do not run. longer_in:
/// ImprovementStory::longer_in.
std::string gain_words(const Merit& best, const Outcome& after, const Merit& original, const Outcome& before,
                       const std::optional<double>& longer_in);

/// Returns lines: the original jobs, the best candidate, its gain and its changes, or the reason why none is feasible.
std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, const MountingTolerance& tolerance, const StudyPlaces& places);

/// Returns the remedy of a warning without the clamps that a search has already tried; empty: there is no other remedy.
std::string remedy_after_search(const std::string& remedy);

/// Returns a line for each limit that a proposed job exceeds at other values of stiffness, slack or friction, with the remedies
/// that are left after a search, and one if its hose can be mounted on two sides; empty: none.
std::string left_at_other_values(const RankingRow& row);

/// Returns a line with the share of dresspacks beyond the limit that most of them exceed at other values, and that of the original
/// job; empty: the proposed job exceeds none, or the original job is no reference (M1).
std::string beyond_words(const Outcome& proposed, const Outcome& original);

}  // namespace dresslife::pipeline
