#include "sim/robot/spline.h"

#include <cmath>

#include "tests/catch.h"

using namespace dresslife::sim;

constexpr double rounding = 1e-13;  // some tens of roundings of numbers near 1

TEST_CASE("spline: a spline goes through a cubic as it is") {
  const std::vector<double> times{0, 0.3, 1, 1.2, 2, 3.5};
  const auto cubic = [](double t) { return 1 - 2 * t + 0.7 * t * t - 0.3 * t * t * t; };
  Eigen::MatrixXd values(2, 6);
  for (int k = 0; k < 6; ++k) values.col(k) << cubic(times[k]), 5;
  const CubicSpline spline(times, values);
  for (double t = 0; t <= 3.5; t += 0.07) {
    CHECK(spline.at(t)[0] == Approx(cubic(t)).margin(rounding));
    CHECK(spline.at(t)[1] == Approx(5).epsilon(rounding));
  }
  CHECK(spline.at(-1)[0] == cubic(0));
  CHECK(spline.at(9)[0] == cubic(3.5));
}

TEST_CASE("spline: few knots give a parabola, a line, a constant") {
  const CubicSpline parabola({0, 1, 3}, Eigen::RowVector3d(0, 1, 9));
  CHECK(parabola.at(2)[0] == Approx(4).epsilon(rounding));
  const CubicSpline line({0, 2}, Eigen::RowVector2d(1, 5));
  CHECK(line.at(0.5)[0] == Approx(2).epsilon(rounding));
  const CubicSpline constant({0}, Eigen::MatrixXd::Constant(1, 1, 7));
  CHECK(constant.at(4)[0] == 7);
}

TEST_CASE("spline: a spline's error falls with the fourth power of the step") {
  const auto largest_error = [](int steps) {
    std::vector<double> times;
    Eigen::MatrixXd values(1, steps + 1);
    for (int k = 0; k <= steps; ++k) {
      times.push_back(2.0 * k / steps);
      values(0, k) = std::sin(3 * times.back());
    }
    const CubicSpline spline(times, values);
    double error = 0;
    for (double t = 0; t < 2; t += 0.003) error = std::max(error, std::abs(spline.at(t)[0] - std::sin(3 * t)));
    return error;
  };
  const double order = std::log2(largest_error(40) / largest_error(80));
  CHECK(order > 3.8);  // 4, reduced by the error at the ends for 40 knots
  CHECK(order < 4.5);
}

TEST_CASE("spline: at rest at both ends it goes through a cubic that is") {
  const auto cubic = [](double t) { return t * t * (3 - 2 * t); };
  const std::vector<double> times{0, 0.2, 0.3, 0.7, 1};
  Eigen::MatrixXd values(1, 5);
  for (int k = 0; k < 5; ++k) values(0, k) = cubic(times[static_cast<std::size_t>(k)]);
  const CubicSpline spline(times, values, SplineEnds::at_rest);
  for (double t = 0; t <= 1; t += 0.03) CHECK(spline.at(t)[0] == Approx(cubic(t)).margin(rounding));
  CHECK(spline.slope(0)[0] == Approx(0).margin(rounding));
  CHECK(spline.slope(2)[0] == Approx(6 * 0.3 * 0.7).margin(rounding));
}
