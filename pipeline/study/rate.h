// Lives of a cable in the standard test rigs, compared with its ratings: a study with one job for every cable of a dresspack
// in every rig of the catalogue and of the cable's ratings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/job/rating.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// One cable in one rig.
struct RatedTest {
  std::string job;          ///< name of the job in the study
  std::string cable;        ///< name of the cable
  std::string rig;          ///< description: "torsion, 180 deg/m to either side"
  double rated_cycles = 0;  ///< cycles that the maker states; 0: no rating
  std::string source;       ///< source of the rating
};

struct RateStudy {
  Study study;
  std::vector<RatedTest> tests;  ///< one test per job of the study, in the order of the jobs
  std::string estimates{};       ///< dresspack.estimates of the file; empty: none
};

/// Returns a study of every cable of a dresspack's file in every rig of `rigs` (a folder of jobs) and in the rigs of its
/// ratings. Conductors and wires slide with friction if the cable has the keys of friction, else without friction.
/// sets: `--set` for every job. Errors: InputError for a file without cables.
RateStudy rate_study(const std::filesystem::path& file, const std::filesystem::path& rigs,
                     const std::vector<std::string>& sets);

/// Cycles of a rig: worst_wire is the median until the worst wire breaks. `conductor` contains the cycles by which 10, 50 and
/// 90 % of such cables have a conductor that lost its share of wires at one place.
struct CycleLives {
  double worst_wire = 0;
  /// conductor[1] if the inside is glued, and if it slips freely; of files without a distribution the median of the worst wire.
  double all_stick = 0, all_free = 0;
  std::array<double, 3> conductor{};  ///< NaN: not known
};
CycleLives cycles_of(const RankingRow& row);

/// Return the tests for a terminal, in their order, and as the CSV file rate.csv. rows: rows of the study's jobs, in any order.
std::string rate_table(const RateStudy& rated, const std::vector<RankingRow>& rows);
std::string rate_csv(const RateStudy& rated, const std::vector<RankingRow>& rows);

/// Returns the number of levels of parts in a component, including itself.
int levels_of(const Node& component);

/// Returns a rig as text, with its keys that have units: "torsion: length_m 1, twist_deg_per_m 180".
std::string rig_words(const Rig& rig);

}  // namespace dresslife::pipeline
