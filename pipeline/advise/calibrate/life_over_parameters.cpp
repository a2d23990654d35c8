#include "pipeline/advise/calibrate/life_over_parameters.h"
#include "pipeline/base/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Returns z as the response counts it, from the job's own values. They differ from the mean in `rest` (fatigue/response.h).
ParameterPoint from_own(const LifeResponse& response, ParameterPoint z) {
  for (std::size_t p = 0; p < uncertain_count; ++p) z[p] += response.knowledge.mean(static_cast<Index>(p));
  return z;
}

}  // namespace

std::vector<OwnValues> own_values(const FailureModes& modes, const std::array<bool, uncertain_count>& own,
                                  const VectorXd& deviations, std::size_t count) {
  std::vector<OwnValues> all(count);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    if (!own[p]) continue;
    const std::vector<double> z = standard_normals("own " + std::string(uncertain_parameters()[p].name), count);
    for (std::size_t k = 0; k < count; ++k) all[k].z[p] = deviations[static_cast<Index>(p)] * z[k];
  }
  for (const LifeResponse& mode : modes) {
    const std::vector<double> u = standard_normals("own scatter/" + mode.dresspack + "/" + mode.mode, count);
    for (std::size_t k = 0; k < count; ++k) all[k].scatter.push_back(u[k]);
  }
  return all;
}

LifeOverParameters::LifeOverParameters(FailureModes modes, const std::array<bool, uncertain_count>& moves)
    : LifeOverParameters(std::vector<ProgramModes>{{std::move(modes), 1}}, moves) {}

LifeOverParameters::LifeOverParameters(std::vector<ProgramModes> programs,
                                       const std::array<bool, uncertain_count>& moves)
    : programs_(std::move(programs)), moves_(moves) {
  for (const ProgramModes& program : programs_) {
    surfaces_.emplace_back();
    for (const LifeResponse& mode : program.modes) surfaces_.back().emplace_back(mode);
  }
}

LifeAt LifeOverParameters::at(const VectorXd& beside, const OwnValues* own, double own_spread) const {
  const ParameterPoint z = point(beside, own, own_spread);
  const double early = first(z, -normal_decile, own), median = first(z, 0, own), late = first(z, normal_decile, own);
  const double by_wires = (late - early) / (2 * normal_decile);
  return {median, std::max(std::exp(least_log_spread), own ? std::hypot(by_wires, own_spread * residual()) : by_wires)};
}

double LifeOverParameters::residual() const { return residual_of(modes()) * std::numbers::ln10; }

double LifeOverParameters::log_median_at(const VectorXd& beside) const {
  return first(point(beside, nullptr, 1), 0, nullptr);
}

ParameterPoint LifeOverParameters::point(const VectorXd& beside, const OwnValues* own, double own_spread) const {
  ParameterPoint z{};
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    if (own) z[p] = own_spread * own->z[p];
    if (moves_[p]) z[p] = beside[static_cast<Index>(p)];
  }
  return z;
}

double LifeOverParameters::first(const ParameterPoint& z, double u, const OwnValues* own) const {
  double life = endless_log_life;
  for (std::size_t m = 0; m < modes().size(); ++m) {
    const double common = modes()[m].scatter_shared;
    const double of_mode = own ? std::sqrt(common) * u + std::sqrt(1 - common) * own->scatter[m] : u;
    life = std::min(life, log10_life(m, z, of_mode) * std::numbers::ln10);
  }
  return life;
}

double LifeOverParameters::log10_life(std::size_t mode, const ParameterPoint& z, double u) const {
  const auto of_repeat = [&](std::size_t k) {
    return surfaces_[k][mode].log10_life(from_own(programs_[k].modes[mode], z), u, Inside::as_is);
  };
  if (programs_.size() == 1) return of_repeat(0) - std::log10(programs_[0].per_hour);  // exactly the life of its job
  double damage = 0;                                                                   // per hour of operation
  for (std::size_t k = 0; k < programs_.size(); ++k) damage += programs_[k].per_hour * std::pow(10.0, -of_repeat(k));
  return damage > 0 ? -std::log10(damage) : endless_log_life;
}

}  // namespace dresslife::pipeline
