#include "pipeline/cable/helix.h"

#include <numbers>
#include <random>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/pipeline/cable/space_curve.h"

using namespace dresslife;
using namespace dresslife::helices;
using dresslife::pipeline::Kinematics;

namespace {

struct State {
  double elongation, curvature1, curvature2, twist;
};

/// The glued component at the last level of a nesting, in the deformed and the undeformed construction.
struct Nested {
  ComponentState<double> now, rest;
  double strain() const { return now.stretch.at[0] / rest.stretch.at[0] - 1; }
};

Nested nest(const State& state, const std::vector<space_curve::Level>& levels, Kinematics kinematics) {
  const int order = static_cast<int>(levels.size()) + 1;
  Nested nested{uniform_rod<double>(state.elongation, state.curvature1, state.curvature2, state.twist, order),
                uniform_rod<double>(0, 0, 0, 0, order)};
  for (const auto& level : levels) {
    const Placement place = make_placement(kinematics, level.radius, level.lay_angle, level.phase);
    nested = {child(nested.now, place), child(nested.rest, place)};
  }
  return nested;
}

class Random {
 public:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  State state() { return {between(-0.02, 0.02), between(-7, 7), between(-7, 7), between(-10, 10)}; }
  /// Returns random radii and lay angles as in a dresspack, of both hands.
  std::vector<space_curve::Level> levels(int depth) {
    std::vector<space_curve::Level> levels;
    double radius = between(0.005, 0.02);
    for (int k = 0; k < depth; ++k) {
      levels.push_back({radius, between(-30, 30) * degree, between(0, 2 * std::numbers::pi)});
      radius *= between(0.15, 0.4);
    }
    return levels;
  }

 private:
  std::mt19937_64 engine_{20180501};
};

// The recursion is exact. The remaining difference is the rounding of strains of 1e-4 as differences of stretches near one and,
// at three levels, the error of the reference's triple finite differences: (20 um / 1.4 mm)^6 = 1e-11 of the path, which is
// 1e-7 of a strain of 1e-4.
constexpr double strain_tolerance = 1e-7;
constexpr double smallest_strain = 1e-4;
constexpr double rate_tolerance = 1e-7;

void compare_with_space(int depth, int states) {
  Random random;
  double worst_strain = 0, worst_rate = 0;
  for (int k = 0; k < states; ++k) {
    const State state = random.state();
    const auto levels = random.levels(depth);
    const Nested nested = nest(state, levels, Kinematics::exact);
    const space_curve::Curves now{1.0L + state.elongation, {state.curvature1, state.curvature2, state.twist}, levels};
    const space_curve::Curves rest{1.0L, {0, 0, 0}, levels};
    const double strain = static_cast<double>(now.stretch_of_last() / rest.stretch_of_last() - 1);
    worst_strain =
        std::max(worst_strain, std::abs(nested.strain() - strain) / std::max(std::abs(strain), smallest_strain));
    if (k % 10 != 0) continue;  // the reference's rates take six times as long as its strain
    const Eigen::Vector3d change = (now.rate_of_last() - rest.rate_of_last()).cast<double>();
    const Eigen::Vector3d ours(nested.now.bend1.at[0] - nested.rest.bend1.at[0],
                               nested.now.bend2.at[0] - nested.rest.bend2.at[0],
                               nested.now.twist.at[0] - nested.rest.twist.at[0]);
    worst_rate = std::max(worst_rate, (ours - change).norm() / change.norm());
  }
  CAPTURE(depth, worst_strain, worst_rate);
  CHECK(worst_strain < strain_tolerance);
  CHECK(worst_rate < rate_tolerance);
}

}  // namespace

TEST_CASE("one level of helices agrees with curves in space") { compare_with_space(1, 1000); }
TEST_CASE("two levels of helices agree with curves in space") { compare_with_space(2, 1000); }
TEST_CASE("three levels of helices agree with curves in space") { compare_with_space(3, 1000); }

TEST_CASE("a fibre on a wire's surface agrees with a curve in space") {
  // A fibre is a straight curve beside the wire's axis. When the wire twists, the fibre winds around the axis, which adds
  // length: the wire's shear (W19). It is subtracted by Pythagoras. Rounding: of 1e-4 as above.
  Random random;
  double worst = 0, worst_of_sum = 0;
  for (int k = 0; k < 300; ++k) {
    const State state = random.state();
    auto levels = random.levels(2);
    const Nested wire = nest(state, levels, Kinematics::exact);
    const double r = static_cast<double>(levels.back().radius) * random.between(0.1, 0.5);
    const double phi = random.between(0, 2 * std::numbers::pi);
    levels.push_back({r, 0, phi});
    const auto length = [&](const space_curve::Curves& curve, const ComponentState<double>& rod) {
      const auto path = curve.stretch_of_last(), winding = static_cast<long double>(r * rod.twist.at[0]);
      return std::sqrt(path * path - winding * winding);
    };
    const auto now =
        length({1.0L + state.elongation, {state.curvature1, state.curvature2, state.twist}, levels}, wire.now);
    const auto rest = length({1.0L, {0, 0, 0}, levels}, wire.rest);
    const double strain = static_cast<double>(now / rest - 1);
    const WireState<double> at_rest{wire.rest.stretch.at[0], wire.rest.bend1.at[0], wire.rest.bend2.at[0],
                                    wire.rest.twist.at[0], 1};
    const FibreShape fibre = fibre_shape(Kinematics::exact, at_rest, r, std::sin(phi), std::cos(phi));
    const double bend1 = wire.now.bend1.at[0] - wire.rest.bend1.at[0];
    const double bend2 = wire.now.bend2.at[0] - wire.rest.bend2.at[0];
    const double ours = fibre_strain(fibre, wire.strain(), bend1, bend2);
    const double sum = wire.strain() + r * (bend1 * std::sin(phi) - bend2 * std::cos(phi));
    worst = std::max(worst, std::abs(ours - strain) / std::max(std::abs(strain), smallest_strain));
    worst_of_sum = std::max(worst_of_sum, std::abs(sum - strain) / std::max(std::abs(strain), smallest_strain));
  }
  CAPTURE(worst, worst_of_sum);
  CHECK(worst < strain_tolerance);
  CHECK(worst_of_sum > 0.01);  // the sum of strain and change of bending is a different number
}

