// The ranking of a study: its jobs by life, best first. The receipts also contain the root attributes of each life.h5
// (formats.cpp), so that a study of ten thousand jobs is gathered in less than a second.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/life/unvalidated_modes.h"
#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// Result of a job.
struct JobResult {
  std::string name;
  std::filesystem::path life_file;
  std::string failure;       ///< one line: why there is no life file; empty: the job is done
  std::string settings{};    ///< digest of its settings (JobState)
  std::vector<ResultValue> results{};  ///< attributes from its receipt; empty: read the file
  bool stale = false;  ///< the file is its last result, of other settings; `failure` says how the job stands
  std::string changed{};  ///< since then
};

/// Of a cable with a rating: what the program does beside its rig (relative_life.h).
struct RelativeLife {
  std::string cable, rig;      ///< in words
  double cycles_per_hour = 0;  ///< cycles of the rig with the damage of one hour of the program
  double rated_cycles = 0;
  double hours() const { return rated_cycles / cycles_per_hour; }
};

/// One row of the ranking. Lives without damage are infinite.
struct RankingRow {
  std::string job;
  std::filesystem::path life_file;
  std::string failure;   ///< empty: done, and the rest is valid
  bool stale = false;    ///< not done; the rest is the job's last result
  std::string changed;   ///< changes since that result, as text; empty: not known
  std::string settings;  ///< digest of the settings of the row; empty: not known
  /// Varied keys of the study with the job's values, as in its name; empty: not of a study.
  std::vector<std::pair<std::string, std::string>> varied;
  double life_repeats = 0;              ///< repeats of the motion until the worst wire breaks
  double life_hours = 0;                ///< hours of motion
  double life_months = 0;               ///< at the job's operating hours per week
  double life_repeats_all_stick = 0;    ///< bound: nothing in the cables slips
  double life_repeats_all_free = 0;     ///< bound: everything in the cables slips freely
  double repeat_seconds = 0;            ///< duration of one repeat [s]
  double damage_per_repeat = 0;         ///< of the worst wire
  std::string worst_dresspack;          ///< dresspack of the worst wire, among several; empty: the only one
  int worst_segment_from_tool = 0;      ///< of it, 1 is nearest to the tool; 0: no wire was evaluated
  double worst_position_from_tool = 0;  ///< along the dresspack, from the tool clamp [m]
  std::string worst_component;          ///< path of the wire, outermost part first; empty: none was evaluated
  double worst_time = 0;                ///< when its most damaging cycle closes [s]
  std::string worst_step;               ///< program line being executed then
  /// Hours of motion by which 10, 50, 90 % of such dresspacks have a broken wire, and a failed conductor; NaN: not
  /// known.
  std::array<double, 3> first_wire_hours{unknown, unknown, unknown};
  /// Hours to plan with: by then 10, 50, 90 % have a conductor that has lost its share of wires at one place.
  std::array<double, 3> planned_hours{unknown, unknown, unknown};
  /// The same with the scatter of wires only; NaN: nothing else was uncertain.
  std::array<double, 3> scatter_hours{unknown, unknown, unknown};
  std::string life_response;  ///< life as a function of the parameters (life_response.h); empty: not known
  std::string life_shares;    ///< shares of the uncertainty: "friction_inside 53 %; strength 29 %"
  std::string measure_next;   ///< the parameter with the largest share; empty: the scatter of wires
  double measure_next_share = 0;
  std::optional<double> outlives_next;    ///< share of samples in which it lives longer than the next row's job
  std::size_t rank = 0;  ///< 1 is best; jobs that cannot be separated share one. 0: no present result
  /// planned_hours if everything inside the cables were glued, and if it slipped freely, over the same samples.
  std::array<double, 3> glued_hours{unknown, unknown, unknown}, free_hours{unknown, unknown, unknown};
  std::string failing_mode;       ///< what fails first in most of the samples: "wires of signal cable"
  double failing_mode_share = 0;  ///< in which share of them
  std::string best_test;  ///< the parameter whose test narrows planned_hours most; empty: none does
  double tested_p10 = unknown, tested_p90 = unknown;  ///< planned_hours after that test
  /// Standard errors of planned_hours as factors (pipeline/life/first_failure.h); NaN: not known.
  std::array<double, 3> planned_errors{unknown, unknown, unknown};
  double planned_months = unknown;                    ///< planned_hours[0] in months
  /// Tables show a longer life as longer than the robot's [h]; infinite: no robot moves.
  double robot_life_hours = std::numeric_limits<double>::infinity();
  std::string failing_conductor;          ///< most likely to fail first; empty: unknown or none
  double failing_position_from_tool = 0;  ///< [m]
  std::array<double, 3> conductor_hours{unknown, unknown, unknown};
  double worst_shear_range = 0;  ///< of the worst wire's surface; 0: unknown
  std::string held_joint;   ///< motion.hold_joint; empty: none
  std::string worst_joint;  ///< whose motion costs most; "carrying": none between the clamps; empty: unknown
  double worst_joint_share = 0;  ///< of the worst wire's damage; above 1 where other joints relieve
  std::vector<UnvalidatedMode> unvalidated;  ///< modes that are not in the hours above
  std::string not_evaluated;                 ///< parts and modes without a life; empty: an older file
  /// What the strains ask of the cables: largest force over that at which one tears, and moment of all of
  /// them on the hose at a clamp over the largest that it carries there. Absent: no cable slides, or not
  /// known.
  std::optional<double> largest_force_share, clamp_moment_share;
  std::optional<double> strain_relief_share;  ///< pull of a cable at a clamp over what strain reliefs are tested with; absent: as above
  std::optional<double>
      loose_mesh_error;  ///< share of loose cables' curvature that their mesh misses; absent: none lies loose
  std::string estimates;  ///< keys that the dresspacks leave out, with their estimated values; empty: none, or not known
  /// The worst wire's life if its mean stress never relaxed, and without mean stress; absent: not known.
  std::optional<double> hours_mean_stress_kept, hours_without_mean_stress;
  /// Of all its stages; absent: not known.
  std::optional<std::vector<Warning>> warnings;
  std::optional<RelativeLife> relative;  ///< of the rating with the shortest life; absent: no cable has one
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// The unvalidated mode of this name that fails first by its median; null: it was not evaluated.
  const UnvalidatedMode* unvalidated_mode(std::string_view mode) const;
  bool done() const { return failure.empty(); }
  bool damaged() const { return worst_segment_from_tool > 0 && damage_per_repeat > 0; }
  bool has_result() const { return done() || stale; }
  bool waits() const {
    return failure == "stale" || failure == "to do";
  }  ///< has not failed with the present settings
  bool force_ok() const;  ///< no more than believable_share of what cables and clamps bear
  double hours_of(double repeats) const { return repeats * repeat_seconds / 3600; }
  bool planned() const { return !std::isnan(planned_hours[0]); }
  /// planned_hours with the scatter of wires only.
  const std::array<double, 3>& by_scatter() const {
    return std::isnan(scatter_hours[0]) ? planned_hours : scatter_hours;
  }
  /// The p10 life; of older files the worst wire's.
  double headline_hours() const { return planned() ? planned_hours[0] : life_hours; }
  double headline_months() const { return planned() ? planned_months : life_months; }
  double headline_repeats() const {
    return planned() ? planned_hours[0] * 3600 / repeat_seconds : life_repeats;
  }
};

