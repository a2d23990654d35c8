// What is not known of a dresspack, as the one list that draws, fits and reports share.
//
// Every parameter has a standardised variable z, before anything is measured standard normal and independent
// of the others. It acts on a job through one ordinary key, whose default changes nothing:
//     logarithmic   key = step^z, a factor;   else   key = step z, an addend.
// So `--set strain.friction_factor=2.5` is friction at z = 1. A job's own spread (section `uncertainty`)
// makes the prior of z narrower or wider and leaves what z means alone: z of a calibration holds for every
// job.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

class Fields;
struct Fatigue;
struct Material;

/// In the order of uncertain_parameters().
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

/// Which jobs share one value of a parameter.
enum class SharedBy {
  construction,  ///< dresspacks of one name: of the same make
  material,      ///< wires of one material
  everything,    ///< all jobs: it belongs to the model
  installation   ///< none: each dresspack as it was installed
};

struct UncertainParameter {
  std::string_view name;  ///< as in calibrations and tables: "friction_inside"
  std::string_view key;   ///< of the job: "strain.friction_factor"
  bool logarithmic;       ///< the key is a factor; else an addend
  double step;            ///< the key at z = 1: a factor, or an addend
  bool of_strain;         ///< moves what dresslife-strain works out; else only what dresslife-fatigue does
  SharedBy shared;
  std::string_view source;   ///< of the deviation
  std::string_view measure;  ///< what a user would measure to know it better
  std::string_view cause;    ///< as the subject of a sentence: "the friction inside the cables"
  std::string_view test;     ///< that would tell it, and how long that takes: "One bending test of a cable (one hour)"
  double test_deviation;     ///< error of that test: one deviation of ln(key), or of the key. ESTIMATE

  double deviation() const;      ///< of ln(key), or of the key
  double value(double z) const;  ///< of the key
  double z_of(double value) const;
};

const std::array<UncertainParameter, uncertain_count>& uncertain_parameters();
constexpr std::size_t index_of(Uncertain parameter) { return static_cast<std::size_t>(parameter); }
/// Of the parameter of this name; uncertain_count: there is none.
std::size_t index_of(std::string_view name);

/// "strain.friction_factor=2.5" and so on, as `--set` takes them, of all parameters whose z is not 0.
/// Precondition: (parameter).
std::vector<std::string> sets_at(std::span<const double> z);

/// What is known of cables for which a job names no calibration. typical: what makers promise of their cables
/// (config/observations/ratings.yaml), where the job is enabled; none: the spreads alone.
enum class KnownRatings { typical, none };
constexpr std::string_view word(KnownRatings value) { return word_at({"typical", "none"}, value); }

/// The section `uncertainty` of a job.
struct Uncertainty {
  bool enabled = true;
  KnownRatings ratings = KnownRatings::typical;
  std::array<double, uncertain_count> spread =
      default_spread();  ///< of the key at one deviation: a factor, or an addend

  static std::array<double, uncertain_count> default_spread();
};
void describe(Fields& f, Uncertainty& uncertainty);

/// What is known of all parameters together: a normal distribution of z. The prior of a job, or a
/// calibration's posterior.
struct ParameterKnowledge {
  Eigen::VectorXd mean;        ///< (parameter), in the order of uncertain_parameters()
  Eigen::MatrixXd covariance;  ///< (parameter, parameter)
};
/// z of the two other stiffnesses that dresslife-sim and dresslife-strain evaluate, -z and z: by default 0.4 and 2.5 times the
/// hose's. 0: none, where the stiffness is known or moves nothing.
double other_stiffness(const Uncertainty& uncertainty);
/// Independent, mean 0, of the spreads that the job gives.
ParameterKnowledge prior_of(const Uncertainty& uncertainty);

/// A wire's material as fatigue.strength_factor, slope_change, model_factor and motion_factor make it: strains and stresses
/// of the strain-life curve times the first; b moved by the second about reversals_of_slope, where its stress
/// stays; lives times the other two. K' and n' follow, so that (8) and the cyclic curve stay compatible as they
/// were.
Material changed(Material material, const Fatigue& fatigue);
constexpr double reversals_of_slope = 2e5;  ///< in the middle of what wires are tested at

/// How parts inside the cables slip: as in the job, not at all, or without friction.
enum class Inside { as_is, glued, free };
constexpr std::size_t inside_count = 3;

}  // namespace dresslife::pipeline
