// The list of uncertain parameters of a dresspack, which sampling, fitting and reports share.
//
// Each parameter has a standardised variable z. Without measurements, z is standard normal and independent of the others. It
// changes one key of the job, whose default has no effect:
//     logarithmic   key = step^z, a factor;   else   key = step z, an addend.
// For example, `--set strain.friction_factor=2.5` is friction at z = 1. The spread in a job (section `uncertainty`) changes the
// width of the prior of z, but not the meaning of z. So z of a calibration is valid for every job.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

class Fields;
struct Fatigue;
struct Material;

/// The order is that of uncertain_parameters().
enum class Uncertain {
  friction_inside,
  friction_hose,
  slack,
  play,
  grip,
  rest,
  hose_stiffness,
  strength,
  slope,
  scatter,
  model,
  motion
};
constexpr std::size_t uncertain_count = 12;

/// Scope of a parameter: jobs in one scope share its value.
enum class SharedBy {
  construction,  ///< dresspacks with one name, which are of one make
  material,      ///< wires of one material
  everything,    ///< all jobs: it is a parameter of the model
  installation   ///< no jobs: each installed dresspack has its own value
};

struct UncertainParameter {
  std::string_view name;  ///< name in calibrations and tables: "friction_inside"
  std::string_view key;   ///< key of the job: "strain.friction_factor"
  bool logarithmic;       ///< the key is a factor; otherwise an addend
  double step;            ///< the key at z = 1: a factor or an addend
  bool of_strain;         ///< affects dresslife-strain; otherwise only dresslife-fatigue
  SharedBy shared;
  std::string_view source;   ///< of the deviation
  std::string_view measure;  ///< quantity that a user can measure to know it better
  std::string_view cause;    ///< as the subject of a sentence: "the friction inside the cables"
  std::string_view
      test;  ///< measurement that determines it, and its duration: "One bending test of a cable (one hour)"
  double test_deviation;  ///< error of that measurement: one standard deviation of ln(key), or of the key. ESTIMATE

  double deviation() const;      ///< of ln(key), or of the key
  double value(double z) const;  ///< of the key
  double z_of(double value) const;
};

const std::array<UncertainParameter, uncertain_count>& uncertain_parameters();
constexpr std::size_t index_of(Uncertain parameter) { return static_cast<std::size_t>(parameter); }
/// Returns the index of the parameter of this name; uncertain_count if the name is unknown.
std::size_t index_of(std::string_view name);

/// Returns the arguments of `--set`, such as "strain.friction_factor=2.5", for all parameters whose z is not 0. z: (parameter).
std::vector<std::string> sets_at(std::span<const double> z);

/// Knowledge about the cables of a job without calibration. typical: from makers' ratings of cables
/// (config/observations/ratings.yaml), if the job can use them; none: only the spreads.
enum class KnownRatings { typical, none };
constexpr std::string_view word(KnownRatings value) { return word_at({"typical", "none"}, value); }

/// The section `uncertainty` of a job.
struct Uncertainty {
  bool enabled = true;
  KnownRatings ratings = KnownRatings::typical;
  /// setting with which the typical ratings are not valid; empty: they are valid, or the job leaves them out
  std::string ratings_left_out;
  std::array<double, uncertain_count> spread =
      default_spread();  ///< of the key at one standard deviation: a factor or an addend

  static std::array<double, uncertain_count> default_spread();
};
void describe(Fields& f, Uncertainty& uncertainty);
/// Returns whether the job states that it knows a parameter: its spread has no effect.
bool is_known(const Uncertainty& uncertainty, Uncertain parameter);

/// Returns the parameters in the order of sampling: shared parameters come before those of one job, so that shared values do not
/// depend on the job's own numbers.
std::vector<std::size_t> sampling_order();
/// Returns the lower triangle L with L L^T = covariance, for the rows and columns of `order`; a known parameter has a row of zeros.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& covariance, const std::vector<std::size_t>& order);

/// Samples of a posterior, standardised: L^-1 (z - mean), with the triangular_factor() L of these parameters. Their mean is 0 and
/// their covariance is 1, but they are not normal: observed lives confine z to a curved surface.
struct StandardSamples {
  std::vector<std::size_t> parameters;  ///< in sampling_order()
  Eigen::MatrixXd numbers;              ///< (sample, index in parameters)
};

/// Joint knowledge about all parameters. It is the prior of a job or the posterior of a calibration. Samples of z are mean + L n.
/// n is standard normal, or one of `samples`.
struct ParameterKnowledge {
  Eigen::VectorXd mean;                              ///< (parameter), in the order of uncertain_parameters()
  Eigen::MatrixXd covariance;                        ///< (parameter, parameter)
  std::shared_ptr<const StandardSamples> samples{};  ///< null: z is normal
};
/// Returns z of the two other hose stiffnesses that dresslife-sim and dresslife-strain evaluate: -z and z, by default 0.4 and 2.5
/// times the hose's stiffness. 0: there are none, because the stiffness is known or has no effect.
double other_stiffness(const Uncertainty& uncertainty);
/// Returns the prior: independent parameters with mean 0 and the spreads of the job.
ParameterKnowledge prior_of(const Uncertainty& uncertainty);

/// Returns a wire's material after the factors of `fatigue`. strength_factor multiplies strains and stresses of the strain-life
/// curve. slope_change is added to b; the stress at reversals_of_slope stays the same. model_factor and motion_factor multiply
/// the lives. K' and n' change too, so that (8) and the cyclic curve stay as compatible as before.
Material changed(Material material, const Fatigue& fatigue);
constexpr double reversals_of_slope = 2e5;  ///< in the middle of the tested range of wires

/// Slip of parts inside the cables: as in the job, no slip, or slip without friction.
enum class Inside { as_is, glued, free };
constexpr std::size_t inside_count = 3;

}  // namespace dresslife::pipeline