/// Two jobs have different ranks if the one that stands before the other lives longer in this share of the samples: 1 of
/// 10 such comparisons is wrong.
constexpr double separated_share = 0.9;

/// One row per job, longest p10 first, equal lives by name, failed jobs last. Jobs whose p10 is longer than the robot's
/// life need no replacement: the first of them outlives most others in most samples. A life file that is missing or
/// cannot be read gives a failed row with the reason; nothing is thrown.
std::vector<RankingRow> read_ranking(const std::vector<JobResult>& results);

/// Of a study: finished jobs, then the last results of stale jobs, then the states of the others. results_of: in the same order up
/// to jobs beyond the robot's life, without ranks and certainties of the order, which take most of the time of a large study.
std::vector<RankingRow> results_of(const Study& study, const StudyPlaces& places,
                                   const std::vector<JobState>& states);
std::vector<RankingRow> ranking_of(const Study& study, const StudyPlaces& places,
                                   const std::vector<JobState>& states);

/// ranking.csv: a header and one row per job, quoted after RFC 4180 with line feeds. Numbers read back exactly; "inf"
/// without damage. `status` is done; stale: the cells are the job's last result, `message` the changes since; failed,
/// with the reason, or "to do", both with empty cells. Text that a spreadsheet would take for a formula begins with an
/// apostrophe.
std::string ranking_csv(const std::vector<RankingRow>& rows);

/// "stale: since this result routing.free_length_m 2.035 -> 2.1", and why a job failed with the present settings.
std::string stale_words(const RankingRow& row);

/// "one hour does the damage of 1,200 rated cycles of lead; 5,000,000 rated: 4,200 h (torsion: ..)"
std::string relative_words(const RelativeLife& relative);

/// A sentence on unrealistic forces; empty: they are realistic.
std::string force_words(const RankingRow& row);

/// The ranking for a terminal: of one job first what to do; then a table with a line per job, and below it
/// the rest of each job in sentences (row_words.h), in lines of at most `width` columns. Nothing is cut off.
/// Ends with a line feed.
std::string ranking_table(const std::vector<RankingRow>& rows, std::size_t width = 120);

}  // namespace dresslife::pipeline
