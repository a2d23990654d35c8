#include "pipeline/advise/calibrate/learned_walls.h"

#include <cmath>
#include <map>
#include <numeric>

#include "pipeline/base/lists.h"
#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {
namespace {

constexpr double reach = 6,
                 width = 0.02;  // 6 deviations exclude 1e-9 of the prior; the resolution is a hundredth of a deviation

LearnedWall learned_from(const std::string& name, const std::vector<const ObservedLife*>& observed) {
  std::vector<double> z, weight;
  for (int k = 0; k <= std::lround(2 * reach / width); ++k) {
    z.push_back(k * width - reach);
    Eigen::VectorXd at = Eigen::VectorXd::Zero(uncertain_count);
    at[static_cast<Eigen::Index>(index_of(Uncertain::strength))] = z.back();
    weight.push_back(-z.back() * z.back() / 2);
    for (const ObservedLife* life : observed) weight.back() += log_likelihood(*life, at);
  }
  const double all = log_mean(weight) + std::log(static_cast<double>(weight.size()));
  LearnedWall wall{name};
  double below = 0, squares = 0;
  wall.low = wall.median = wall.high = z.front();
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double share = std::exp(weight[k] - all);
    wall.mean += share * z[k], squares += share * z[k] * z[k], below += share;
    if (below < 0.1) wall.low = z[k];
    if (below < 0.5) wall.median = z[k];
    if (below < 0.9) wall.high = z[k];
  }
  wall.deviation = std::sqrt(squares - wall.mean * wall.mean);
  return wall;
}

}  // namespace

std::vector<LearnedWall> learned_walls(const std::vector<EmulatedTest>& tests) {
  std::map<std::string, std::vector<const ObservedLife*>> observed;
  for (const EmulatedTest& test : tests)
    for (const auto& [name, life] : test.walls) observed[name].push_back(&life);
  return mapped(observed, [](const auto& wall) { return learned_from(wall.first, wall.second); });
}

}  // namespace dresslife::pipeline
