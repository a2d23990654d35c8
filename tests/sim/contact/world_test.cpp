// The world: ODE moves the bodies as the chain's own integrator does, and the result depends only on the input.
#include "sim/contact/world.h"

#include <array>
#include <cstring>
#include <thread>

#include "tests/sim/rod/rod_driven_cable.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

// Runs the driven cable until `until` [s] with a capsule in its path.
RodState run_with_obstacle(double until) {
  const Rod rod(DrivenCable::properties(30));
  const Frame still{{1, 0, -0.3}, Quaternion::Identity()};
  World world(rod, {}, rod.straight(DrivenCable::base()), std::span(&still, 1));
  world.add(0, CapsuleShape{{0, -0.5, 0}, {0, 0.5, 0}, 0.05});
  std::vector<Load> loads;
  for (int k = 0; k * 0.005 < until; ++k) {
    DrivenCable::weigh(rod, k * 0.005, loads);
    world.advance(DrivenCable::clamps((k + 1) * 0.005), std::span(&still, 1), loads);
  }
  return world.state();
}

bool same_bytes(const RodState& a, const RodState& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return same(a.position, b.position) && same(a.orientation, b.orientation) && same(a.velocity, b.velocity) &&
         same(a.angular_velocity, b.angular_velocity) && same(a.link_force, b.link_force);
}

}  // namespace

TEST_CASE("ODE advances the bodies as the chain's own integrator") {
  const Rod rod(DrivenCable::properties(30));
  RodState own = rod.straight(DrivenCable::base());
  World world(rod, {}, own);
  RodSolver solver(rod);
  std::vector<Load> loads;
  double difference = 0;
  for (int k = 0; k < 1000; ++k) {
    DrivenCable::weigh(rod, k * 0.005, loads);
    const ClampFrames clamps = DrivenCable::clamps((k + 1) * 0.005);
    REQUIRE(advance_rod(rod, solver, own, clamps, 0.005, loads));
    REQUIRE(world.advance(clamps, {}, loads).finite);
    for (int i = 0; i < 30; ++i)
      difference = std::max(difference, (own.position[i] - world.state().position[i]).norm());
  }
  const double rounding = 1e-9;  // [m] 1000 steps of 1e-16, amplified by the stiffest mode, k h^2/m = 4e3
  CHECK(difference < rounding);
  CHECK(difference > 0);  // the integrators are different
}

TEST_CASE("a world counts one unit of work for a segment and step, and more where something touches") {
  // The limits of searches and of short runs depend on this number.
  const Rod rod(DrivenCable::properties(30));
  const Frame still{{1, 0, -0.3}, Quaternion::Identity()};
  World world(rod, {}, rod.straight(DrivenCable::base()), std::span(&still, 1));
  world.add(0, CapsuleShape{{0, -0.5, 0}, {0, 0.5, 0}, 0.05});
  std::vector<Load> loads;
  int touching = 0, free = 0;
  for (int k = 0; k < 200; ++k) {
    DrivenCable::weigh(rod, k * 0.005, loads);
    const double before = world.work();
    world.advance(DrivenCable::clamps((k + 1) * 0.005), std::span(&still, 1), loads);
    const double work = world.work() - before;
    CHECK((world.contacts().empty() ? work == 30 : work > 30));
    ++(world.contacts().empty() ? free : touching);
  }
  CHECK(touching > 0);
  CHECK(free > 0);
}

TEST_CASE("two worlds in two threads give the bytes of one alone") {
  const RodState alone = run_with_obstacle(3);
  RodState first, second;
  std::thread one([&] { first = run_with_obstacle(3); });
  std::thread two([&] { second = run_with_obstacle(3); });
  one.join();
  two.join();
  CHECK(same_bytes(alone, first));
  CHECK(same_bytes(alone, second));
}

TEST_CASE("a world restarted from its state goes on as if it had not stopped") {
  const Rod rod(DrivenCable::properties(20));
  World world(rod, {}, rod.straight(DrivenCable::base()));
  for (int k = 1; k <= 400; ++k) world.advance(DrivenCable::clamps(k * 0.005));
  World restarted(rod, {}, world.state());
  for (int k = 401; k <= 800; ++k) {
    world.advance(DrivenCable::clamps(k * 0.005));
    restarted.advance(DrivenCable::clamps(k * 0.005));
  }
  CHECK((world.state().position[10] - restarted.state().position[10]).norm() < 1e-9);  // ODE normalises quaternions
}

TEST_CASE("a world that remembers the distances of obstacles moves as one that computes them at every step") {
  const Rod rod(DrivenCable::properties(30));
  const RodState start = rod.straight(DrivenCable::base());
  // A box and a capsule move toward the cable from 1 m away at up to 2.5 m/s, one after the other, and back.
  const auto links_at = [](double t) {
    const auto dive = [t](double begin) { return std::max(0.0, std::sin(2.5 * (t - begin))); };
    return std::array{Frame{{0.5, 0, -1 + (t > 0.2 ? dive(0.2) : 0)}, Quaternion::Identity()},
                      Frame{{0.7, 1 - (t > 0.8 ? dive(0.8) : 0), 0}, rotation({0, 0, 2 * t})}};
  };
  const auto made = [&] {
    auto world = std::make_unique<World>(rod, WorldSettings{}, start, links_at(0));
    world->add(0, BoxShape{{}, {0.8, 0.8, 0.1}});
    world->add(1, CapsuleShape{{-0.2, 0, 0}, {0.2, 0, 0}, 0.04});
    return world;
  };
  const std::unique_ptr<World> remembers = made(), looks = made();
  double difference = 0;
  int touching = 0, free = 0;
  for (int k = 1; k <= 400; ++k) {
    const double t = k * 0.005;
    const auto links = links_at(t);
    looks->set_state(looks->state());  // discards the saved distances
    const StepReport report = remembers->advance(DrivenCable::clamps(t), links);
    looks->advance(DrivenCable::clamps(t), links);
    ++(report.touching > 0 ? touching : free);
    for (int i = 0; i < 30; ++i)
      difference = std::max(difference, (remembers->state().position[i] - looks->state().position[i]).norm());
  }
  CHECK(touching > 20);
  CHECK(free > 20);
  CHECK(difference < 1e-6);  // [m] ODE normalises quaternions that are set; a missed contact would cause millimetres
}

TEST_CASE("a state that is not finite is reported") {
  const Rod rod(DrivenCable::properties(20));
  RodState state = rod.straight(DrivenCable::base());
  state.velocity[7].x() = std::nan("");
  World world(rod, {}, state);
  CHECK_FALSE(world.advance(DrivenCable::clamps(0.005)).finite);
}
