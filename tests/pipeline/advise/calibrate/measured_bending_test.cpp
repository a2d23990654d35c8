#include "pipeline/advise/calibrate/measured_bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// A bar of sliders, moved step by step: a reference for Masing's rule.
class Sliders {
 public:
  double move(double curvature) {
    double moment = 0.02 * curvature;
    for (std::size_t i = 0; i < 6; ++i) {
      held_[i] = std::clamp(held_[i] + stiffness(i) * (curvature - last_), -cap(i), cap(i));
      moment += held_[i];
    }
    last_ = curvature;
    return moment;
  }
  static double first(double curvature) {
    double moment = 0.02 * curvature;
    for (std::size_t i = 0; i < 6; ++i) moment += std::clamp(stiffness(i) * curvature, -cap(i), cap(i));
    return moment;
  }

 private:
  static double stiffness(std::size_t i) { return 0.3 / double(i + 1); }
  static double cap(std::size_t i) { return 0.03 + 0.05 * double(i); }
  std::array<double, 6> held_{};
  double last_ = 0;
};

TEST_CASE("bending: sums of the first bend say what sliders do on any path") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int trial = 0; trial < 100; ++trial) {
    Sliders sliders;
    std::vector<BendingPoint> points;
    double at = 0;
    for (int turn = 0; turn < 12; ++turn) {  // to a turning point in a few steps
      const double to = number(random);
      for (int step = 1; step <= 3; ++step) {
        const double k = at + (to - at) * step / 3;
        points.push_back({k, sliders.move(k)});
      }
      at = to;
    }
    const BendingNumbers bent = bending_numbers(points, 0.05);
    REQUIRE(bent.numbers.size() == points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      double sum = 0;
      for (const auto& [quantity, factor] : bent.numbers[k].parts)
        sum += factor * Sliders::first(bent.curvatures[quantity]);
      CHECK(sum == Approx(points[k].moment).margin(1e-12));
    }
  }
}

TEST_CASE("bending: noise is a share of the largest moment at every point of a curve") {
  const BendingNumbers bent = bending_numbers({{1, 2}, {-1, -2}, {0.9, 0.01}}, 0.05);
  CHECK(bent.numbers[0].deviation == Approx(0.1));
  CHECK(bent.numbers[2].deviation == Approx(0.1));
  CHECK(bending_numbers({{0, 0}, {1, 2}}, 0.05).numbers.size() == 1);
  // Forty readings of one moment say as much as ten.
  CHECK(bending_numbers(std::vector<BendingPoint>(10, {1, 2}), 0.05).numbers[0].deviation == Approx(0.1));
  CHECK(bending_numbers(std::vector<BendingPoint>(40, {1, 2}), 0.05).numbers[0].deviation == Approx(0.2));
}

TEST_CASE("bending: tables between their values, straight in logarithms") {
  const std::vector<double> curvatures{0.1, 1, 10}, moments{0.01, 0.1, 0.4};
  CHECK(std::exp(log_moment(curvatures, moments, 0.3)) == Approx(0.03));
  CHECK(std::exp(log_moment(curvatures, moments, 1)) == Approx(0.1));
  CHECK(std::exp(log_moment(curvatures, moments, 10)) == Approx(0.4));
  CHECK(std::exp(log_moment(curvatures, moments, 0.01)) == Approx(0.001));
}

