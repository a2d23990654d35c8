// The ranking of a study: its jobs by life, best first. The receipts repeat the root attributes of each life.h5
// (formats.cpp), so that the rows of ten thousand jobs are collected in less than a second.
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
  std::string failure;                 ///< reason in one line why no life file exists; empty: the job is done
  std::string settings{};              ///< digest of the job's settings (JobState)
  std::vector<ResultValue> results{};  ///< attributes of life.h5 from its receipt; empty: read the file
  bool stale =
      false;  ///< the file is the job's last result, made with other settings; `failure` contains the state of the job
  std::string changed{};  ///< changes since that result, as text
  std::string
      simulated{};  ///< recipe of its simulation; equal recipes give the same motion of the hose. Empty: not known
};

/// Comparison of a job with the test rig of a cable that has a rating (relative_life.h).
struct RelativeLife {
  std::string cable, rig;      ///< names for messages
  double cycles_per_hour = 0;  ///< cycles of the rig that do the damage of one hour of the program
  double rated_cycles = 0;
  double hours() const { return rated_cycles / cycles_per_hour; }
};

/// One row of the ranking. Lives without damage are infinite; those of a job without wires are unknown.
struct RankingRow {
  std::string job;
  std::filesystem::path life_file;
  std::string file{};     ///< see name_file(); empty: not known
  std::string failure;    ///< empty: the job is done and the other members are valid
  bool stale = false;     ///< the job is not done; the other members describe its last result
  std::string changed;    ///< changes since that result, as text; empty: not known
  std::string settings;   ///< digest of the settings that belong to the row; empty: not known
  std::string simulated;  ///< JobResult::simulated
  /// (varied key) key and the job's value, as in the job's name; empty: the job belongs to no study.
  std::vector<std::pair<std::string, std::string>> varied;
  double life_repeats = unknown;            ///< repeats of the motion until the worst wire breaks
  double life_hours = unknown;              ///< hours of motion
  double life_months = unknown;             ///< life_hours in months, at the job's operating hours per week
  double life_repeats_all_stick = unknown;  ///< bound: no part of the cables slips
  double life_repeats_all_free = unknown;   ///< bound: all parts of the cables slip without friction
  double repeat_seconds = 0;                ///< duration of one repeat [s]
  double damage_per_repeat = 0;             ///< damage of the worst wire
  std::string worst_dresspack;              ///< dresspack of the worst wire, among several; empty: the only one
  int worst_segment_from_tool =
      0;  ///< segment of the worst wire's place, 1 is nearest to the tool; 0: no wire was evaluated
  double worst_position_from_tool = 0;  ///< place of the worst wire along the dresspack, from the tool clamp [m]
  std::string worst_component;          ///< path of the worst wire, outermost part first; empty: no wire was evaluated
  double worst_time = 0;                ///< time at which the most damaging cycle of the worst wire closes [s]
  std::string worst_step;               ///< program line that runs at worst_time
  /// (percentile) hours of motion by which 10, 50, 90 % of such dresspacks have a broken wire; NaN: not known.
  std::array<double, 3> first_wire_hours{unknown, unknown, unknown};
  /// (percentile) hours to plan with: by then 10, 50, 90 % have a conductor that has lost its share of wires at one place.
  std::array<double, 3> planned_hours{unknown, unknown, unknown};
  /// planned_hours with the scatter of wires only; NaN: no other input was uncertain.
  std::array<double, 3> scatter_hours{unknown, unknown, unknown};
  std::string life_response;  ///< life as a function of the uncertain parameters (life_response.h); empty: not known
  std::string life_shares;    ///< shares of the uncertainty by cause: "friction_inside 53 %; strength 29 %"
  std::string
      measure_next;  ///< uncertain parameter with the largest share; empty: the scatter of wires has the largest share
  double measure_next_share = 0;
  std::optional<double> outlives_next;  ///< share of samples in which the job lives longer than the job of the next row
  /// 1 is best; jobs that cannot be separated share a rank; 0: the job has no result of its present settings
  std::size_t rank = 0;
  /// planned_hours if all parts inside the cables were glued, and if they slipped without friction, for the same samples.
  std::array<double, 3> glued_hours{unknown, unknown, unknown}, free_hours{unknown, unknown, unknown};
  std::string failing_mode;       ///< mode that fails first in most of the samples that fail: "wires of signal cable"
  double failing_mode_share = 0;  ///< in which share of them
  std::string best_test;          ///< parameter whose test narrows planned_hours most; empty: no test narrows it
  double tested_p10 = unknown, tested_p90 = unknown;  ///< planned_hours[0] and [2] after that test
  /// (percentile) standard errors of planned_hours, as factors (pipeline/life/first_failure.h); NaN: not known.
  std::array<double, 3> planned_errors{unknown, unknown, unknown};
  double planned_months = unknown;  ///< planned_hours[0] in months
  /// Life of the robot [h]: tables show a longer life as "over" this life; infinite: no robot moves.
  double robot_life_hours = std::numeric_limits<double>::infinity();
  std::string failing_conductor;          ///< conductor that is most likely to fail first; empty: unknown or none
  double failing_position_from_tool = 0;  ///< place of failing_conductor, from the tool clamp [m]
  std::array<double, 3> conductor_hours{unknown, unknown, unknown};
  double worst_shear_range = 0;  ///< range of shear strain on the worst wire's surface; 0: unknown
  std::string held_joint;        ///< motion.hold_joint; empty: none
  /// joint whose motion damages the worst wire most; "carrying": no joint between the clamps; empty: unknown
  std::string worst_joint;
  double worst_joint_share = 0;  ///< its share of the worst wire's damage; above 1 if other joints reduce the damage
  std::vector<UnvalidatedMode> unvalidated;  ///< failure modes that are not included in the hours above
  std::string not_evaluated;                 ///< parts and failure modes without a computed life; empty: none
  /// Loads of the cables: largest force over the force that tears a cable; moment of all cables on the hose at a clamp over
  /// the largest moment that the hose bears there. Absent: no cable slides, or not known.
  std::optional<double> largest_force_share, clamp_moment_share;
  /// pull of a cable at a clamp over the test load of strain reliefs; absent: as largest_force_share
  std::optional<double> strain_relief_share;
  std::optional<double>
      loose_mesh_error;  ///< share of the curvature of loose cables that their mesh misses; absent: no cable lies loose
  double moving_places = 0;  ///< places of loose cables at which they do not end the repeat where they began it
  std::string
      estimates;  ///< keys that the dresspacks leave out, with their estimated values; empty: none, or not known
  /// Hours of the worst wire if its mean stress never relaxed, and without mean stress; absent: not known.
  std::optional<double> hours_mean_stress_kept, hours_without_mean_stress;
  /// Warnings of all stages; absent: not known.
  std::optional<std::vector<Warning>> warnings;
  std::optional<RelativeLife>
      relative;  ///< relative life of the rating with the shortest life; absent: no cable has a rating
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// Returns the unvalidated mode `mode` that fails first, by its median, else by its early hours or share; null: not evaluated.
  const UnvalidatedMode* unvalidated_mode(std::string_view mode) const;
  bool done() const { return failure.empty(); }
  bool has_wires() const { return worst_segment_from_tool > 0; }
  bool damaged() const { return has_wires() && damage_per_repeat > 0; }
  bool has_result() const { return done() || stale; }
  bool waits() const {
    return failure == "stale" || failure == "to do";
  }  ///< the job has not failed with its present settings
  bool force_ok()
      const;  ///< whether both shares are at most believable_share of the forces that cables and clamps bear
  double hours_of(double repeats) const { return repeats * repeat_seconds / 3600; }
  bool planned() const { return !std::isnan(planned_hours[0]); }
  /// Returns scatter_hours; planned_hours if no other input was uncertain.
  const std::array<double, 3>& by_scatter() const {
    return std::isnan(scatter_hours[0]) ? planned_hours : scatter_hours;
  }
  /// planned_hours[0]; without wires the life of the worst wire.
  double headline_hours() const { return planned() ? planned_hours[0] : life_hours; }
  double headline_months() const { return planned() ? planned_months : life_months; }
  double headline_repeats() const { return planned() ? planned_hours[0] * 3600 / repeat_seconds : life_repeats; }
};

