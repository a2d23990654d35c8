// The hose on itself: nearest points against brute force, a hose that piles up, and Newton's third law.
#include "sim/contact/self_contact.h"

#include <random>

#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

constexpr double deepest = 1e-3;  // [m] at steps of 5 ms: less than the wall of a real hose yields

RodProperties soft_hose(int segments) {
  RodProperties p;
  p.segments = segments;
  p.length = 1.6;
  p.mass_per_length = 1;
  p.diameter = 0.03;
  p.bending_stiffness = 0.05;
  p.torsional_stiffness = 0.04;
  p.axial_stiffness = 1e4;
  p.damping_time = 0.02;
  p.tool_end = End::free;
  return p;
}

}  // namespace

TEST_CASE("nearest points of two segments are those of a search over both") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return Vector3(number(random), number(random), number(random)); };
  constexpr int grid = 60;
  for (int k = 0; k < 200; ++k) {
    const Vector3 a0 = point(), a1 = point(), b0 = point();
    // Every fourth pair is parallel.
    const Vector3 b1 = k % 4 == 0 ? Vector3(b0 + 0.7 * (a1 - a0)) : point();
    const NearestPoints found = nearest_points(a0, a1, b0, b1);
    const auto distance = [&](double a, double b) { return (a0 + a * (a1 - a0) - b0 - b * (b1 - b0)).norm(); };
    double best = 1e9;
    for (int i = 0; i <= grid; ++i)
      for (int j = 0; j <= grid; ++j) best = std::min(best, distance(double(i) / grid, double(j) / grid));
    CHECK(distance(found.a, found.b) <= best + 1e-12);
    // The nearest grid point is within half a cell of the best point on each segment.
    CHECK(distance(found.a, found.b) >= best - ((a1 - a0).norm() + (b1 - b0).norm()) / (2 * grid));
  }
}

TEST_CASE("no pair of segments is nearer than the search says, which is no less than the nearest pair or a segment") {
  const Rod rod(soft_hose(64));
  const double l = rod.segment_length(), d = rod.properties().diameter, own = pi / 2 * d;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  int far = 0, near = 0;
  for (int k = 0; k < 300; ++k) {
    RodState state = rod.straight(planar_frame(0, 0, 0));
    const Vector3 rate(12 * number(random), 12 * number(random),
                       6 * number(random));  // [1/m]: part of a helix
    for (int i = 1; i < rod.segments(); ++i) {
      state.orientation[i] = state.orientation[i - 1] * rotation(l * rate);
      state.position[i] =
          state.position[i - 1] + l / 2 * (tangent(state.orientation[i - 1]) + tangent(state.orientation[i]));
    }
    std::vector<Contact> contacts;
    const double reach = 0.01, clear = find_self_contacts(rod, state, reach, contacts);
    double nearest = 1e9, nearest_with_neighbours = 1e9;
    for (int i = 0; i < rod.segments(); ++i)
      for (int j = i + 1; j < rod.segments(); ++j) {
        const double gap = (state.position[j] - state.position[i]).norm() - l - d, between = (j - i - 1) * l;
        if (between >= own + l) nearest = std::min(nearest, gap);
        if (between >= own - l) nearest_with_neighbours = std::min(nearest_with_neighbours, gap);
      }
    const double rounding = 1e-12;  // [m] of a chain of 1.6 m
    CHECK(clear <= nearest + rounding);
    CHECK(clear >= std::min(nearest_with_neighbours, reach + l) - rounding);
    if (clear > reach) CHECK(contacts.empty());
    ++(clear > reach ? far : near);
  }
  CHECK(far > 30);
  CHECK(near > 30);
}

TEST_CASE("a slack hose that is wound up coils onto itself and stays outside itself") {
  RodProperties p = soft_hose(64);
  p.gravity.setZero();
  p.tool_end = End::clamped;
  const Rod rod(p);
  const Frame base = planar_frame(0, 0, 0);
  WorldSettings settings;
  settings.self_contact = true;
  World world(rod, settings, rod.straight(base));
  const Frame tool = world.state().clamps.tool;
  double depth = 0, hardest = 0;
  int most = 0;
  // The tool clamp makes six turns. Then the clamps approach by 0.6 m: the twisted hose forms a loop that winds up.
  for (int k = 1; k <= 1600; ++k) {
    const double t = k * settings.time_step;
    ClampFrames clamps{base, rolled(tool, 12 * pi * smooth(t / 6))};
    clamps.tool.position.x() -= 0.6 * smooth((t - 1) / 6);
    const StepReport report = world.advance(clamps);
    REQUIRE(report.finite);
    depth = std::max(depth, report.max_depth);
    int touching = 0;
    for (const Contact& contact : world.contacts()) {
      touching += contact.normal_force > 0;
      hardest = std::max(hardest, contact.normal_force);
    }
    most = std::max(most, touching);
  }
  INFO("deepest " << depth << " m, most contacts " << most << ", hardest " << hardest << " N");
  CHECK(depth < deepest);
  CHECK(most >= 5);
  CHECK(hardest > 1);
}

TEST_CASE("what one piece of the hose gains by touching another the other loses") {
  // A loop is pulled tight without gravity: all momentum comes from the clamps.
  RodProperties p = soft_hose(40);
  p.gravity.setZero();
  p.tool_end = End::clamped;
  const Rod rod(p);
  const ClampFrames clamps{planar_frame(0, 0, 0), planar_frame(1.2, 0.0, 0)};
  const Equilibrium start = find_equilibrium(rod, clamps);
  REQUIRE(start.status == EquilibriumStatus::converged);
  WorldSettings settings;
  settings.self_contact = true;
  World world(rod, settings, start.state);
  double worst = 0, hardest = 0, depth = 0;
  for (int k = 1; k <= 500; ++k) {
    // The tool clamp passes the base clamp and pulls the loop tight around itself, at a distance of three diameters. Closer, the
    // clamps would crush the hose between them.
    const double u = smooth(k * settings.time_step / 2.5);
    ClampFrames now = clamps;
    now.tool.position = {1.2 - 2.4 * u, 3 * p.diameter * smooth(4 * u), 0};
    Vector3 before = Vector3::Zero(), after = Vector3::Zero();
    for (const Vector3& v : world.state().velocity) before += rod.segment_mass() * v;
    const StepReport report = world.advance(now);
    REQUIRE(report.finite);
    depth = std::max(depth, report.max_depth);
    for (const Vector3& v : world.state().velocity) after += rod.segment_mass() * v;
    const Vector3 pull = world.state().link_force.back() - world.state().link_force.front();
    worst = std::max(worst, (after - before - settings.time_step * pull).norm());
    for (const Contact& contact : world.contacts()) hardest = std::max(hardest, contact.normal_force);
  }
  INFO("unexplained momentum " << worst << " N s, hardest contact " << hardest << " N, deepest " << depth);
  CHECK(hardest > 0.1);
  const double rounding = 1e-11;  // [N s] per step; 1e-16 of the largest contact forces, kN, over many links
  CHECK(worst < rounding);
  CHECK(depth < deepest);
}
