// The life of a specimen or dresspack as a function of the uncertain parameters, evaluated as in a run's samples: the first of
// its failure modes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::pipeline {

inline constexpr double endless_log_life = 41.4;  // ln 1e18: represents a life without damage
// ln 0.001: lower limit of ln of the deviation of ln life, used if nothing scatters
inline constexpr double least_log_spread = -6.9;

/// Values of a single dresspack, at the spread 1 between dresspacks.
struct OwnValues {
  ParameterPoint z{};           ///< (parameter) 0 for parameters that dresspacks share
  std::vector<double> scatter;  ///< (mode) standard normal: the part of u that is independent between the modes
};
/// Returns `count` samples of equal probability with one sample in each stratum of each number. own: parameters that differ
/// between dresspacks. deviations: of z (parameter). Every call gives the same result.
std::vector<OwnValues> own_values(const FailureModes& modes, const std::array<bool, uncertain_count>& own,
                                  const Eigen::VectorXd& deviations, std::size_t count);

/// One program of a dresspack.
struct ProgramModes {
  FailureModes modes;
  double per_hour = 0;  ///< repeats in an hour of operation; 1: lives are in repeats
};

class LifeOverParameters {
 public:
  /// moves: parameters on which the life depends.
  LifeOverParameters(FailureModes modes, const std::array<bool, uncertain_count>& moves);
  /// For several programs on one dresspack: the damage of a mode adds up, as if all programs loaded one place. Precondition:
  /// all programs have the same modes.
  LifeOverParameters(std::vector<ProgramModes> programs, const std::array<bool, uncertain_count>& moves);
  LifeOverParameters(const LifeOverParameters&) = delete;
  LifeOverParameters& operator=(const LifeOverParameters&) = delete;
  const FailureModes& modes() const { return programs_.front().modes; }

  /// Returns the life in repeats, or in hours of operation. beside: (parameter) z relative to the job's keys; of `rest`
  /// relative to the mean of each response's knowledge, because a job has one of several rests. own: values of one
  /// dresspack, with its residual; null: median values, with a scatter of wires that is common to all modes and without residual.
  /// own_spread: factor of own values and residual (own_spread.h). A life without end gives endless_log_life.
  LifeAt at(const Eigen::VectorXd& beside, const OwnValues* own = nullptr, double own_spread = 1) const;
  double log_median_at(const Eigen::VectorXd& beside) const;
  /// Returns the standard deviation of the residual of ln life (residual_of()).
  double residual() const;

 private:
  ParameterPoint point(const Eigen::VectorXd& beside, const OwnValues* own, double own_spread) const;
  double first(const ParameterPoint& z, double u, const OwnValues* own) const;
  double log10_life(std::size_t mode, const ParameterPoint& z, double u) const;

  const std::vector<ProgramModes> programs_;
  const std::array<bool, uncertain_count> moves_;
  std::vector<std::vector<LifeSurface>> surfaces_;  ///< (program) (mode)
};

}  // namespace dresslife::pipeline