/// Two consecutive jobs have different ranks if the first lives longer in this share of the samples: 1 of 10 such
/// comparisons is wrong.
constexpr double separated_share = 0.9;

/// Returns one row per job: longest p10 first, jobs with equal lives by name, failed jobs last. Jobs whose p10 is longer than
/// the robot's life need no replacement: they are ordered by how many other jobs they outlive, in the mean over the samples.
/// A life file that is missing or cannot be read gives a failed row with the reason. Never throws.
std::vector<RankingRow> read_ranking(const std::vector<JobResult>& results);

/// Return the rows of a study: finished jobs, then the last results of stale jobs, then the states of the other jobs.
/// results_of() leaves out the order beyond the robot's life, ranks and outlives_next, which take most of the time of a
/// large study.
std::vector<RankingRow> results_of(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states);
std::vector<RankingRow> ranking_of(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states);

/// Returns ranking.csv: a header and one row per job, quoted after RFC 4180, with line feeds. Numbers are exact when they are
/// read back; "inf" means no damage. `status` is "done"; "stale" (the cells are the job's last result, `message` the changes
/// since); "failed" with the reason, or "to do", both with empty cells. Text that a spreadsheet would read as a formula begins
/// with an apostrophe.
std::string ranking_csv(const std::vector<RankingRow>& rows);

/// Returns "stale: since this result routing.free_length_m 2.035 -> 2.1", and the reason of a failure with present settings.
std::string stale_words(const RankingRow& row);

/// Returns "one hour does the damage of 1,200 rated cycles of lead; 5,000,000 rated: 4,200 h (torsion: ..)".
std::string relative_words(const RelativeLife& relative);

/// Returns a sentence about unrealistic forces; empty: they are realistic.
std::string force_words(const RankingRow& row);

/// Returns the ranking for a terminal. For one job the actions come first. Then a table with a line per job follows, and below
/// it the sentences of row_words.h about each job, in lines of at most `width` columns. No cell is cut off. Ends with "\n".
std::string ranking_table(const std::vector<RankingRow>& rows, std::size_t width = 120);

struct ShownRows {
  std::vector<std::size_t> indices;  ///< rising; of a short ranking all rows
  std::string summary;               ///< one line about the other rows, with a line feed; empty: all rows are shown
};

/// Selects from a long ranking the best jobs, the worst jobs, the first failed jobs and the first jobs with warnings. rows: best
/// first, failed last.
ShownRows shown_rows(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
