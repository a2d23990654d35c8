// Guide rings: the hose slides, rotates and tilts in them.
#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

constexpr double hose_radius = 0.01, clear_radius = 0.015;  // [m]
constexpr double unit_force = 100;                          // [N]

RodProperties thin_hose(int segments, double length, double damping_time = 0.01) {
  RodProperties p;
  p.segments = segments;
  p.length = length;
  p.mass_per_length = 0.5;
  p.diameter = 2 * hose_radius;
  p.bending_stiffness = 1;
  p.torsional_stiffness = 0.8;
  p.axial_stiffness = 1e6;
  p.damping_time = damping_time;
  p.gravity.setZero();
  return p;
}

struct Pulled {
  double ratio = 0, ripple = 0, depth = 0, slid = 0;
  double bend = 0;  // between the tensions at both ends [rad]
};

/// Bends a hose by `bend` [rad] in a ring at the origin and draws it through by 0.5 m. A sliding clamp pulls one end with
/// constant force. Returns the tension at the other end: mean, and ripple = (largest - smallest) / mean.
Pulled draw_through(double friction, double bend, int segments, double speed, double damping_time) {
  const double h = 0.002;
  SlidingClamp unit;
  unit.force = unit_force, unit.stroke = 0.7, unit.mass = 0.5, unit.damping = 20;
  RodProperties p = thin_hose(segments, 2, damping_time);
  p.slider = unit;
  const Rod rod(p);
  // The hose enters and leaves at half the bend below and above the ring's axis, x. Its ends are 1.2 m and 0.8 m away.
  const double half = bend / 2;
  const Vector3 in(std::cos(half), 0, std::sin(half)), out(std::cos(half), 0, -std::sin(half));
  Frame base = planar_frame(0, 0, half), tool = planar_frame(0, 0, -half);
  const double far = 1.2;
  base.position = -far * in;
  tool.position = (2 - far) * out;
  RodState state = rod.straight(base);
  for (int i = 0; i < segments; ++i) {
    const double s = (i + 0.5) * rod.segment_length() - far;
    state.position[i] = s < 0 ? Vector3(s * in) : Vector3(s * out);
    state.orientation[i] = s < 0 ? base.orientation : tool.orientation;
  }
  state.clamps.tool = tool;
  WorldSettings settings;
  settings.time_step = h;
  World world(rod, settings, state);
  world.add(cell_obstacle, RingShape{{{0, 0, 0}, planar_frame(0, 0, 0).orientation}, clear_radius, 0, friction, 0});
  // First the tool end is pulled taut and the hose settles in the bend. Then it moves by 0.5 m at `speed`.
  Pulled result;
  double low = 1e9, high = 0, sum = 0, bends = 0;
  int count = 0;
  const double settling = 1, taut = 0.05, ramp = 0.4, begin = settling + 0.1 / speed + ramp, end = begin + 0.4 / speed;
  double way_at_begin = 0;
  for (int k = 1; k * h <= end; ++k) {
    const double t = k * h;
    Frame now = tool;
    const double u = std::max(0.0, t - settling) / ramp;  // time / acceleration time
    const double drawn = u < 1 ? u * u * u * u * (2.5 - 3 * u + u * u) : u - 0.5;
    now.position += (taut * smooth(t / settling) + speed * ramp * drawn) * out;
    REQUIRE(world.advance({base, now}).finite);
    for (const Contact& contact : world.contacts())
      result.depth = std::max(result.depth, t > settling ? contact.depth : 0);
    if (t < begin) {
      way_at_begin = world.state().travel[0].way;
      continue;
    }
    const double pull = rod.tensions(world.state()).back();
    low = std::min(low, pull), high = std::max(high, pull), sum += pull, ++count;
    const Vector3 &from = world.state().link_force.front(), &to = world.state().link_force.back();
    bends += std::acos(from.dot(to) / (from.norm() * to.norm()));
  }
  result.ratio = sum / count / (unit_force + 20 * speed);  // relative to the unit's force while it slides
  result.bend = bends / count;
  result.ripple = (high - low) / (sum / count);
  result.slid = world.state().travel[0].way - way_at_begin;
  return result;
}

