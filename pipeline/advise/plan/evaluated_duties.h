// The duties of a file, evaluated from the results of the study that it names.
#pragma once

#include <map>
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

/// Lives under a duty in which one program runs in this share of the time, all others as often as before.
struct LifeAtShare {
  double share_of_time = 0;
  LifePercentiles hours{};
};

/// One program of a duty.
struct DutyPart {
  std::string job;
  double repeats_per_hour = 0;
  double share_of_time = 0;
  LifePercentiles without{}, as_twice{};  ///< [h] under the duty without it, and if it ran twice as often
  std::vector<LifeAtShare> over_share{};  ///< from 0 to all of the time that the others leave; empty: it never runs
  std::string recording_of{};  ///< as in DutyProgram
};

/// A mode that no test validates (unvalidated_modes.h), of one dresspack and, of ratings, one cable.
struct DutyMode {
  std::string mode, dresspack, place;
  double hours = 0;   ///< early_hours() at the soonest, if all programs load one place
  double median = 0;  ///< half have failed by then, of the same
  double visible_from = UnvalidatedMode::unknown;  ///< the largest of the programs
};

struct DutyResult {
  std::string name;
  double hours_per_week = 0, robot_life_hours = 0;
  std::vector<DutyPart> parts;
  std::vector<std::string> modes;
  std::vector<double> changes;  ///< (mode) damage with the changes between programs over that without; 1: no order
  DutyDamage damage;
  DutyLives lives;
  bool has_order = false;       ///< the changes between programs count
  double rounds_per_hour = 0;   ///< of its order
  std::vector<std::string> outside{};  ///< "hard (25 %)": programs with a share of their repeats in no round
  double past_hours = 0;  ///< 0: no history
  std::vector<DutyMode> others;       ///< not in the hours above
  std::string not_evaluated;          ///< parts and modes without a life
  Inspection inspection;              ///< of its jobs
  std::vector<std::string> doubtful;  ///< "hard (bend radius)": programs with warnings that spoil a plan
};

/// Modes under a duty. rows: (part) of its programs. Wear and damage add up. Rates and exponents are the same for all
/// programs, so that percentiles add up, too. A wall whose life is not credible is left out.
std::vector<DutyMode> other_modes(const std::vector<DutyPart>& parts, const std::vector<RankingRow>& rows);

/// Called before the study runs. Errors: InputError for a program that is no job of the study, for a study that keeps no lives, and for
/// programs on different dresspacks, routings or settings: their damage does not add up.
void check_programs(const DutyFile& file, const Study& study);
/// Duties whose programs start in different poses and whose study does not say in which the hose is mounted: each program's
/// hose then has another twist. rows: of the study after its run, for programs in files, whose poses their strain.h5 holds;
/// null before the run, for programs with their poses in the jobs. Precondition: check_programs(). Errors: InputError for a
/// damaged strain.h5.
std::vector<Warning> mounting_warnings(const DutyFile& file, const Study& study,
                                       const std::vector<RankingRow>* rows);

/// The rows of the programs that duties name.
std::vector<RankingRow> rows_of(const DutyFile& file, const std::vector<RankingRow>& rows);

/// Errors: InputError for a program without a result or without uncertain parameters, for programs that take more than
/// the whole time, and for a history that less than 1 in 1,000 samples survives.
std::vector<DutyResult> evaluated(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows);

/// Parts, doubts and modes without validation of the `needed` duties, and nothing of samples. Errors: as evaluated(), without
/// histories.
std::vector<DutyResult> outlines(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                                 const std::set<std::string>& needed);

/// 500 worlds: a probability of 10 % is known to 1.3 %.
constexpr std::size_t usual_worlds = 500;

/// Lives of the dresspacks of a plant under each of the `needed` duties (plan.h). keep_draws: with LifeTable::of_draw. Errors: as evaluated(), without histories.
std::map<std::string, LifeTable> life_tables(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                                             const std::set<std::string>& needed, bool keep_draws = false, std::size_t worlds = usual_worlds);

}  // namespace dresslife::pipeline