TEST_CASE("bending: a decrement by slip is what a swing of sliders loses, stepped in time") {
  std::vector<double> curvatures, moments;
  for (double k = 1e-3; k < 20; k *= std::pow(10, 1.0 / 200))
    curvatures.push_back(k), moments.push_back(Sliders::first(k));
  constexpr int places = 20;
  for (const double largest : {0.3, 1.0, 3.0}) {
    // One mode of a clamped bar with unit modal mass. Its curvature follows from the natural form of the bar's equation.
    std::array<Sliders, places> bar;
    std::array<double, places> form;
    const double beta = 1.875104068711961,
                 sigma = (std::sinh(beta) - std::sin(beta)) / (std::cosh(beta) + std::cos(beta));
    for (int i = 0; i < places; ++i) {
      const double x = beta * (i + 0.5) / places;
      form[i] = (std::cosh(x) + std::cos(x) - sigma * (std::sinh(x) + std::sin(x))) / 2;
    }
    const auto force = [&](double q) {
      double sum = 0;
      for (int i = 0; i < places; ++i) sum += form[i] * bar[i].move(form[i] * q) / places;
      return sum;
    };
    // The bar is bent once to and fro by hand, so that every slider is on its closed loop. Then it is released until the
    // second next turning point.
    force(-largest);
    double q = largest, speed = 0, pull = force(q), before = q;
    for (int turns = 0; turns < 2;) {
      constexpr double step = 1e-3;
      speed -= pull * step;
      before = q;
      q += speed * step;
      pull = force(q);
      if ((q - before) * (speed - pull * step) < 0) ++turns;
    }
    const double stepped = std::log(largest / q);
    INFO(largest << ": " << stepped);
    // (P7) is of first order in the energy that a swing loses, so its relative error is about the relative loss.
    CHECK(std::exp(log_decrement_by_slip(curvatures, moments, largest)) == Approx(stepped).epsilon(stepped + 0.02));
  }
}

TEST_CASE("bending: what loses nothing has no more than air's decrement") {
  CHECK(std::exp(log_decrement_by_slip({0.01, 0.1, 1, 10}, {0.002, 0.02, 0.2, 2}, 1)) == Approx(1e-4));
}

TEST_CASE("bending: bad tables are refused at their line") {
  const Scratch scratch;
  const auto refusal = [&](const std::string& text) {
    const auto file = scratch.write("bend.csv", text);
    const std::string message = message_of([&] { read_bending(file); });
    return message.empty() ? message : message.substr(message.find("bend.csv"));
  };
  const std::string head = "curvature_1_per_m, moment_Nm\n";
  CHECK(refusal(head + "0,0\n1,0.2\r\n\n-1,-0.2\n") == "");
  CHECK(refusal("k,m\n1,2\n").starts_with("bend.csv:1:1: error: is not the header of a bending test"));
  CHECK(refusal(head + "1,0.2\n1;0.3\n").starts_with("bend.csv:3:1: error: has 1 columns"));
  CHECK(refusal(head + "1,0.2x\n").starts_with("bend.csv:2:3: error: '0.2x' is not a number"));
  CHECK(refusal(head + "nan,0.2\n").starts_with("bend.csv:2:1: error: 'nan' is not a number"));
  CHECK(refusal(head + "0,0\n").find("holds no moment of a bent cable") != std::string::npos);
  CHECK(refusal(head + "1,-0.2\n2,-0.3\n").find("another sign than its curvature") != std::string::npos);
  CHECK_THAT(refusal("curvature_1_per_m;moment_Nm\n0,5;0,02\n"),
             Catch::Contains("'0,5' is not a number; write 0.5 with a point"));
  CHECK(refusal("curvature_1_per_m;moment_Nm\n1/m;Nm\n1;0.2\n")
            .starts_with("bend.csv:2:1: error: '1/m' is not a number"));
}

TEST_CASE("bending: a table as other systems write it is the same table") {
  const Scratch scratch;
  for (const char* text :
       {"curvature_1_per_m,moment_Nm\n1,0.2\n2,0.3\n",
        "\xEF\xBB\xBF"
        "curvature_1_per_m,moment_Nm\r\n1,0.2\r\n2,0.3\r\n",
        "# machine 3\ncurvature_1_per_m;moment_Nm\n1;0.2\n2;0.3\n", "moment_Nm\tcurvature_1_per_m\n0.2\t1\n0.3\t2\n"}) {
    const std::vector<BendingPoint> points = read_bending(scratch.write("bend.csv", text));
    REQUIRE(points.size() == 2);
    CHECK(points[0].curvature == 1);
    CHECK(points[1].moment == 0.3);
  }
}

}  // namespace
}  // namespace dresslife::pipeline
