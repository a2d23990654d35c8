#include "pipeline/advise/calibrate/likelihood.h"

#include <cmath>

#include "pipeline/base/statistics.h"

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

ObservedLife life(LifeEnd end, double observed, double median, double spread, int specimens = 1) {
  ObservedLife one;
  one.log_life = observed;
  one.end = end;
  one.specimens = specimens;
  one.variants = {[=](const VectorXd&) { return LifeAt{median, spread}; }};
  return one;
}
const VectorXd nowhere = VectorXd::Zero(1);
double value(const ObservedLife& observed) { return log_likelihood(observed, nowhere); }

TEST_CASE("likelihood: one specimen that broke, that has not, and that had by then") {
  CHECK(value(life(LifeEnd::broken, 2, 3, 0.5)) == Approx(-2 - std::log(0.5)));
  CHECK(value(life(LifeEnd::at_least, 2, 3, 0.5)) == Approx(log_normal_share(2)));
  CHECK(value(life(LifeEnd::at_most, 2, 3, 0.5)) == Approx(log_normal_share(-2)));
}

TEST_CASE("likelihood: the unshared spread of one specimen widens run-outs and upper bounds, too") {
  for (const auto& [end, sign] : {std::pair{LifeEnd::at_least, 1}, std::pair{LifeEnd::at_most, -1}}) {
    ObservedLife one = life(end, 2, 2.3, 0.4);
    one.unshared_spread = 0.3;  // together with 0.4 a spread of 0.5
    CHECK(value(one) == Approx(log_normal_share(sign * 0.6)));
  }
}

TEST_CASE("likelihood: several specimens share what their spool does to them") {
  const ObservedLife apart = life(LifeEnd::at_least, 2, 2.3, 0.5, 3);
  CHECK(value(apart) == Approx(3 * log_normal_share(0.6)).epsilon(1e-9));
  ObservedLife one_fate = apart;
  one_fate.common_share = 1;
  CHECK(value(one_fate) == Approx(log_normal_share(0.6)));
  // Two lives with correlation rho are both above their median in 1/4 + asin(rho)/(2 pi) of all cases.
  for (const double shared : {0.1, 0.5, 0.9}) {
    ObservedLife two = life(LifeEnd::at_least, 2, 2, 0.4, 2);
    two.common_share = shared;
    const double both = 0.25 + std::asin(shared) / (2 * std::numbers::pi);
    CHECK(value(two) == Approx(std::log(both)).epsilon(1e-4));
  }
  // Of n broken specimens the mean of the logarithms is given.
  ObservedLife mean = life(LifeEnd::broken, 2, 3, 0.5, 4);
  mean.common_share = 0.5;
  mean.unshared_spread = 0.3;
  const double variance = 0.125 + 0.09 + 0.125 / 4;
  CHECK(value(mean) == Approx(-0.5 / variance - std::log(variance) / 2));
}

TEST_CASE("likelihood: what is not known of a test counts each way alike") {
  ObservedLife mixed = life(LifeEnd::broken, 0, 0, 1);
  mixed.variants.push_back([](const VectorXd&) { return LifeAt{3, 1}; });
  CHECK(value(mixed) == Approx(std::log((1 + std::exp(-4.5)) / 2)));
}

TEST_CASE("likelihood: dresspacks in service are mixtures, and those of before the records count from their age then") {
  // Two kinds of dresspacks with equal frequency.
  ObservedLife service;
  service.variants = {[](const VectorXd&) { return LifeAt{1, 0.5}; }, [](const VectorXd&) { return LifeAt{3, 1}; }};
  const auto lives = [](double x) { return (normal_share((1 - x) / 0.5) + normal_share(3 - x)) / 2; };
  const auto density = [](double x) { return (normal_density((1 - x) / 0.5) / 0.5 + normal_density(3 - x)) / 2; };
  const auto of = [&](std::vector<ServiceFactor> factors) {
    service.service = std::move(factors);
    return value(service);
  };
  constexpr double table = 1e-6, rounding = 1e-12;  // shares from a table have an error of 3e-8
  CHECK(of({{2, true}}) == Approx(std::log(density(2))).epsilon(table));
  CHECK(of({{2, false}}) == Approx(std::log(lives(2))).epsilon(table));
  CHECK(of({{2, true}, {1.5, false, -1}}) == Approx(std::log(density(2) / lives(1.5))).epsilon(table));
  CHECK(of({{2, false, 3}, {1.5, false, -3}}) == Approx(3 * std::log(lives(2) / lives(1.5))).epsilon(table));
  // Where the shares underflow, only the kind with later failures contributes.
  CHECK(of({{50, false}}) == Approx(log_normal_share(-47) - std::log(2)).epsilon(rounding));
  CHECK(of({{50, true}}) ==
        Approx(-47.0 * 47 / 2 - std::log(2 * std::numbers::pi) / 2 - std::log(2)).epsilon(rounding));
}

TEST_CASE("likelihood: measured numbers are sums of what the model says") {
  Measurement loop;
  loop.log_quantities = {Emulator(std::log(2)), Emulator(std::log(3))};
  loop.numbers = {{5, 0.5, {{0, 1}, {1, 1}}}, {-1, 0.25, {{0, 1}, {1, -1}}}, {4, 1, {{0, 1.5}}}};
  CHECK(said_by_model(loop, loop.numbers[1], nowhere) == Approx(-1));
  CHECK(log_likelihood(loop, nowhere) == Approx(-0.5));
}

}  // namespace
}  // namespace dresslife::pipeline
