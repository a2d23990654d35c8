#include "pipeline/advise/calibrate/life_over_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double deciles = 1.2815515655446004;  // of a normal distribution, in its deviations

}  // namespace

std::vector<OwnValues> own_values(const FailureModes& modes, const std::array<bool, uncertain_count>& own,
                                  std::size_t count) {
  std::vector<OwnValues> all(count);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    if (!own[p]) continue;
    const std::vector<double> z =
        standard_normals("own " + std::string(uncertain_parameters()[p].name), count);
    for (std::size_t k = 0; k < count; ++k) all[k].z[p] = z[k];
  }
  for (const LifeResponse& mode : modes) {
    const std::vector<double> u = standard_normals("own scatter/" + mode.dresspack + "/" + mode.mode, count);
    for (std::size_t k = 0; k < count; ++k) all[k].scatter.push_back(u[k]);
  }
  return all;
}

LifeOverParameters::LifeOverParameters(FailureModes modes, const std::array<bool, uncertain_count>& moves)
    : modes_(std::move(modes)), moves_(moves) {
  for (const LifeResponse& mode : modes_) surfaces_.emplace_back(mode);
}

LifeAt LifeOverParameters::at(const VectorXd& beside, const OwnValues* own) const {
  const ParameterPoint z = point(beside, own);
  const double early = first(z, -deciles, own), median = first(z, 0, own), late = first(z, deciles, own);
  return {median, std::max(std::exp(least_log_spread), (late - early) / (2 * deciles))};
}

double LifeOverParameters::log_median_at(const VectorXd& beside) const {
  return first(point(beside, nullptr), 0, nullptr);
}

ParameterPoint LifeOverParameters::point(const VectorXd& beside, const OwnValues* own) const {
  ParameterPoint z = own ? own->z : ParameterPoint{};
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (moves_[p]) z[p] = beside[static_cast<Index>(p)];
  return z;
}

double LifeOverParameters::first(const ParameterPoint& z, double u, const OwnValues* own) const {
  double life = endless_log_life;
  for (std::size_t m = 0; m < surfaces_.size(); ++m) {
    const double common = modes_[m].scatter_shared;
    const double of_mode = own ? std::sqrt(common) * u + std::sqrt(1 - common) * own->scatter[m] : u;
    life = std::min(life, surfaces_[m].log10_life(z, of_mode, Inside::as_is) * std::numbers::ln10);
  }
  return life;
}

}  // namespace dresslife::pipeline
