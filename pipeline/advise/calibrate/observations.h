// Observations of cables and wires, compared with what the model says: a table of observations. Each has the
// job that does to the model's cable what was done to the real one, and the values that are not known.
//
//   observations:
//     - name: wenglor_chain
//       job: {motion: {rig: {...}}, dresspack: {cable: {...}}}      a job, or a file of one
//       vary: {fatigue.material: [copper_halved, copper_annealed]}  what is not known; every combination
//                                                                   becomes a job
//       cycles: 2e+6                                                or hours
//       outcome: rating
//       source: ...
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

class Fields;

/// broken: so long it lived; broken_by: no specimen lived longer; run_out: it had not failed then; rating:
/// its maker promises so much.
enum class ObservedEnd { broken, broken_by, run_out, rating };
constexpr std::string_view word(ObservedEnd value) {
  return word_at({"broken", "broken_by", "run_out", "rating"}, value);
}
/// Whether the true life is known not to be longer, and known not to be shorter.
constexpr bool bounds_above(ObservedEnd value) {
  return value == ObservedEnd::broken || value == ObservedEnd::broken_by;
}
constexpr bool bounds_below(ObservedEnd value) { return value != ObservedEnd::broken_by; }

/// What had to happen for it to count as failed: a wire, or a share of a conductor's
/// (fatigue.failed_wires_percent).
enum class FailureCriterion { first_wire, conductor };
constexpr std::string_view word(FailureCriterion value) {
  return word_at({"first_wire", "conductor"}, value);
}

struct Observation {
  std::string name, what, source, note;
  // What was observed, one of:
  std::optional<double> cycles, hours;  ///< that it lived [cycles, h]
  std::optional<double> stiffness;      ///< moment over curvature of the cable, bent from straight [N m2]
  std::optional<double> decrement;      ///< of the cable's free swing, held at one end [1]
  std::filesystem::path bending;        ///< a bending test as a table (measured_bending.h); empty: none

  double at_curvature = 1;  ///< of stiffness; of decrement beside the clamp, at the end of a swing [1/m]
  double decrement_without_slip = 0;  ///< of decrement, what polymer and air have, to be taken off [1]
  double noise_percent = 5;           ///< of a measured moment or decrement
  double cycles_per_repeat = 1;       ///< that the observer counts in one repeat of the job's motion
  ObservedEnd outcome = ObservedEnd::broken;
  FailureCriterion criterion = FailureCriterion::conductor;
  int specimens = 1;
  double unshared_log10 = universal_slopes;  ///< of life, that this test and no other has of its own
  /// Rules that foretell lives from a metal's name are within a factor of 3 in four of five cases (Nachtigall
  /// 1975).
  static constexpr double universal_slopes = 0.37;
  std::vector<std::size_t> jobs;  ///< of the study that are its variants

  bool is_life() const { return cycles || hours; }
};
void describe(Fields& f, Observation& observation);

/// An observation with the jobs that could be what was done: one per combination of what is not known.
struct ObservedTest {
  Observation observation;
  struct Variant {
    std::string name;  ///< fit for a folder
    Node job;
    std::string failure;  ///< why the job cannot be made, else empty
  };
  std::vector<Variant> variants;
  std::string text;  ///< of the row, for a digest
  Where where;
};

/// Errors: InputError at the place in the file.
std::vector<ObservedTest> read_observed_tests(const std::filesystem::path& file);

struct ValidationStudy {
  Study study;
  std::vector<Observation> observations;
};

/// Those of lives. Errors: InputError at the place in the file. A variant that cannot be is told in its job's
/// failure.
ValidationStudy read_observations(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// Lives by which 10, 50 and 90 % have failed by the observation's criterion, in the observer's unit;
/// infinite without damage.
std::array<double, 3> lives_of(const Observation& observation, const RankingRow& row);

/// Of a life [cycles or h].
inline double observed_life(const Observation& observation) {
  return observation.cycles ? *observation.cycles : *observation.hours;
}

/// "at least 100,000", "460 h", "0.21 N m2 at 1 1/m".
std::string observed_text(const Observation& observation);

/// What the model says over all variants, in the observer's unit. Lives are infinite where there is no
/// damage.
struct Prediction {
  double low = 0, high = 0;  ///< 10 % of the shortest-lived variant, 90 % of the longest-lived
  double shortest = 0, median = 0, longest = 0;  ///< medians of the variants
  double stuck = 0, free = 0;  ///< bounds of the worst wire, the least and the largest of all variants
  int variants = 0, failed = 0;
  std::string failure;  ///< of the first variant that did
};
Prediction predicted(const Observation& observation, const Study& study, const std::vector<RankingRow>& rows);

enum class Agreement { agrees, too_short, too_long, open };
/// agrees: every variant's median, or for a life that is known both ways the range, is within what was
/// observed. too_short, too_long: no variant is. open: some are: it depends on what is not known. factor: to
/// the nearest end of the range by which it misses; 1 within.
struct Judgement {
  Agreement agreement = Agreement::open;
  double factor = 1;
};
Judgement judged(const Observation& observation, const Prediction& prediction);
std::string words_of(const Judgement& judgement);

/// The comparison as a Markdown table.
std::string validation_table(const ValidationStudy& validation, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
