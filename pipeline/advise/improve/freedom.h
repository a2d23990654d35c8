// The free variables of a search: keys of the jobs with their ranges.
//
//   free:
//     routing.free_length_m: 1.9 .. 2.6                         any number between
//     routing.tool_clamp.direction: 30 deg around               any direction in a cone about the job's
//     routing.base_clamp.position_m: 0.05 around                each coordinate within this of the job's
//     routing.base_clamp.position_m: -0.2 .. 0.3 along link_3   from the job's place along the axis of link_3
//     routing.base_clamp.position_m: -0.2 .. 0.3 along [1, 0, 0]   the same along a direction
//     dresspack: [spot_welding, slim.yaml]                      one of these
//
// A number with `around` may differ from the job's by that much, up or down.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct Job;

/// One key and its range, as a function of some variables between 0 and 1.
class FreeKey {
 public:
  virtual ~FreeKey() = default;
  virtual Eigen::Index variables() const { return 1; }
  /// Precondition: (variable) 0 .. 1. Rounded to a ten-thousandth of the range.
  virtual Node value_at(const Eigen::VectorXd& place) const = 0;
  /// Variables of a job's own value; empty: it is outside the range.
  virtual Eigen::VectorXd place_of(const Node& value) const = 0;
  /// "at most 2.75" for a variable at the end of its range; empty: the range cannot be widened.
  virtual std::string end_words(Eigen::Index variable, bool high) const = 0;
};

class Freedom {
 public:
  struct FreeVariable {
    std::string path;
    std::unique_ptr<FreeKey> key;
    std::string own;  ///< the jobs' value; empty: they name none, or not the same
  };

  /// free: a map from key paths to ranges. jobs: if they differ in a key with a range `around` its own value, the value
  /// must be given. Errors: InputError.
  static Freedom from(const Node& free, const std::vector<std::shared_ptr<const Job>>& jobs);

  /// The default: the length from a tenth shorter to a third longer, all clamps and rings by 150 mm and 45 deg, the
  /// roll of the tool clamp by half a turn. Errors: InputError for a job without clamps on a robot.
  static Node usual(const Job& job);

  Eigen::Index variables() const;
  const std::vector<FreeVariable>& keys() const { return keys_; }

  /// "KEY.PATH=VALUE" of every key.
  std::vector<std::string> sets_at(const Eigen::VectorXd& place) const;
  /// "routing.free_length_m, at most 2.75", of every key at an end of its range.
  std::vector<std::string> at_ends(const Eigen::VectorXd& place) const;
  /// Variables of the first job; absent if one of its keys is outside its range.
  std::optional<Eigen::VectorXd> place_of_job() const { return start_; }

 private:
  std::vector<FreeVariable> keys_;
  std::optional<Eigen::VectorXd> start_;
};

}  // namespace dresslife::pipeline
