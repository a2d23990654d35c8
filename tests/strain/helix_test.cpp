#include "strain/helix.h"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "tests/strain/space_curve.h"

using namespace dresslife::strain;
using dresslife::pipeline::Kinematics;

namespace {

constexpr double degree = std::numbers::pi / 180;

struct State {
  double elongation, curvature1, curvature2, twist;
};

/// The glued component at the end of the chain of levels, in the deformed and the undeformed construction.
struct Nested {
  Rod<double> now, rest;
  double strain() const { return now.stretch.at[0] / rest.stretch.at[0] - 1; }
};

Nested nest(const State& state, const std::vector<space_curve::Level>& levels, Kinematics kinematics) {
  const int order = static_cast<int>(levels.size());
  Nested nested{uniform_rod<double>(state.elongation, state.curvature1, state.curvature2, state.twist, order),
                uniform_rod<double>(0, 0, 0, 0, order)};
  for (const auto& level : levels) {
    const Placement place(kinematics, level.radius, level.lay_angle, level.phase);
    nested = {child(nested.now, place), child(nested.rest, place)};
  }
  return nested;
}

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  State state() { return {between(-0.02, 0.02), between(-7, 7), between(-7, 7), between(-10, 10)}; }
  /// Radii and lay angles as in a dresspack, of both hands.
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

// The recursion has no approximation; what remains is the rounding of strains of 1e-4 as differences of
// stretches near one and, at three levels, the oracle's thrice nested finite differences: (20 um / 1.4 mm)^6
// = 1e-11 of the path, hence 1e-7 of a strain of 1e-4.
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
    const space_curve::Curves now{
        1.0L + state.elongation, {state.curvature1, state.curvature2, state.twist}, levels};
    const space_curve::Curves rest{1.0L, {0, 0, 0}, levels};
    const double strain = static_cast<double>(now.stretch_of_last() / rest.stretch_of_last() - 1);
    worst_strain = std::max(worst_strain,
                            std::abs(nested.strain() - strain) / std::max(std::abs(strain), smallest_strain));
    if (k % 10 != 0) continue;  // the oracle's rates cost six times its strain
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
