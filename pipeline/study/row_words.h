// Sentences about a row of the ranking, for the terminal and the pages: first the action, then its certainty, then the failing
// part and the cause.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Returns false if a warning says that the strains themselves are wrong.
bool is_believable(const RankingRow& row);

/// Returns "Plan a replacement after 1,300 h of motion (3.72 months).", or the reason not to plan with these hours. Empty: the
/// row has no result.
std::string action_words(const RankingRow& row);

/// Lets commands in the row's words name the job's file and the sets in force, as words of a shell.
void name_file(RankingRow& row, const std::filesystem::path& file, const std::vector<std::string>& sets = {});
/// Returns this text, or the word JOB if it is not known.
std::string job_file(const RankingRow& row);

/// Returns the hours at which the dresspack is replaced: those of the headline, at most the robot's life. A mode without a
/// validated law needs no action if 1 of 10 fails by it later.
double replacement_hours(const RankingRow& row);
/// Returns the mode by which 1 of 10 fails first, if that happens before replacement_hours(). The headline does not include
/// hours that no test validates, so a reader must also see this mode. A wall whose law
/// contradicts a published test is not considered. Null: no such mode.
const UnvalidatedMode* earlier_unvalidated(const RankingRow& row);
/// Returns all modes with that property, the earliest first: "abrasion: from 1,080 h, jacket wear: from 6,870 h". Empty: none.
std::string earlier_words(const RankingRow& row);
/// Returns the mark of a row in a table: "!" if a warning forbids to plan with its hours, "*" if earlier_unvalidated() is not
/// null. Empty: neither.
std::string plan_mark(const RankingRow& row);
/// Returns the legend of the marks: "* Plan with this number, and inspect for modes that are not validated. easy, jacket wear:
/// from 12,100 h. ! Do not plan with this number before its warnings are cured. hard, bend radius." Empty: no row is marked.
std::string marks_note(const std::vector<RankingRow>& rows);
/// Returns the text below a table of many jobs: the modes that its hours do not include, and for each mode the number of jobs
/// (those marked *) in which it may come first. Empty: no mode was evaluated.
std::string unvalidated_legend(const std::vector<RankingRow>& rows);

/// Returns a life for a table: "1,300", or "over 40,000" beyond the robot's own life (fatigue.robot_life_hours).
std::string shown_life(const RankingRow& row, double hours);
/// Returns the range between a life's bounds: "1,300 .. over 40,000". "never": fewer dresspacks fail.
std::string shown_range(const RankingRow& row, double low_hours, double high_hours);
/// Returns the headline in calendar time: "7.2 months", or "over 9.6 years".
std::string shown_calendar(const RankingRow& row);
/// Returns the hours that shown_life() replaces by "over ..". Empty: it replaces none.
std::string uncapped_words(const RankingRow& row);

/// Returns "71 % of the uncertainty is the friction inside the cables. The measurement that narrows the range most: one bending
/// test of a cable (one hour). If it confirms the estimate, the range becomes about .. (now ..)." Empty: no input is uncertain.
std::string uncertainty_words(const RankingRow& row);

/// Returns the conductor that is likeliest to fail first: "signal cable 3/conductor 2, 0.12 m from the tool". The worst wire may
/// be in another conductor. Empty: no conductor can fail.
std::string failing_place_words(const RankingRow& row);

/// Returns "Fails first: wires of signal cable, in 100 % of the samples that fail, likeliest (its place). The worst wire is .., 0.12 m from
/// the tool. Its most damaging cycle ends at 144.3 s, during ..".
std::string failure_words(const RankingRow& row);

/// Returns the hours by which a first wire breaks with the job's own values, by the scatter of wires alone. Adds the factor
/// between the median of the samples and this life if it is more than a decade. Empty: not known, or no wire breaks.
std::string own_values_words(const RankingRow& row);

/// Returns "the 10 % value by a factor of 2.1, the 50 % value by a factor of 2" of standard errors of the percentiles
/// (RankingRow::planned_errors). Factors below 1.05 and unknown ones are left out. Empty: none is left.
std::string factor_words(const std::array<double, 3>& errors);

/// Returns a warning that a joint is held, so that the job does not perform its program. Empty: no joint is held.
std::string held_words(const RankingRow& row);
/// Returns "The strain of this wire follows joint_6 most.", a remark that this is no cause, and the command that tests it.
/// Empty: not known.
std::string joint_words(const RankingRow& row);

/// Returns "One repeat of the motion takes 13.8 s: 1 of 10 has failed after 108,000 repeats." Empty: no failure is expected
/// within the robot's life.
std::string repeat_words(const RankingRow& row);
/// Returns remarks on the order of the jobs: hours mislead if the repeats have different durations, and ranks without uncertain
/// parameters compare the jobs' own values only, and makers' ratings may change only some jobs. Empty: nothing misleads.
std::string comparison_words(const std::vector<RankingRow>& rows);

/// Returns "Lives longer than the next job in 93 of 100 samples.", and whether the difference is clear. Empty: not known.
std::string order_words(const RankingRow& row);

/// Returns "ESTIMATE, not in the dresspack: ..." once for all rows with the same estimates, one line each.
std::vector<std::string> estimate_words(const std::vector<RankingRow>& rows);

/// Returns "1,300 .. 94,200,000 h".
std::string range_text(double low_hours, double high_hours);

}  // namespace dresslife::pipeline
