#include "pipeline/base/statistics.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/random.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("statistics: shares of the normal distribution are the printed ones, far out as logarithms") {
  CHECK(normal_share(0) == 0.5);
  CHECK(normal_share(1) == Approx(0.8413447460685429).epsilon(1e-15));
  CHECK(normal_share(-1.6448536269514722) == Approx(0.05).epsilon(1e-14));
  CHECK(log_normal_share(0) == Approx(std::log(0.5)));
  CHECK(log_normal_share(9) == Approx(0).margin(1e-15));
  // Abramowitz and Stegun, table 26.2: -log10 of the share beyond z.
  CHECK(-log_normal_share(-10) / std::numbers::ln10 == Approx(23.11805).epsilon(1e-6));
  CHECK(-log_normal_share(-30) / std::numbers::ln10 == Approx(197.30921).epsilon(1e-6));
  CHECK(log_normal_share(-6 - 1e-9) == Approx(log_normal_share(-6 + 1e-9)).epsilon(1e-5));
}

TEST_CASE("statistics: the density is the slope of the share, and the quantile its inverse") {
  for (double z = -5; z < 5.1; z += 0.5) {
    constexpr double step = 1e-5;  // its square / 6 and the rounding 1e-16 / 1e-5 are below 1e-10
    CHECK(normal_density(z) == Approx((normal_share(z + step) - normal_share(z - step)) / (2 * step)).margin(1e-10));
    // A share near 1 is rounded to 1.1e-16. This is the corresponding error of z.
    CHECK(normal_quantile(normal_share(z)) == Approx(z).margin(1e-15 + 2e-16 / normal_density(z)));
  }
}

TEST_CASE("statistics: a number at a place lies straight between its neighbours") {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> numbers{1, 2, 4, infinity};
  CHECK(number_at(numbers, 0) == 1);
  CHECK(number_at(numbers, 1.25) == 2.5);
  CHECK(number_at(numbers, 2.01) == infinity);
  CHECK(number_at(numbers, 3) == infinity);
  CHECK(number_at({7}, 0) == 7);
}

TEST_CASE("random: the bits are those of splitmix64, and normal numbers have mean 0 and deviation 1") {
  CHECK(mixed(0) == 0xe220a8397b1dcdaf);  // the first two published numbers for the seed 0
  CHECK(mixed(mix_step) == 0x6e789e6aa1b965f4);
  CHECK(uniform_of(0) > 0);
  CHECK(uniform_of(~std::uint64_t{0}) < 1);
  constexpr int count = 100'000;
  const std::vector<double> normals = RandomNumbers(3).normals(std::vector<double>(count));
  double sum = 0, squares = 0;
  for (const double number : normals) sum += number, squares += number * number;
  const double error = 4 / std::sqrt(count);  // four deviations of the mean, 2.8 of the mean square
  CHECK(std::abs(sum / count) < error);
  CHECK(std::abs(squares / count - 1) < error);
  CHECK(RandomNumbers(3).normal() == normals.front());
}
