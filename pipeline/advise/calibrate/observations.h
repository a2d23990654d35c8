// A table of observations of cables and wires, and their comparison with the model. Each observation has a job that applies the
// same motion to the model's cable, and the possible values of unknown keys.
//
//   cables: typical                                               or own, the default: all rows are of the user's cables
//   observations:
//     - name: wenglor_chain
//       job: {motion: {rig: {...}}, dresspack: {cable: {...}}}      a job, or a file of one
//       vary: {fatigue.material: [copper_halved, copper_annealed]}  unknown keys; every combination
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

#include "pipeline/base/warnings.h"
#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

class Fields;

/// broken: it failed then; broken_by: no specimen lived longer; run_out: it had not failed; rating: lower bound by the maker.
enum class ObservedEnd { broken, broken_by, run_out, rating };
constexpr std::string_view word(ObservedEnd value) {
  return word_at({"broken", "broken_by", "run_out", "rating"}, value);
}
/// Return whether the observation is an upper bound, and a lower bound, of the life.
constexpr bool bounds_above(ObservedEnd value) {
  return value == ObservedEnd::broken || value == ObservedEnd::broken_by;
}
constexpr bool bounds_below(ObservedEnd value) { return value != ObservedEnd::broken_by; }

/// Criterion of failure: one wire, or a share of a conductor's wires (fatigue.failed_wires_percent).
enum class FailureCriterion { first_wire, conductor };
constexpr std::string_view word(FailureCriterion value) { return word_at({"first_wire", "conductor"}, value); }

/// A dresspack of a plant: hours of operation at its end; and at the begin of the records, if it was in use then.
struct ServiceRecord {
  double hours = 0, entry_hours = 0;
  bool failed = false;  ///< false: it was removed without a failure, or is in use
  bool operator==(const ServiceRecord&) const = default;
};

struct Observation {
  std::string name, what, source, note;
  // One of these is given:
  std::optional<double> cycles, hours;  ///< life [cycles, h]
  std::optional<double> stiffness;      ///< moment over curvature of the cable, bent from straight [N m2]
  std::optional<double> decrement;      ///< logarithmic decrement of the cable's free swing, held at one end [1]
  std::filesystem::path bending;        ///< a bending test as a table (measured_bending.h); empty: none

  std::vector<ServiceRecord>
      service;  ///< many lives in hours instead of one, from a maintenance system (service_records.h)

  double at_curvature = 1;  ///< curvature of `stiffness`; of `decrement`: beside the clamp, at the end of a swing [1/m]
  double decrement_without_slip = 0;  ///< part of `decrement` from polymer and air [1]
  double noise_percent = 5;           ///< error of a measured moment or decrement
  double cycles_per_repeat = 1;       ///< cycles that the observer counts per repeat of the job's motion
  ObservedEnd outcome = ObservedEnd::broken;
  FailureCriterion criterion = FailureCriterion::conductor;
  int specimens = 1;
  double unshared_log10 =
      universal_slopes;  ///< standard deviation of log10 life of one test, which other tests do not share
  /// Rules that predict lives from tensile tests are within a factor of 3 in four of five cases (Nachtigall 1975).
  static constexpr double universal_slopes = 0.37;
  std::vector<std::size_t> jobs;  ///< indices in the study of the jobs that are its variants

  bool is_life() const { return cycles || hours || !service.empty(); }
};
void describe(Fields& f, Observation& observation);

/// An observation with its jobs: one job per combination of the unknown values.
struct ObservedTest {
  Observation observation;
  struct Variant {
    std::string name;  ///< name that is fit for a folder
    Node job;
    std::string failure;       ///< reason why the job is invalid; empty: it is valid
    double share_of_time = 1;  ///< for dresspacks in service, whose variants are their programs
  };
  std::vector<Variant> variants;
  /// the test belongs to one of many makers' cables and informs a cable that is none of them (typical_cables.h)
  bool typical = false;
  std::string text;  ///< text of the row, for a digest
  Where where;
};

/// Reads a table of observations. Errors: InputError at the place in the file.
std::vector<ObservedTest> read_observed_tests(const std::filesystem::path& file);

struct ValidationStudy {
  Study study;
  std::vector<Observation> observations;
  std::vector<Warning> doubts;  ///< doubtful_rows() of the file
};

/// Reads the observations of lives. Errors: InputError at the place in the file. A variant that is no valid job has a failure.
ValidationStudy read_observations(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// Returns the lives by which 10, 50 and 90 % have failed by the observation's criterion, in the observer's unit;
/// infinite without damage.
std::array<double, 3> lives_of(const Observation& observation, const RankingRow& row);

/// Returns the observed life [cycles or h]. Precondition: the observation has one life.
inline double observed_life(const Observation& observation) {
  return observation.cycles ? *observation.cycles : *observation.hours;
}

/// Returns "at least 100,000", "460 h", "0.21 N m2 at 1 1/m".
std::string observed_text(const Observation& observation);

/// A prediction over all variants, in the observer's unit. Lives without damage are infinite.
struct Prediction {
  double low = 0, high = 0;  ///< 10 % value of the shortest-lived variant, 90 % value of the longest-lived
  double shortest = 0, median = 0, longest = 0;  ///< medians of the variants
  double stuck = 0, free = 0;  ///< bounds of the worst wire: the least and the largest of all variants
  int variants = 0, failed = 0;
  std::string failure;  ///< reason of the first variant that failed
};
Prediction predicted(const Observation& observation, const Study& study, const std::vector<RankingRow>& rows);

enum class Agreement { agrees, too_short, too_long, open };
/// too_short, too_long: the whole range of 10 to 90 % is on the wrong side of the observation. agrees: all medians are on the
/// right side; for a life that is both an upper and a lower bound, the observation is in the range. open: only some medians are
/// on the right side. factor: ratio between the observation and the nearest end of the range; 1 inside.
struct Judgement {
  Agreement agreement = Agreement::open;
  double factor = 1;
};
Judgement judged(const Observation& observation, const Prediction& prediction);
std::string words_of(const Judgement& judgement);

/// Returns the comparison as a Markdown table.
std::string validation_table(const ValidationStudy& validation, const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
