// Searches on functions whose least values are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "pipeline/search/minimise.h"
#include "pipeline/search/random_search.h"
#include "pipeline/search/surrogate_search.h"

using namespace dresslife::pipeline;
using Eigen::VectorXd;

namespace {

struct Problem {
  const char* name;
  VectorXd low, high;
  double least;  ///< value at the best place
  std::function<double(const VectorXd&)> aim;
  std::function<std::vector<double>(const VectorXd&)> beyond;

  VectorXd at(const VectorXd& place) const { return low + place.cwiseProduct(high - low); }
  Look look(const VectorXd& place) const {
    const VectorXd x = at(place);
    return {place, true, {aim(x)}, beyond(x)};
  }
};

VectorXd vector_of(std::initializer_list<double> values) {
  VectorXd made(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), made.data());
  return made;
}

/// The example of NLopt's tutorial: its COBYLA takes 31 evaluations to 0.5443.
Problem tutorial() {
  return {"NLopt's tutorial", vector_of({-2, 0}), vector_of({2, 3}), std::sqrt(8.0 / 27),
          [](const VectorXd& x) { return std::sqrt(x[1]); },
          [](const VectorXd& x) {
            return std::vector<double>{std::pow(2 * x[0], 3) - x[1], std::pow(1 - x[0], 3) - x[1]};
          }};
}

/// g24, g08 and g04 of the Congress on Evolutionary Computation 2006 (J. Liang et al., Problem definitions for
/// constrained real-parameter optimization, 2006), which pagmo holds as its own examples.
Problem g24() {
  return {"g24", vector_of({0, 0}), vector_of({3, 4}), -5.50801327159536,
          [](const VectorXd& x) { return -x[0] - x[1]; },
          [](const VectorXd& x) {
            const double a = x[0], a2 = a * a, a3 = a2 * a, a4 = a3 * a;
            return std::vector<double>{-2 * a4 + 8 * a3 - 8 * a2 + x[1] - 2,
                                       -4 * a4 + 32 * a3 - 88 * a2 + 96 * a + x[1] - 36};
          }};
}
Problem g08() {
  constexpr double pi = 3.14159265358979323846;
  return {"g08", vector_of({0.1, 0.1}), vector_of({10, 10}), -0.0958250414180359,
          [](const VectorXd& x) {
            return -std::pow(std::sin(2 * pi * x[0]), 3) * std::sin(2 * pi * x[1]) /
                   (std::pow(x[0], 3) * (x[0] + x[1]));
          },
          [](const VectorXd& x) {
            return std::vector<double>{x[0] * x[0] - x[1] + 1, 1 - x[0] + (x[1] - 4) * (x[1] - 4)};
          }};
}
Problem g04() {
  return {"g04", vector_of({78, 33, 27, 27, 27}), vector_of({102, 45, 45, 45, 45}), -30665.538671783317,
          [](const VectorXd& x) {
            return 5.3578547 * x[2] * x[2] + 0.8356891 * x[0] * x[4] + 37.293239 * x[0] - 40792.141;
          },
          [](const VectorXd& x) {
            const double u =
                85.334407 + 0.0056858 * x[1] * x[4] + 0.0006262 * x[0] * x[3] - 0.0022053 * x[2] * x[4];
            const double v =
                80.51249 + 0.0071317 * x[1] * x[4] + 0.0029955 * x[0] * x[1] + 0.0021813 * x[2] * x[2];
            const double w =
                9.300961 + 0.0047026 * x[2] * x[4] + 0.0012547 * x[0] * x[2] + 0.0019085 * x[2] * x[3];
            return std::vector<double>{u - 92, -u, v - 110, 90 - v, w - 25, 20 - w};
          }};
}

const Screen nothing_rejected = [](const std::vector<VectorXd>& places) {
  return std::vector<double>(places.size(), 0.0);
};

std::vector<Look> searched(Search& search, const Problem& problem, int looks, int at_a_time) {
  std::vector<Look> all;
  while (static_cast<int>(all.size()) < looks) {
    std::vector<Look> told;
    for (const VectorXd& place : search.ask(at_a_time)) told.push_back(problem.look(place));
    search.tell(told);
    all.insert(all.end(), told.begin(), told.end());
  }
  return all;
}

Look best_of(const std::vector<Look>& looks) { return *std::min_element(looks.begin(), looks.end(), better); }

SurrogateSearch surrogate(const Problem& problem, std::uint64_t seed) {
  SurrogateSettings settings;
  settings.seed = seed;
  return {problem.low.size(), settings, nothing_rejected};
}

}  // namespace

TEST_CASE("measure", "[.]") {
  for (const Problem& problem : {tutorial(), g24(), g08(), g04()})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      SurrogateSearch search = surrogate(problem, seed);
      const std::vector<Look> looks = searched(search, problem, 100, 2);
      const auto at = [&](std::size_t n) { return best_of({looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(n)}); };
      RandomSearch other(problem.low.size(), seed, {}, nothing_rejected);
      const Look random = best_of(searched(other, problem, 100, 2));
      printf("%s %g:", problem.name, problem.least);
      for (std::size_t n : {20, 30, 40, 60, 80, 100})
        printf(" %s%.6g", at(n).feasible() ? "" : "!", at(n).aims[0] - problem.least);
      printf("  random %s%g\n", random.feasible() ? "" : "!", random.aims[0] - problem.least);
    }
}
