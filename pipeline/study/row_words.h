// A row of the ranking in sentences, for the terminal and the pages: first what to do, then how sure that is,
// then what fails and why.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Whether no warning says that the strains themselves are wrong.
bool is_believable(const RankingRow& row);

/// "Plan a replacement after 1,300 h of motion (3.72 months).", or why not to plan with these hours. Empty: no result.
std::string action_words(const RankingRow& row);

/// The mode of which 1 of 10 has failed first, where that is before the headline and before the robot's own life: hours that
/// no test validates are not in the headline, and a reader must not take it alone. A wall does not count if its
/// law contradicts a published test. Null: none.
const UnvalidatedMode* earlier_unvalidated(const RankingRow& row);
/// "abrasion: from 1,080 h, jacket wear: from 6,870 h": these modes, the earliest first. Empty: none.
std::string earlier_words(const RankingRow& row);
/// Of a row in a table: "!" where a warning forbids to plan with its hours, "*" where one of these modes may come first. Empty: neither.
std::string plan_mark(const RankingRow& row);
/// "* Plan with this number, and inspect for modes that are not validated. easy, jacket wear: from 12,100 h. ! Do not plan with
/// this number before its warnings are cured. hard, bend radius." Empty: no row is marked.
std::string marks_note(const std::vector<RankingRow>& rows);
/// Below a table of many jobs: the modes that are not in its hours, and in how many jobs which of them may come first, as
/// their * says. Empty: none was evaluated.
std::string unvalidated_legend(const std::vector<RankingRow>& rows);

/// A life in a table: "1,300", or beyond the robot's own life (fatigue.robot_life_hours) "over 40,000".
std::string shown_life(const RankingRow& row, double hours);
/// "1,300 .. over 40,000"
std::string shown_range(const RankingRow& row, double low_hours, double high_hours);
/// The headline by the calendar: "7.2 months", or "over 9.6 years".
std::string shown_calendar(const RankingRow& row);
/// What shown_life() leaves out, in hours. Empty: nothing.
std::string uncapped_words(const RankingRow& row);

/// "71 % of the uncertainty is the friction inside the cables. One bending test of a cable (one hour) would
/// narrow the range from .. to about ..". Empty: nothing is uncertain.
std::string uncertainty_words(const RankingRow& row);

/// "signal cable 3/conductor 2, 0.12 m from the tool": the conductor that is likeliest to fail first. The worst wire need not be in
/// it. Empty: none can fail.
std::string failing_place_words(const RankingRow& row);

/// "Fails first: wires of signal cable, in 100 % of the samples, likeliest (its place). The worst wire is .., 0.12 m from the tool. Its most
/// damaging cycle ends at 144.3 s, during .."
std::string failure_words(const RankingRow& row);

/// When a first wire breaks with the job's own values, by the scatter of wires alone; and how much longer or shorter half of the
/// samples live than with these values, where that is more than a decade. Empty: not known, or no wire breaks.
std::string own_values_words(const RankingRow& row);

/// "The strain of this wire follows joint_6 most.", that this is no cause, and the command that tries it. Empty: not known.
/// That a joint is held, so the job does not do its program; empty: none is.
std::string held_words(const RankingRow& row);
std::string joint_words(const RankingRow& row);

/// "One repeat of the motion takes 13.8 s: 1 of 10 has failed after 108,000 repeats." Empty: none foreseen in the robot's life.
std::string repeat_words(const RankingRow& row);
/// Where the repeats of jobs take different times: that hours mislead. Empty: they do not.
std::string different_repeats_words(const std::vector<RankingRow>& rows);

/// "Lives longer than the next job in 93 of 100 samples.", and what that means. Empty: not known.
std::string order_words(const RankingRow& row);

/// "ESTIMATE, not in the dresspack: ...", once for all rows that have the same, a line each.
std::vector<std::string> estimate_words(const std::vector<RankingRow>& rows);

/// "1,300 .. 94,200,000 h"
std::string range_text(double low_hours, double high_hours);

}  // namespace dresslife::pipeline
