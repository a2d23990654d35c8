// Knowledge about uncertain parameters (uncertainty.h), learned from observations: a file that `dresslife calibrate` writes and a
// job names. With a calibration, the keys of all parameters that have their default values get the calibration's medians, and the
// samples come from the calibration.
//
//   calibration: calibration.yaml
//
// In the resolved job, the content of the file replaces its name, with `applied: true` after the medians were written into the
// keys. So the job contains every input of a result file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// One parameter: its z, and its key for people.
struct LearnedParameter {
  std::string name;
  double median = 0, mean = 0;                     ///< of z
  double prior = 1;                                ///< standard deviation of z before the observations
  std::vector<double> covariance;                  ///< of z, with every parameter of the list
  std::vector<double> samples;                     ///< of z, (sample); empty: z is normal
  double value = 0, value_p10 = 0, value_p90 = 0;  ///< median of the key, and limits between which 80 % lie
  Where where;
};

/// One observation of a calibration.
struct LearnedFrom {
  std::string observation, observed;              ///< name; "at least 100,000 cycles"
  std::string predicted_before, predicted_after;  ///< median, and 10 % .. 90 %
  std::string digest;                             ///< of the table row and the files that it names
};

/// Ranges of the tests. Outside of these ranges, the calibration is an extrapolation.
struct LearnedWithin {
  std::optional<double> least_strain_range, largest_strain_range;  ///< of the most strained wires
  std::optional<double> largest_curvature, largest_twist;          ///< of the cables [1/m], [rad/m]
  std::optional<double> fewest_cycles, most_cycles;                ///< that were observed
  std::string materials;                                           ///< of the wires, comma-separated
  std::string left_out;  ///< parameters that are not valid for the current job, in words; empty: none
};

/// A setting that every job has. Different tests may have different values of it.
struct LearnedSetting {
  std::string key, value;
  bool operator==(const LearnedSetting&) const = default;
};

/// A cable whose wires were evaluated.
struct LearnedCable {
  std::string name;
  std::string hose;          ///< dresspack that contained the cable; empty: no dresspack
  std::string construction;  ///< digest of its parts, without names and friction keys
  std::string friction;      ///< friction keys of its parts, comma-separated
  bool operator==(const LearnedCable&) const = default;
};

/// A material of wires.
struct LearnedMaterial {
  std::string name, constants;  ///< constants: keys with values, comma-separated
  bool operator==(const LearnedMaterial&) const = default;
};

/// Settings, cables, materials and motions of the tests (learned_settings.h).
struct LearnedUnder {
  std::vector<LearnedSetting> settings;
  std::vector<LearnedCable> cables;
  std::vector<LearnedMaterial> materials;
  std::string motions;  ///< motion_digest() of jobs with dresspacks in service, comma-separated
};

struct Calibration {
  static constexpr const char* format_word = "dresslife-calibration";
  static constexpr int newest_version = 3;
  std::string format = format_word;
  int format_version = newest_version;
  bool applied = false;
  bool typical =
      false;  ///< true: learned from makers' ratings of many cables; its parameters are those of a cable without tests
  std::string note;
  /// Warning that records of dresspacks in service contradict the prediction with this calibration; empty: none. Runs repeat it.
  std::string contradiction;
  /// Further warnings, one per line: of observations that are far from their predictions, and of records whose job exceeds limits.
  /// Runs repeat them.
  std::string doubts;
  std::vector<LearnedParameter> parameters;
  /// factor of the deviations between dresspacks: of the parameters of SharedBy::installation that are not calibrated, and of the
  /// residual of computed lives
  double own_spread = 1;
  /// LifeResponse::residual_spread of the current job: own_spread if under.motions has its motion. Records of other motions contain
  /// no information about the error of its computed life.
  double residual_spread = 1;
  LearnedUnder under;
  LearnedWithin within;
  std::vector<LearnedFrom> observations;
  Where where;
};
void describe(Fields& f, LearnedParameter& parameter);
void describe(Fields& f, LearnedFrom& from);
void describe(Fields& f, LearnedWithin& within);
void describe(Fields& f, LearnedSetting& setting);
void describe(Fields& f, LearnedCable& cable);
void describe(Fields& f, LearnedMaterial& material);
void describe(Fields& f, LearnedUnder& under);
void describe(Fields& f, Calibration& calibration);

/// Errors: InputError at the place for another format, a newer version, an unknown or repeated parameter, a covariance that is
/// not square, symmetric and positive, or lists of samples of different lengths.
void check_calibration(const Calibration& calibration);

/// Returns the calibration's parameters in the order of uncertain_parameters(), with the samples. Parameters without calibration keep their prior;
/// own_spread changes the prior of those that each dresspack has for itself.
ParameterKnowledge knowledge_of(const Calibration& calibration, ParameterKnowledge prior);

/// A job's quantities that are compared with the ranges of a calibration. beyond() returns each quantity outside of its range in
/// words: "a strain range of 0.012 (0.001 .. 0.006 in its tests)".
struct Experience {
  double strain_range = 0;          ///< of the most strained wire
  double curvature = 0, twist = 0;  ///< largest of the motion [1/m], [rad/m]
};
std::vector<std::string> beyond(const LearnedWithin& within, const Experience& experience);

}  // namespace dresslife::pipeline
