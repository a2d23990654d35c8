// What observations have taught of what is not known (uncertainty.h): a file that `dresslife calibrate`
// writes and a job names. Where a job names one, the keys of all parameters that stand at their defaults go
// to its medians, and its draws are the calibration's.
//
//   calibration: calibration.yaml
//
// In the resolved job the file's content stands in place of its name, with `applied: true` once its medians
// stand in the keys: what a file of results depends on is all in it.
#pragma once

#include <filesystem>
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

/// What the tests went through; outside nobody has looked.
struct LearnedWithin {
  std::optional<double> least_strain_range, largest_strain_range;  ///< of the worst wires
  std::optional<double> largest_curvature, largest_twist;          ///< of the cables [1/m], [rad/m]
  std::optional<double> fewest_cycles, most_cycles;                ///< that were observed
  std::string materials;                                           ///< of the wires, comma-separated
};

struct Calibration {
  static constexpr const char* format_word = "dresslife-calibration";
  static constexpr int newest_version = 1;
  std::string format = format_word;
  int format_version = newest_version;
  bool applied = false;
  std::string note;
  std::vector<LearnedParameter> parameters;
  LearnedWithin within;
  std::vector<LearnedFrom> observations;
  Where where;
};
void describe(Fields& f, LearnedParameter& parameter);
void describe(Fields& f, LearnedFrom& from);
void describe(Fields& f, LearnedWithin& within);
void describe(Fields& f, Calibration& calibration);

/// Errors: InputError at the place: another format or a newer version, an unknown parameter or one twice, a
/// covariance that is not square, symmetric and positive.
void check_calibration(const Calibration& calibration);

/// In the order of uncertain_parameters(); one that the calibration does not know keeps mean 0 and
/// variance 1.
ParameterKnowledge knowledge_of(const Calibration& calibration);

/// Where a job goes beyond what a calibration was learned from: "a strain range of 0.012 (0.001 .. 0.006 in
/// its tests)".
struct Experience {
  double strain_range = 0;          ///< of the worst wire
  double curvature = 0, twist = 0;  ///< largest of the motion [1/m], [rad/m]
  std::vector<std::string> materials;
};
std::vector<std::string> beyond(const LearnedWithin& within, const Experience& experience);

}  // namespace dresslife::pipeline
