// The duties of a file, evaluated with the results of the study that the file names.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/mixture.h"
#include "pipeline/advise/plan/plan.h"
#include "pipeline/job/inspection.h"
#include "pipeline/life/unvalidated_modes.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// Lives under a duty in which one program runs in this share of the time, with unchanged repeats of the other programs.
struct LifeAtShare {
  double share_of_time = 0;
  LifePercentiles hours{};
};

/// One program of a duty.
struct DutyPart {
  std::string job;
  double repeats_per_hour = 0;
  double share_of_time = 0;
  /// [h] lives under the duty without this program; NaN: the order's other programs would change between each other, in a round
  /// that was not computed
  LifePercentiles without{};
  LifePercentiles as_twice{};  ///< [h] with twice as many repeats of it; NaN: they would take more than all the time
  /// from 0 (as `without`) to all time that the other programs leave; empty: it never runs
  std::vector<LifeAtShare> over_share{};
  std::string recording_of{};  ///< DutyProgram::recording_of
  /// ratio of its damage with the loose cables at other places of rest, one standard deviation to either side, to its damage at the
  /// medians; 1: no effect; 0: not known
  std::array<double, 2> at_other_rests{};
};

/// A mode that no test validates (unvalidated_modes.h), of one dresspack; of ratings, of one cable.
struct DutyMode {
  std::string mode, dresspack, place;
  double hours = 0;                                ///< lower bound of early_hours(), if all programs load one place
  double median = 0;                               ///< hours by which half have failed, with the same assumption
  double visible_from = UnvalidatedMode::unknown;  ///< largest value of the programs
};

struct DutyResult {
  std::string name;
  double hours_per_week = 0, robot_life_hours = 0;
  std::vector<DutyPart> parts;
  std::vector<std::string> modes;
  /// (mode) ratio of the damage with the changes between programs to the damage without; 1: no order
  std::vector<double> changes;
  DutyDamage damage;
  DutyLives lives;
  /// standard error of each of lives.percentiles, as a factor: RankingRow::planned_errors of the programs, weighted in the
  /// logarithm by their shares of the damage, as if all erred in the same direction; NaN: not known
  std::array<double, 3> errors{NAN, NAN, NAN};
  bool has_order = false;      ///< whether changes between the programs are counted
  double rounds_per_hour = 0;  ///< rounds of its order per hour
  std::vector<std::string>
      outside{};                 ///< "hard (25 %)": programs with the share of their repeats that belongs to no round
  double past_hours = 0;         ///< hours of the history; 0: none
  std::vector<DutyMode> others;  ///< modes that are not included in the hours above
  std::string not_evaluated;     ///< parts and modes without a life in one of the programs
  Inspection inspection;         ///< checks of its jobs
  std::vector<std::string>
      warnings;  ///< "hard: smallest bend radius: ...": the warnings of these programs that make it unreliable
  std::vector<std::string> doubtful;  ///< "hard (bend radius)": programs with warnings that make a plan unreliable
  /// "the doubtful input (least_bend_radius_mm) of hard": what a person has to confirm before the hours are used
  std::vector<std::string> unconfirmed;
};

/// Returns the modes under a duty. rows: (part) rows of its programs. Wear and damage add up. Rates and exponents are the same
/// for all programs, so percentiles add up, too. A wall is left out if its life is not credible in one of the
/// programs that run.
std::vector<DutyMode> other_modes(const std::vector<DutyPart>& parts, const std::vector<RankingRow>& rows);

/// Checks the programs before the study runs. Errors: InputError for a program that is no job of the study, for a study that
/// keeps no lives, and for programs with different dresspacks, routings or settings, because their damage does not add up.
void check_programs(const DutyFile& file, const Study& study);
/// Checks before the study runs that the programs fit into the hours of operation. repeat_seconds: (name of the job) duration of
/// one repeat; a program without an entry counts as no time. The moves of an order are not counted. Errors: InputError.
void check_hours(const DutyFile& file, const std::map<std::string, double>& repeat_seconds);
/// Returns a warning for duties whose programs start in different poses if the study does not give the pose in which the hose is
/// mounted: then the hose has another twist in each program. rows: null before the run (checks programs with poses in the jobs);
/// rows of the study after the run (checks programs in files, whose poses are in their strain.h5). Precondition:
/// check_programs(). Errors: InputError for a damaged strain.h5.
std::vector<Warning> mounting_warnings(const DutyFile& file, const Study& study, const std::vector<RankingRow>* rows);

/// Returns a warning for each mode that only the changes between the programs of an order damage at the medians. (D2) divides by
/// the damage of the programs, so it does not count these changes. Errors: as evaluated().
std::vector<Warning> uncounted_changes(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows);

/// Returns the rows of the programs of all duties.
std::vector<RankingRow> rows_of(const DutyFile& file, const std::vector<RankingRow>& rows);

/// Returns the results of all duties. Errors: InputError for a program without a result or without uncertain parameters, for
/// programs that take more than the whole time, and for a history that fewer than 1 in 1,000 samples survive.
std::vector<DutyResult> evaluated(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows);

/// Returns parts, doubts and unvalidated modes of the `needed` duties, without results over the samples. Errors: as evaluated(),
/// without histories.
std::vector<DutyResult> outlines(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                                 const std::set<std::string>& needed);

/// Usual numbers of worlds, and of dresspacks in each world. With 1,000 worlds the error of a probability of 10 % is 0.9 %. With 32
/// dresspacks in each and 10 to 427 survivors, predicted failures deviate from the law by less than 4 %, with 16 by up to 7 % (means of
/// 40 plans with at least 69 effective worlds).
constexpr std::size_t usual_worlds = 1000, usual_draws = 32;

/// Computes the lives of a plant's dresspacks under each of the `needed` duties (plan.h), for one or more numbers of worlds.
class PlantLives {
 public:
  /// Reads the results of the programs. Keeps a reference to the file. Errors: as evaluated(), without histories.
  PlantLives(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
             const std::set<std::string>& needed);
  ~PlantLives();
  PlantLives(const PlantLives&) = delete;
  PlantLives& operator=(const PlantLives&) = delete;
  /// Returns the lives by the names of the duties. draws: dresspacks in each world. keep_draws: fills LifeTable::of_draw.
  std::map<std::string, LifeTable> in(std::size_t worlds, std::size_t draws, bool keep_draws) const;

 private:
  struct Task;
  struct Read;
  std::unique_ptr<const Read> read_;
};

}  // namespace dresslife::pipeline
