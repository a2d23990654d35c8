// Loose cables against chains of ODE's own bodies and joints in a hose in space (ode_cables.h), both under slow motion.
//
// Expected differences: chains of 32 segments are polygons, which turn by a quarter of a radian in all (error of position:
// the sag of a segment, l^2 kappa / 8 = 0.2 mm). The reduced model has bending and stretch to first order in the distance
// from the axis divided by the bend's radius (2 %), and no torsion of the cables, which the first test measures. Walls
// yield equally in both.
#include <cmath>

#include "pipeline/base/constants.h"
#include "strain/loose/rings.h"
#include "tests/catch.h"
#include "tests/strain/loose/hoses.h"
#include "tests/strain/loose/ode_cables.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace dresslife::strain::test;

namespace {

constexpr double length = 1;
constexpr std::size_t elements = 128;
constexpr int segments = 32, poses = 10;

using Motion = std::function<HoseNode(double along, double share)>;

/// Interpolates nodal values linearly. along: share of the length.
Eigen::Vector2d between(const std::vector<double>& nodes, double along) {
  const double at = along * elements;
  const auto low = std::min(static_cast<std::size_t>(at), elements - 1);
  const double on = at - static_cast<double>(low);
  const Eigen::Map<const Eigen::Vector2d> a(&nodes[2 * low]), b(&nodes[2 * low + 2]);
  return a + on * (b - a);
}

struct Comparison {
  double strain, ode_strain;
  double place = 0, offset = 0;                 ///< largest difference and offset [m]
  double curvature = 0, largest_curvature = 0;  ///< root of the mean square difference, largest value [1/m]
};

/// Returns the comparison at the last pose. twisting: G J / (E I) of the chains.
std::vector<Comparison> compare(const std::vector<LooseCable>& cables, double inner_radius, double core_radius,
                                double twisting, const Motion& motion) {
  OdeCables ode(cables, length, segments, twisting, inner_radius, core_radius);
  LooseCables loose(cables, {length, elements});
  for (int t = 1; t <= poses; ++t) {
    const auto at = [&](double z) { return motion(z, static_cast<double>(t) / poses); };
    const double moved = ode.follow(HoseCurve(length, at), at, t < poses ? 30 : 200);
    for (int k = 0; k < 20; ++k) loose.advance(hose(elements, at), 10);
    if (t == poses) REQUIRE(moved < 1e-6);  // [m] per step: at rest
  }
  const HoseCurve curve(length, [&](double z) { return motion(z, 1); });
  std::vector<Comparison> all;
  for (std::size_t k = 0; k < cables.size(); ++k) {
    const OdeState there = ode.state(k, curve);
    const CableState& here = loose.state(k);
    Comparison& c = all.emplace_back(Comparison{here.strain, there.strain});
    const Eigen::Vector2d a0(cables[k].place[0], cables[k].place[1]);
    for (int i = 0; i < segments; ++i) {
      const Eigen::Vector2d ours = between(here.offset, (i + 0.5) / segments), theirs = there.place[i] - a0;
      c.place = std::max(c.place, (ours - theirs).norm());
      c.offset = std::max(c.offset, theirs.norm());
    }
    for (int j = 2; j + 2 <= segments; ++j) {
      const Eigen::Vector2d ours = between(here.curvature, static_cast<double>(j) / segments);
      c.curvature += (ours - there.curvature[j - 2]).squaredNorm() / (segments - 3);
      c.largest_curvature = std::max(c.largest_curvature, there.curvature[j - 2].norm());
    }
    c.curvature = std::sqrt(c.curvature);
    INFO("cable " << k << ": strain " << c.strain << ", " << c.ode_strain << "; place " << c.place << " of " << c.offset
                  << "; curvature " << c.curvature << " of " << c.largest_curvature);
    CHECK(c.offset > 1e-3);  // the cable has moved away from its place
  }
  return all;
}

/// A cable flexible enough for a short hose: its bending length at a clamp is longer than a chain's segment.
LooseCable thick_cable(double place1, double place2) {
  LooseCable cable = signal_cable(place1, place2);
  cable.axial_stiffness = 1e5;
  cable.bending_stiffness = 0.5;
  cable.wall_stiffness = 5e6;
  return cable;
}

Motion swept_bend(double stretch) {
  return [stretch](double z, double share) {
    return HoseNode{share * 1.5 * std::sin(pi * z),
                    share * (0.8 * std::cos(2 * pi * z) + 0.5),
                    1.2 * share,
                    share * stretch,
                    {9.81, -3}};
  };
}

}  // namespace

TEST_CASE("a cable rests where a chain of an independent engine rests") {
  LooseCable cable = thick_cable(0.012, 0.005);
  cable.play = 0.004;
  const double stretch = GENERATE(0.0, 3e-3);  // compressed; tension of 90 N
  const Comparison slack = compare({cable}, 1, 0, 0.05, swept_bend(stretch))[0];
  CHECK(slack.place < 0.1 * slack.offset);
  CHECK(slack.curvature < 0.04 * slack.largest_curvature);
  CHECK(std::abs(slack.strain - slack.ode_strain) < 2e-5);  // 2 % of the bend at 12 mm would be 3e-4
  // Torsion of the cable itself, here as stiff as a solid round bar, is neglected by the reduced model. 0.48 N m at 1.5 1/m
  // cause a lateral force of a third of its weight of 1.9 N/m. It moves the cable by this share of its play, and its effect
  // on the strain is small.
  const Comparison twisted = compare({cable}, 1, 0, 0.8, swept_bend(stretch))[0];
  CHECK(twisted.place < 0.72 / 1.9 * twisted.offset);
  CHECK(std::abs(twisted.strain - twisted.ode_strain) < 2e-5);
}

TEST_CASE("two cables pressed into the same corner of a hose rest where chains of an independent engine rest") {
  // The inside of the bend pulls both cables to the wall, and the round wall pushes them against each other. In space they
  // touch in the plane between them, 0.4 mm from each. The reduced model stops each after this distance along its ring.
  const double ring = 0.01845, inner = 0.0255, core = 0.013, room = 0.0004;
  const double angle = std::asin((0.0053 + room) / ring);
  std::vector<LooseCable> cables{thick_cable(ring * std::cos(angle), -ring * std::sin(angle)),
                                 thick_cable(ring * std::cos(angle), ring * std::sin(angle))};
  for (LooseCable& cable : cables) cable.axial_stiffness = 3e4;
  fit_in_hose(cables, {inner, core});
  const auto all = compare(cables, inner, core, 0.3, [&](double, double share) {
    return HoseNode{.curvature2 = 0.5 * share, .elongation = share * (0.5 * ring + 1.5e-3)};
  });
  for (const Comparison& c : all) {
    // Along its ring a place turns with the angle. While the cable moves 1.75 mm outward to the wall, this shifts it by
    // sin(angle) times that.
    CHECK(c.place < 1.2 * 0.00175 * std::sin(angle));
    CHECK(c.curvature < 0.03 * c.largest_curvature);
    CHECK(c.strain ==
          Approx(c.ode_strain).epsilon(0.05));  // an error of 0.16 mm in position at 0.5 1/m: 7e-5 of 1.2e-3
  }
}
