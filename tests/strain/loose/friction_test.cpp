// Sideways friction of loose cables (W36) against closed forms, its own energy, and other steps.
#include <cmath>
#include <numbers>

#include "strain/loose/rings.h"
#include "tests/catch.h"
#include "tests/strain/loose/hoses.h"

using namespace dresslife::strain;
using dresslife::strain::test::hose;
using dresslife::strain::test::signal_cable;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double step = 0.04;  // between samples [s]
constexpr double gravity = 9.81;
constexpr double mu = 0.3, play = 0.004;
constexpr std::size_t elements = 64;
// Friction gives by 10 um before it has its limit: as an angle at the wall of its play. The wall's depth and the limit
// of the sample before are smaller.
constexpr double angle_of_spring = 1e-5 / play;

/// Limp, so that its middle lies as the forces there ask for, and hardly moved by drag.
LooseCable limp_cable() {
  LooseCable cable = signal_cable(0);
  cable.axial_stiffness = 10;
  cable.bending_stiffness = 0.01;
  cable.play = play;
  cable.friction = mu;
  cable.drag = 1e-3;
  return cable;
}

/// Of the offset at the middle, from d1 toward d2 [rad].
double angle_at_middle(const CableState& state) {
  const std::size_t middle = state.offset.size() / 4 * 2;
  return std::atan2(state.offset[middle + 1], state.offset[middle]);
}

/// A straight tube under a gravity that has turned against it by an angle.
std::vector<HoseNode> turned_tube(double angle) {
  return hose(elements, [&](double) {
    return HoseNode{.pull = {gravity * std::cos(angle), gravity * std::sin(angle)}};
  });
}

}  // namespace

TEST_CASE("a cable in a turning tube slips at the angle of friction, and stays behind by it either way") {
  const double slip = std::atan(mu);
  for (const double turn : {0.02, 0.01}) {  // of the tube in a sample [rad]
    LooseCables cables({limp_cable()}, {4, elements});
    cables.advance(turned_tube(0), step);
    cables.advance(turned_tube(0), step);
    const double tolerance = 2 * angle_of_spring + turn * mu;  // the limit is that of the sample before
    double angle = 0;
    const auto go_to = [&](double end, auto expected) {
      while (std::abs(end - angle) > turn / 2) {
        angle += std::copysign(turn, end - angle);
        cables.advance(turned_tube(angle), step);
        CAPTURE(turn, angle);
        REQUIRE(angle_at_middle(cables.state(0)) == Approx(expected(angle)).margin(tolerance));
      }
    };
    go_to(1, [&](double at) { return std::max(0.0, at - slip); });
    const double held = 1 - slip;
    go_to(-1, [&](double at) { return std::min(held, at + slip); });
  }
}

TEST_CASE("without friction a cable follows gravity at once") {
  LooseCable cable = limp_cable();
  cable.friction = 0;
  LooseCables cables({cable}, {4, elements});
  for (double angle = 0; angle < 1; angle += 0.02) {
    cables.advance(turned_tube(angle), step);
    CHECK(angle_at_middle(cables.state(0)) == Approx(angle).margin(1e-3));
  }
}

TEST_CASE("a cable pulled around a bend slips sideways where the force across is the friction of its pull") {
  // T kappa presses it to the inside of the bend. Forces across and to the wall have the angle atan(w / (T kappa)) from
  // that; the cable follows it, less the angle of friction.
  LooseCable cable = limp_cable();
  cable.axial_stiffness = 1e5;
  cable.mass_per_length = 1;
  LooseCables cables({cable}, {4, elements});
  constexpr double kappa = 0.5;
  const auto at = [&](double across) {
    return hose(elements, [&](double) {
      return HoseNode{.curvature2 = kappa, .elongation = 4e-3, .pull = {0, across}};
    });
  };
  cables.advance(at(0), step);
  for (int t = 0; t < 5; ++t) cables.advance(at(0), step);
  double slipped = 0;
  for (double across = 0; across < 120; across += 1) {
    cables.advance(at(across), step);
    const CableState& state = cables.state(0);
    const double leans = std::atan2(across, state.tension[0] * kappa);
    const double expected = std::max(0.0, leans - std::atan(mu));
    CAPTURE(across, state.tension[0]);
    REQUIRE(angle_at_middle(state) == Approx(expected).margin(0.01));  // a step's turn, and 1 % of the way along
    slipped = expected;
  }
  CHECK(slipped > 0.1);
}