TEST_CASE("a straight part of a twisted dresspack stretches by geometry, not by twice that as in the thesis") {
  const State twisted{0, 0, 0, 5};
  const std::vector<space_curve::Level> cable{{0.01845L, 0, 0}};
  // sqrt(1 + (R tau)^2) - 1 and (R tau)^2 / (1 + (R tau)^2)
  CHECK(nest(twisted, cable, Kinematics::exact).strain() == Approx(0.00424602).epsilon(1e-6));
  CHECK(nest(twisted, cable, Kinematics::thesis).strain() == Approx(0.00843825).epsilon(1e-6));
}

TEST_CASE("the thesis' equations give the numbers evaluated by hand") {
  // eps 0.001, kappa (2, -1) 1/m, tau 3 rad/m; conductor R 2.825 mm, 25 deg, theta 0.7; wire R 0.75 mm, 5 deg, theta 2
  const State state{0.001, 2, -1, 3};
  const auto conductor = nest(state, {{0.002825L, 25 * degree, 0.7L}}, Kinematics::thesis);
  constexpr double digits = 1e-12;
  CHECK(conductor.strain() == Approx(0.008833103190336391).epsilon(digits));
  CHECK(conductor.now.twist.at[0] == Approx(0.7950300460873669).epsilon(digits));  // (16)
  CHECK(conductor.now.bend2.at[0] == Approx(0.8000364651749452).epsilon(digits));  // (17)
  CHECK(conductor.now.bend1.at[0] == Approx(1.6761881725546248).epsilon(digits));  // (18)
  const auto wire = nest(state, {{0.002825L, 25 * degree, 0.7L}, {0.00075L, 5 * degree, 2.0L}}, Kinematics::thesis);
  CHECK(wire.strain() == Approx(0.010200217430071047).epsilon(digits));         // (20)
  CHECK(wire.now.twist.at[0] == Approx(0.16092222367210385).epsilon(digits));   // (21)
  CHECK(wire.now.bend2.at[0] == Approx(0.029817250902044963).epsilon(digits));  // (22)
  CHECK(wire.now.bend1.at[0] == Approx(1.8430355238940468).epsilon(digits));    // (23)
}

TEST_CASE("in a twisted cable the worst wire strains half as much again as the thesis says") {
  // A cable at 180 deg/m; conductors and wires of table 1. (16) neglects the parent's twist, so the thesis' wires get only their
  // conductor's stretch.
  double exact = 0, thesis = 0;
  for (int k = 0; k < 36; ++k) {
    const std::vector<space_curve::Level> levels{{0.002825L, 25 * degree, 0}, {0.00075L, 5 * degree, 10 * k * degree}};
    exact = std::max(exact, nest({0, 0, 0, std::numbers::pi}, levels, Kinematics::exact).strain());
    thesis = std::max(thesis, nest({0, 0, 0, std::numbers::pi}, levels, Kinematics::thesis).strain());
  }
  CHECK(exact == Approx(0.00496).epsilon(2e-3));  // equal to the reference's curves, above
  CHECK(thesis == Approx(0.00341).epsilon(2e-3));
}

TEST_CASE("the mean over the phases is the average of many phases") {
  Random random;
  for (int k = 0; k < 200; ++k) {
    const State state = random.state();
    const auto levels = random.levels(1);
    for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis}) {
      const auto rod = uniform_rod<double>(state.elongation, state.curvature1, state.curvature2, state.twist, 1);
      auto place = [&](double phase) {
        return make_placement(kinematics, levels[0].radius, levels[0].lay_angle, phase);
      };
      double mean = 0;
      constexpr int phases = 64;  // so many that the average of a smooth periodic function is exact to rounding
      for (int m = 0; m < phases; ++m) mean += path_rate(rod, place(2 * std::numbers::pi * m / phases)) / phases;
      constexpr double next_term = 3e-7;  // A (R K)^6 / 50 at the largest sampled radius, curvature and lay angle
      CHECK(std::abs(mean_path_rate(rod, place(0.3)) - mean) < next_term);
    }
  }
}

TEST_CASE("the last level's values are those of the full recursion") {
  Random random;
  for (int k = 0; k < 200; ++k) {
    const State state = random.state();
    const auto levels = random.levels(3);
    for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis}) {
      const Nested parent = nest(state, {levels[0], levels[1]}, kinematics), wire = nest(state, levels, kinematics);
      ComponentState<double> at_order_one = parent.now;
      REQUIRE(parent.now.stretch.order >= (kinematics == Kinematics::exact ? 1 : 0));
      const auto values =
          wire_state(at_order_one, make_placement(kinematics, levels[2].radius, levels[2].lay_angle, levels[2].phase));
      CHECK(values.stretch == Approx(wire.now.stretch.at[0]).epsilon(1e-14));
      const bool exact = kinematics == Kinematics::exact;
      CHECK(values.bend1 == Approx(exact ? wire.now.bend1.at[0] : -wire.now.bend2.at[0]).epsilon(1e-12).margin(1e-11));
      CHECK(values.bend2 == Approx(exact ? wire.now.bend2.at[0] : wire.now.bend1.at[0]).epsilon(1e-12).margin(1e-11));
    }
  }
}
