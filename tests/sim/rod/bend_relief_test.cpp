// A hose that is stiffer beside its ends (S24), against closed forms of straight beams.
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

constexpr double relief = 8;  // additional E I, relative to the hose's own, 1

RodProperties relieved(int n, double length, bool at_tool = false) {
  RodProperties p = unit_rod(n);
  p.stiff_ends[at_tool] = {length, relief};
  return p;
}

}  // namespace

TEST_CASE(
    "bend relief: the tip of a cantilever with a step of stiffness goes down as beam theory says, with second order") {
  constexpr double load = 1e-3;  // a deflection of 3e-4 L: the elastica differs by its square
  const auto error = [&](int n, double length) {
    RodProperties p = relieved(n, length);
    p.tool_end = End::free;
    const Rod rod(p);
    const double tip = rod.tip(tip_loaded(rod, planar_frame(0, 0, 0), {0, 0, load})).z();
    const double bare = std::pow(1 - length, 3) / 3, stiff = (1.0 / 3 - bare) / (1 + relief);
    return std::abs(tip / load - bare - stiff);
  };
  // A link in which the compliance steps by d has its compliance at its middle instead of at the step: an error of at most
  // d l^2/8 times the change of the squared arm, 2 (1 - r).
  for (const double length : {0.05, 0.21, 0.25, 0.5})
    CHECK(error(40, length) < relief / (1 + relief) * (1 - length) / 4 / (40 * 40));
  CHECK(observed_order(error(40, 0.25), error(80, 0.25)) > least_order);  // the step is always in the middle of a link
}

TEST_CASE("bend relief: the bend of a pulled hose at a slanted clamp is that of two boundary layers sqrt(EI/T)") {
  // EI_i phi'' = T phi, with phi the angle to the tension; phi and EI phi' are continuous at the relief's end, phi decays beyond.
  constexpr double pull = 400, slant = 1e-3, length = 0.15;
  const double stiff = 1 + relief, deep = std::sqrt(stiff / pull), thin = std::sqrt(1 / pull);
  const double k1 = std::sqrt(stiff * pull), k2 = std::sqrt(pull), sh = std::sinh(length / deep),
               ch = std::cosh(length / deep);
  const double c = -slant * (k1 * sh + k2 * ch) / (k1 * ch + k2 * sh);
  const auto exact = [&](double s) {
    return s < length ? -(slant * std::sinh(s / deep) + c * std::cosh(s / deep)) / deep
                      : (slant * ch + c * sh) * std::exp(-(s - length) / thin) / thin;
  };
  // At this lateral distance of the clamps there is no lateral force.
  const double across = deep * (slant * sh + c * (ch - 1)) + thin * (slant * ch + c * sh);
  const double without = slant / thin;
  for (const bool at_tool : {false, true}) {
    CAPTURE(at_tool);
    const int n = 100;
    const Rod rod(relieved(n, length, at_tool));
    const ClampFrames clamps{planar_frame(0, 0, at_tool ? 0 : slant),
                             planar_frame(1 + pull / rod.properties().axial_stiffness, across, at_tool ? slant : 0)};
    const Equilibrium e = find_equilibrium(rod, clamps);
    REQUIRE(e.status == EquilibriumStatus::converged);
    const auto bend = [&](int from_clamp) { return curvature(rod, e.state, at_tool ? n - from_clamp : from_clamp); };
    // Second order: (l/thin)^2/12 = 0.3 % of the curvature where it decays with `thin`. The slant turns the chord by 1e-3 of it.
    const double tolerance = 4e-3 * exact(length);
    for (const int j : {0, 2, 5, 10, 14, 16, 20, 30}) {
      CAPTURE(j);
      CHECK(std::abs(bend(j) - exact(j / static_cast<double>(n))) < tolerance);
    }
    CHECK(bend(0) < 0.5 * without);
  }
}

TEST_CASE("bend relief: without length or stiffness the chain has the same bits as without a relief") {
  const Rod bare(unit_rod(17));
  for (const StiffEnd end : {StiffEnd{0, relief}, StiffEnd{0.3, 0}}) {
    RodProperties p = unit_rod(17);
    p.stiff_ends = {end, end};
    const Rod rod(p);
    for (int j = 0; j < rod.links(); ++j) CHECK(rod.turn_stiffness(j) == bare.turn_stiffness(j));
  }
}
