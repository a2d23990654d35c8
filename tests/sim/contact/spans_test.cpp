// A dresspack with a clamp between its ends: each span behaves as a dresspack of its own.
#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

Frame swinging(double x, double t, double phase) {
  const double s = std::sin(3 * t + phase) - std::sin(phase);
  return rolled(planar_frame(x + 0.1 * s, 0.2 * s, 0.4 * s), 0.8 * s);
}

}  // namespace

TEST_CASE("the spans on either side of a clamp move as two dresspacks would") {
  const RodProperties p = hose(20, 1.2), q = hose(13, 0.7);
  const Rod both({p, q}), first(p), second(q);
  const auto base = [](double t) { return swinging(0, t, 0); };
  const auto middle = [](double t) { return swinging(1, t, 1); };
  const auto tool = [](double t) { return swinging(1.6, t, 2); };
  const Equilibrium a = find_equilibrium(first, {base(0), middle(0)}),
                    b = find_equilibrium(second, {middle(0), tool(0)});
  REQUIRE(a.status == EquilibriumStatus::converged);
  REQUIRE(b.status == EquilibriumStatus::converged);
  RodState start = both.straight(base(0));
  std::copy(a.state.position.begin(), a.state.position.end(), start.position.begin());
  std::copy(b.state.position.begin(), b.state.position.end(), start.position.begin() + 20);
  std::copy(a.state.orientation.begin(), a.state.orientation.end(), start.orientation.begin());
  std::copy(b.state.orientation.begin(), b.state.orientation.end(), start.orientation.begin() + 20);
  std::copy(a.state.link_force.begin(), a.state.link_force.end(), start.link_force.begin());
  std::copy(b.state.link_force.begin(), b.state.link_force.end(), start.link_force.begin() + 21);
  start.clamps = {base(0), tool(0), {middle(0), middle(0)}};
  World whole(both, {}, start), one(first, {}, a.state), other(second, {}, b.state);
  for (int k = 1; k <= 400; ++k) {
    const double t = 0.005 * k;
    REQUIRE(whole.advance({base(t), tool(t), {middle(t), middle(t)}}).finite);
    one.advance({base(t), middle(t)});
    other.advance({middle(t), tool(t)});
  }
  const double rounding = 1e-12;  // equal operations; only the order of the bodies in the world differs
  CHECK(furthest(whole.state(), 0, one.state()) < rounding);
  CHECK(furthest(whole.state(), 20, other.state()) < rounding);
  CHECK(both.energy(whole.state()).total() ==
        Approx(first.energy(one.state()).total() + second.energy(other.state()).total()).epsilon(1e-12));
  CHECK(both.link_arc(21) == Approx(1.2));
  CHECK(both.spans()[1].arc(20) == Approx(1.2 + 0.5 * 0.7 / 13));
  CHECK(both.mean_elongation(whole.state()) ==
        std::max(first.mean_elongation(one.state()), second.mean_elongation(other.state())));
}

TEST_CASE("what touches beyond a clamp is pushed as by any other piece of the hose") {
  // The second span returns over the first: both hang side by side between clamps, 30 mm too close.
  const Rod rod({hose(10, 1), hose(10, 1)});
  RodState start = rod.straight(planar_frame(0, 0, 0));
  for (int i = 10; i < 20; ++i) {
    start.position[i] = {0.95 - 0.1 * (i - 10), 0.03, 0};
    start.orientation[i] = planar_frame(0, 0, pi).orientation;
  }
  Frame far = planar_frame(1, 0, pi), back = planar_frame(0, 0, pi);
  far.position.y() = back.position.y() = 0.03;
  start.clamps = {planar_frame(0, 0, 0), back, {planar_frame(1, 0, 0), far}};
  WorldSettings settings;
  settings.self_contact = true;
  World world(rod, settings, start);
  for (int k = 0; k < 400; ++k) REQUIRE(world.advance(start.clamps).finite);
  const double apart = (world.state().position[5] - world.state().position[14]).norm();
  CHECK(apart > 0.059);
  bool pushed = false;
  for (const Contact& contact : world.contacts()) pushed |= contact.segment < 10 && contact.other >= 10;
  CHECK(pushed);
}