/// T2/T1 of an elastica of stiffness 1 N m2, bent by `bend` over one point with friction at the surface of the hose (radius
/// R, on the inner side of the bend). On either side T (1 - cos phi) = m^2/(2 EI), with phi the angle from that side's
/// straight part to the contact's tangent and m the moment at the contact:
///   T1 (1 - cos a) = m1^2/2, T2 (1 - cos b) = m2^2/2, m2 = m1 - mu N R, a + b = bend,
///   T2 cos b - T1 cos a = mu N, N = T1 sin a + T2 sin b; together T2 - T1 = mu N (1 - R (m1 + m2)/2).
/// For R = 0 and a = b this is the string's (1 + mu tan(bend/2))/(1 - mu tan(bend/2)); but a < b.
double elastica_ratio(double friction, double bend, double first, double radius) {
  return bisect(1, 10, 60, [&](double ratio) {
    const double second = ratio * first;
    const auto moment = [](double pull, double angle) { return std::sqrt(2 * pull * (1 - std::cos(angle))); };
    const auto normal = [&](double a) { return first * std::sin(a) + second * std::sin(bend - a); };
    const double a = bisect(0, bend, 60, [&](double angle) {
      return moment(first, angle) - friction * normal(angle) * radius > moment(second, bend - angle);
    });
    return second * std::cos(bend - a) - first * std::cos(a) > friction * normal(a);
  });
}

double string_ratio(double friction, double bend) {
  return (1 + friction * std::tan(bend / 2)) / (1 - friction * std::tan(bend / 2));
}

}  // namespace

TEST_CASE("the axis through the segments is smooth and knows its nearest places") {
  const Rod rod(thin_hose(12, 1.2));
  const Frame base = planar_frame(0, 0, 0);
  RodState state = rod.straight(base);
  Vector3 joint = Vector3::Zero();
  for (int i = 0; i < 12; ++i) {  // a helix of sorts
    state.orientation[i] = rotation({0.1 * i, -0.15 * i, 0.2}) * base.orientation;
    const Vector3 t = tangent(state.orientation[i]);
    state.position[i] = joint + 0.05 * t;
    joint += 0.1 * t;
  }
  const SpanAxis axis(state, rod.spans()[0]);
  for (int i = 0; i < 12; ++i) {
    CHECK((axis.at(i).position - state.position[i]).norm() < 1e-14);
    CHECK((axis.at(i).slope.normalized() - tangent(state.orientation[i])).norm() < 1e-12);
  }
  const double small = 1e-6;
  for (double place = axis.first() + 0.01; place < axis.last() - 0.01; place += 0.07) {
    const Vector3 slope = (axis.at(place + small).position - axis.at(place - small).position) / (2 * small);
    CHECK((slope - axis.at(place).slope).norm() < 1e-6);
    const SpanAxis::Point p = axis.at(place);
    const Vector3 beside = p.position + 0.02 * p.slope.unitOrthogonal();
    CHECK(axis.nearest(beside, place + 0.3) == Approx(place).margin(1e-6));
  }
}

TEST_CASE("without friction a ring holds nothing back and no segment catches in it") {
  const double deepest = 1e-3;
  const Pulled coarse = draw_through(0, pi / 3, 40, 0.1, 0.01), fine = draw_through(0, pi / 3, 80, 0.1, 0.01);
  INFO("ratio " << fine.ratio << ", ripple " << coarse.ripple << " and " << fine.ripple << ", depth " << fine.depth);
  // Bending and unbending needs EI tau v times the integral of (dkappa/ds)^2: 0.4 N of 100 N here.
  const double damping_and_ripple = 7e-3;
  CHECK(fine.ratio == Approx(1).epsilon(damping_and_ripple));
  // Error of a chain of l = 0.5 and 0.25 bending lengths sqrt(EI/T) against a smooth hose: proportional to l^2.
  CHECK(coarse.ripple < 0.025);
  CHECK(fine.ripple < 0.012);
  CHECK(fine.depth < deepest);
  CHECK(fine.slid == Approx(0.4).epsilon(0.01));
}