TEST_CASE("what forces put in over a cycle is the work of friction") {
  LooseCables cables({limp_cable()}, {4, elements});
  const double mass = limp_cable().mass_per_length, h = 4.0 / elements;
  double put_in = 0, rubbed = 0, angle_before = 0;
  std::vector<double> offset, press;
  constexpr int cycle = 400;
  for (int t = 0; t <= 2 * cycle; ++t) {
    const double angle = std::sin(2 * pi * t / cycle);
    cables.advance(turned_tube(angle), step);
    const CableState& state = cables.state(0);
    for (std::size_t i = 1; t > cycle && i < elements; ++i) {
      const Eigen::Vector2d here(state.offset[2 * i], state.offset[2 * i + 1]), before(offset[2 * i], offset[2 * i + 1]);
      const Eigen::Vector2d weight =
          mass * gravity / 2 *
          Eigen::Vector2d(std::cos(angle) + std::cos(angle_before), std::sin(angle) + std::sin(angle_before));
      put_in += h * weight.dot(here - before);
      rubbed += h * mu * (press[i] + state.press[i]) / 2 * (here - before).norm();
    }
    offset = state.offset;
    press = state.press;
    angle_before = angle;
  }
  // per length that lies on the wall, 4 atan(mu) of its way of 4 (1 - atan(mu)) are elastic: of the order of 1 % in all
  CHECK(rubbed > 0.02);  // [J]
  CHECK(put_in == Approx(rubbed).epsilon(0.02));  // the spring of friction and trapezoids of 100 steps
}

TEST_CASE("half the steps take a rubbing cable the same way, and so does a hundredth of the drag") {
  LooseCable cable = signal_cable(0.012, 0.005);
  cable.play = 0.005;
  cable.slack = 0.002;
  cable.friction = mu;
  const auto way = [&](int cycle, double drag) {
    cable.drag = drag;
    LooseCables cables({cable}, {2.035, elements});
    std::vector<std::vector<double>> offsets;
    for (int t = 0; t <= 2 * cycle; ++t) {
      const double w = 2 * pi * t / cycle;
      cables.advance(hose(elements,
                          [&](double z) {
                            return HoseNode{(1.5 + 0.5 * std::sin(w)) * std::sin(pi * z),
                                            0.8 * std::cos(w) * std::cos(2 * pi * z),
                                            0.6 * std::sin(w),
                                            0,
                                            {gravity * std::sin(pi * z), -gravity * std::cos(pi * z)}};
                          }),
                     4.0 / cycle);
      if (t * 100 % cycle == 0) offsets.push_back(cables.state(0).offset);
    }
    return offsets;
  };
  const auto apart = [](const auto& a, const auto& b) {  // root of the mean square [m]
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < a.size(); ++t)
      for (std::size_t i = 0; i < a[t].size(); ++i, ++count) sum += std::pow(a[t][i] - b[t][i], 2);
    return std::sqrt(2 * sum / static_cast<double>(count));
  };
  constexpr double drag = 0.012, of_program = 1.2;
  const auto coarse = way(100, drag), middle = way(200, drag), fine = way(400, drag);
  const double first = apart(coarse, middle), second = apart(middle, fine);
  INFO(first << " and " << second << " m apart");
  CHECK(first < 2e-5);                 // twice the way of friction's spring
  CHECK(second < first);               // the limit of friction lags by one sample: first order
  CHECK(apart(coarse, way(100, of_program)) < 0.01 * 0.005);  // drag moves it by less than a hundredth of its play
}

TEST_CASE("a twisting hose turns its ring of cables by friction alone") {
  std::vector<LooseCable> cables;
  for (int k = 0; k < 10; ++k) {
    cables.push_back(signal_cable(0.01845 * std::cos(2 * pi * k / 10), 0.01845 * std::sin(2 * pi * k / 10)));
    cables.back().axial_stiffness = 10;
    cables.back().bending_stiffness = 0.01;
    cables.back().drag = 1e-3;
  }
  fit_in_hose(cables, {0.0255, 0.013});
  const double length = 4, most = 0.3;  // of the middle's turn [rad]
  for (const double coefficient : {0.0, mu}) {
    for (LooseCable& cable : cables) cable.friction = coefficient;
    LooseCables loose(cables, {length, elements});
    for (int t = -3; t <= 60; ++t) {
      const double turn = most * std::max(0, t) / 60;
      loose.advance(hose(elements,
                         [&](double z) {  // turned by `turn` sin^2(pi z)
                           const double here = turn * std::pow(std::sin(pi * z), 2);
                           return HoseNode{.twist = turn * pi * std::sin(2 * pi * z) / length,
                                           .pull = {-gravity * std::sin(here), -gravity * std::cos(here)}};
                         }),
                    step);
    }
    double turned_in_hose = 0;  // of the ring's middle, mean of its cables
    for (std::size_t k = 0; k < 10; ++k) {
      const std::vector<double>& offset = loose.state(k).offset;
      const auto [x, y] = cables[k].place;
      const double now = std::atan2(y + offset[elements + 1], x + offset[elements]);
      turned_in_hose += std::remainder(now - std::atan2(y, x), 2 * pi) / 10;
    }
    INFO(coefficient << ": " << turned_in_hose);
    if (coefficient == 0)
      CHECK(turned_in_hose == Approx(-most).epsilon(0.05));  // stays in space: bending of 4 m is soft
    else
      CHECK(std::abs(turned_in_hose) < 0.05 * most);  // goes with the hose
  }
}
