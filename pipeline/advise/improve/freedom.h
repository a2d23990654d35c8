// The free variables of a search: keys of the jobs with their ranges.
//
//   free:
//     routing.free_length_m: 1.9 .. 2.6                         any number in this range
//     routing.tool_clamp.direction: 30 deg around               any direction in a cone around the job's direction
//     routing.base_clamp.position_m: 0.05 around                each coordinate at most this far from the job's
//     routing.base_clamp.position_m: -0.2 .. 0.3 along link_3   a shift from the job's position along the axis of link_3
//     routing.base_clamp.position_m: -0.2 .. 0.3 along [1, 0, 0]   a shift along a direction
//
// A number with `around` may differ from the job's value by this amount, up or down. A value after `around` replaces that of the job
// as the centre: 0.1 around 2.2, 0.05 around [0, 0, 0.4], 30 deg around [1, 0, 0].
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct Job;

/// One key with its range, as a function of some variables between 0 and 1.
class FreeKey {
 public:
  virtual ~FreeKey() = default;
  virtual Eigen::Index variables() const { return 1; }
  /// Returns the value for (variable) 0 .. 1, rounded to a ten-thousandth of the range.
  virtual Node value_at(const Eigen::VectorXd& place) const = 0;
  /// Returns the variables of a job's own value; empty: the value is outside the range.
  virtual Eigen::VectorXd place_of(const Node& value) const = 0;
  /// Returns "at most 2.75" for a variable at the end of its range; empty: the range cannot be widened.
  virtual std::string end_words(Eigen::Index variable, bool high) const = 0;
};

class Freedom {
 public:
  struct FreeVariable {
    std::string path;
    std::unique_ptr<FreeKey> key;
    std::string own;  ///< value in the jobs; empty: the jobs have none, or different ones
  };

  /// Makes the free variables. free: a map from key paths to ranges. Errors: InputError, also if the jobs differ in a key that
  /// has a range `around` its own value.
  static Freedom from(const Node& free, const std::vector<std::shared_ptr<const Job>>& jobs);

  /// Returns the default map: the length from a tenth shorter to a third longer, all clamps and rings by 150 mm and 45 deg, the
  /// roll of the tool clamp by half a turn.
  static Node usual(const Job& job);

  Eigen::Index variables() const;
  const std::vector<FreeVariable>& keys() const { return keys_; }

  /// Returns "KEY.PATH=VALUE" for every key.
  std::vector<std::string> sets_at(const Eigen::VectorXd& place) const;
  /// Returns "routing.free_length_m, at most 2.75" for every key at an end of its range.
  std::vector<std::string> at_ends(const Eigen::VectorXd& place) const;
  /// Returns the variables of the first job; absent if one of its keys is outside its range.
  std::optional<Eigen::VectorXd> place_of_job() const { return start_; }

 private:
  std::vector<FreeVariable> keys_;
  std::optional<Eigen::VectorXd> start_;
};

}  // namespace dresslife::pipeline