TEST_CASE("with friction a ring takes as much pull as an elastica loses over a point") {
  const double tolerance = 8e-3;  // damping and ripple as without friction; damping is small here
  for (const auto& [bend, friction] : {std::pair{pi / 3, 0.2}, std::pair{pi / 3, 0.4}, std::pair{pi / 4, 0.3}}) {
    const Pulled ring = draw_through(friction, bend, 80, 0.1, 0.002);
    const double expected = elastica_ratio(friction, ring.bend, unit_force, hose_radius);
    INFO("friction " << friction << ": ratio " << ring.ratio << ", elastica " << expected << ", string "
                     << string_ratio(friction, ring.bend) << ", bend " << ring.bend << ", ripple " << ring.ripple);
    CHECK(ring.ratio == Approx(expected).epsilon(tolerance));
    CHECK(ring.ripple < 0.05);  // the hose still vibrates from its start
  }
  // For a small bend the contact's tangent halves it, and the hose behaves like a string.
  const Pulled little = draw_through(0.3, 0.3, 80, 0.1, 0.002);
  INFO("ratio " << little.ratio << ", string " << string_ratio(0.3, little.bend) << ", bend " << little.bend);
  CHECK(little.ratio == Approx(string_ratio(0.3, little.bend)).epsilon(tolerance));
}

TEST_CASE("twist passes a ring without friction") {
  RodProperties p = thin_hose(20, 1);
  const Rod rod(p);
  const Frame base = planar_frame(0, 0, 0);
  const RodState start = rod.straight(base);
  World world(rod, {}, start);
  world.add(cell_obstacle, RingShape{{{0.42, 0, 0.002}, base.orientation}, clear_radius, 0.04, 0, 0});
  for (int k = 1; k <= 2000; ++k) {
    ClampFrames clamps = start.clamps;
    clamps.tool = rolled(clamps.tool, 2 * smooth(k / 400.0));
    REQUIRE(world.advance(clamps).finite);
  }
  for (int j = 0; j <= 20; ++j)
    CHECK(rod.link_state(world.state(), j).turn.z() / rod.bending_length(j) == Approx(2).epsilon(1e-3));
}

TEST_CASE("a ring with a width holds the hose's direction") {
  // Drawn across a tube of 100 mm and released, the hose touches opposite edges.
  RodProperties p = thin_hose(40, 1);
  p.gravity = {0, 0, -9.81};
  p.tool_end = End::free;
  p.damping_time = 0.05;
  const Rod rod(p);
  const Frame base = planar_frame(0, 0, 0);
  const RodState start = rod.straight(base);
  World world(rod, {}, start);
  world.add(cell_obstacle, RingShape{{{0.3, 0, 0}, base.orientation}, 0.0105, 0.1, 0.1, 0});
  for (int k = 1; k <= 3000; ++k) REQUIRE(world.advance(start.clamps).finite);
  std::vector<double> up;
  double weight = 0;
  for (const Contact& contact : world.contacts())
    if (contact.normal_force > 1e-3)
      up.push_back(contact.normal.z()), weight += contact.normal_force * contact.normal.z();
  REQUIRE(up.size() == 2);
  CHECK(up[0] * up[1] < 0);  // the near edge presses it down, the far edge holds it up
  // The base clamp pulls, so the ring carries the hose.
  CHECK(weight - world.state().link_force[0].z() == Approx(0.5 * 9.81).epsilon(0.05));
  CHECK(world.state().position[11].z() == Approx(0).margin(1e-3));
}
