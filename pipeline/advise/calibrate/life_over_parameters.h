// The life of a specimen or dresspack over the uncertain parameters, as a run's samples evaluate it: the first of its failure
// modes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::pipeline {

inline constexpr double endless_log_life = 41.4;  // ln 1e18: a life without damage
inline constexpr double least_log_spread = -6.9;  // ln 0.001: of ln life, where nothing scatters

/// What one dresspack has for itself.
struct OwnValues {
  ParameterPoint z{};  ///< (parameter) 0 of those that it shares
  std::vector<double>
      scatter;  ///< (mode) standard normal: the part of u that the modes do not have in common
};
/// Samples of equal probability: of each number every stratum once. own: the parameters. The same every time.
std::vector<OwnValues> own_values(const FailureModes& modes, const std::array<bool, uncertain_count>& own,
                                  std::size_t count);

/// One of the programs of a dresspack.
struct ProgramModes {
  FailureModes modes;
  double per_hour = 0;  ///< repeats in an hour of operation; 1: lives are in repeats
};

class LifeOverParameters {
 public:
  /// moves: parameters that it depends on.
  LifeOverParameters(FailureModes modes, const std::array<bool, uncertain_count>& moves);
  /// Of several programs on one dresspack: the damage of a mode adds up, as if all programs loaded one place. Precondition:
  /// all have the same modes.
  LifeOverParameters(std::vector<ProgramModes> programs, const std::array<bool, uncertain_count>& moves);
  LifeOverParameters(const LifeOverParameters&) = delete;
  LifeOverParameters& operator=(const LifeOverParameters&) = delete;
  const FailureModes& modes() const { return programs_.front().modes; }

  /// In repeats, or in hours of operation. beside (parameter): z from the keys of the job. own: of one dresspack; null: median ones, and as if the scatter
  /// of wires were common to all modes. A life without end counts as endless_log_life.
  LifeAt at(const Eigen::VectorXd& beside, const OwnValues* own = nullptr) const;
  double log_median_at(const Eigen::VectorXd& beside) const;

 private:
  ParameterPoint point(const Eigen::VectorXd& beside, const OwnValues* own) const;
  double first(const ParameterPoint& z, double u, const OwnValues* own) const;
  double log10_life(std::size_t mode, const ParameterPoint& z, double u) const;

  const std::vector<ProgramModes> programs_;
  const std::array<bool, uncertain_count> moves_;
  std::vector<std::vector<LifeSurface>> surfaces_;  ///< (program) (mode)
};

}  // namespace dresslife::pipeline
