// What observations have taught of what is not known (uncertainty.h): a file that `dresslife calibrate`
// writes and a job names. Where a job names one, the keys of all parameters that stand at their defaults go
// to its medians, and its draws are the calibration's.
//
//   calibration: calibration.yaml
//
// In the resolved job the file's content stands in place of its name, with `applied: true` once its medians
// stand in the keys: what a file of results depends on is all in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// One parameter: its z, and for people the key.
struct LearnedParameter {
  std::string name;
  double median = 0, mean = 0;                     ///< of z
  std::vector<double> covariance;                  ///< of z, with every parameter of the list
  double value = 0, value_p10 = 0, value_p90 = 0;  ///< of the key: median, and 80 % lie between
  Where where;
};

/// From what it was learned.
struct LearnedFrom {
  std::string observation, observed;              ///< name; "at least 100,000 cycles"
  std::string predicted_before, predicted_after;  ///< median, and 10 .. 90 %
  std::string digest;                             ///< of the row and the files that it names
};

/// The ranges that the tests covered. Outside of them the calibration is an extrapolation.
struct LearnedWithin {
  std::optional<double> least_strain_range, largest_strain_range;  ///< of the worst wires
  std::optional<double> largest_curvature, largest_twist;          ///< of the cables [1/m], [rad/m]
  std::optional<double> fewest_cycles, most_cycles;                ///< that were observed
  std::string materials;                                           ///< of the wires, comma-separated
  std::string left_out;  ///< parameters that do not hold for the job that names it, in words; empty: none
};

/// A key that all jobs have; of several tests there may be several values.
struct LearnedSetting {
  std::string key, value;
  bool operator==(const LearnedSetting&) const = default;
};

/// A cable whose wires were evaluated.
struct LearnedCable {
  std::string name;
  std::string hose;          ///< dresspack that it lay in; empty: it was alone
  std::string construction;  ///< digest of its parts, without names and friction keys
  std::string friction;      ///< friction keys of its parts, comma-separated
  bool operator==(const LearnedCable&) const = default;
};

/// A material of wires.
struct LearnedMaterial {
  std::string name, constants;  ///< constants: keys with values, comma-separated
  bool operator==(const LearnedMaterial&) const = default;
};

/// What the tests were computed with (learned_settings.h).
struct LearnedUnder {
  std::vector<LearnedSetting> settings;
  std::vector<LearnedCable> cables;
  std::vector<LearnedMaterial> materials;
};

struct Calibration {
  static constexpr const char* format_word = "dresslife-calibration";
  static constexpr int newest_version = 2;
  std::string format = format_word;
  int format_version = newest_version;
  bool applied = false;
  bool typical = false;  ///< of makers' cables together: its parameters are those of a cable that no test had
  std::string note;
  std::vector<LearnedParameter> parameters;
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

/// Errors: InputError at the place: another format or a newer version, an unknown parameter or one twice, a
/// covariance that is not square, symmetric and positive.
void check_calibration(const Calibration& calibration);

/// In the order of uncertain_parameters(); one that the calibration does not know keeps its prior.
ParameterKnowledge knowledge_of(const Calibration& calibration, ParameterKnowledge prior);

/// Where a job goes beyond what a calibration was learned from: "a strain range of 0.012 (0.001 .. 0.006 in
/// its tests)".
struct Experience {
  double strain_range = 0;          ///< of the worst wire
  double curvature = 0, twist = 0;  ///< largest of the motion [1/m], [rad/m]
};
std::vector<std::string> beyond(const LearnedWithin& within, const Experience& experience);

}  // namespace dresslife::pipeline
