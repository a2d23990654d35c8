#include "pipeline/advise/calibrate/emulator.h"

#include <random>

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

Emulator of(double value, double low, double high) {
  return {VectorXd::Zero(1), VectorXd::Ones(1), value, VectorXd::Constant(1, low), VectorXd::Constant(1, high)};
}
double at(const Emulator& emulator, double z) { return emulator(VectorXd::Constant(1, z)); }

TEST_CASE("emulator: a sum of parabolas comes back between its runs, from any centre and with any steps") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const int axes = 1 + trial % 4;
    VectorXd slope(axes), bend(axes), centre(axes), step(axes);
    for (int j = 0; j < axes; ++j)
      slope[j] = number(random), bend[j] = number(random), centre[j] = number(random), step[j] = 1.1 + number(random);
    const auto truth = [&](const VectorXd& z) { return 3 + slope.dot(z) + bend.dot(z.cwiseProduct(z)); };
    VectorXd low(axes), high(axes);
    for (int j = 0; j < axes; ++j) {
      VectorXd z = centre;
      z[j] = centre[j] - step[j];
      low[j] = truth(z);
      z[j] = centre[j] + step[j];
      high[j] = truth(z);
    }
    const Emulator emulator(centre, step, truth(centre), low, high);
    VectorXd inside(axes);
    for (int j = 0; j < axes; ++j) inside[j] = centre[j] + step[j] * number(random);
    CHECK(emulator(inside) == Approx(truth(inside)).margin(1e-12));
  }
}

TEST_CASE("emulator: straight on beyond its runs, and never back") {
  const Emulator line = of(1, 0, 2);
  CHECK(at(line, 5) == Approx(6));
  CHECK(at(line, -5) == Approx(-4));
  const Emulator saturating = of(0, -4, 1);  // 2.5 d - 1.5 d^2, with its maximum at 0.83
  CHECK(at(saturating, 1) == Approx(1));
  CHECK(at(saturating, 3) == Approx(1));         // constant beyond the maximum
  CHECK(at(saturating, -2) == Approx(-9.5));     // slope 5.5 at -1
  CHECK(at(of(0, -8, 1), -2) == Approx(-19.5));  // 4.5 d - 3.5 d^2: slope 11.5 there
}

TEST_CASE("emulator: one that depends on nothing says the same everywhere") {
  CHECK(Emulator(2.5)(VectorXd::Constant(7, 3.0)) == 2.5);
}

}  // namespace
}  // namespace dresslife::pipeline
