// Meshes: nearest points against brute force, and hoses on meshes against hoses on the same shapes.
#include "sim/contact/mesh.h"

#include <random>

#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

constexpr double deepest = 1e-3;  // [m] at steps of 5 ms: less than the wall of a real hose yields

// The twelve triangles of a box centred on `frame`.
std::vector<Triangle> box_triangles(const Frame& frame, const Vector3& sides) {
  const auto corner = [&](int k) {
    const Vector3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    return frame.point(0.5 * sign.cwiseProduct(sides));
  };
  constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return triangles;
}

// A cylinder along y with n faces. The mean distance of the faces from the axis is `radius`.
std::vector<Triangle> cylinder(double radius, double half, int n) {
  std::vector<Triangle> triangles;
  const double corner = radius / std::sqrt(std::cos(pi / n));
  const auto at = [&](int k, double y) {
    const double angle = 2 * pi * k / n;
    return Vector3(corner * std::cos(angle), y, corner * std::sin(angle));
  };
  for (int k = 0; k < n; ++k) {
    triangles.push_back({at(k, -half), at(k, half), at(k + 1, half)});
    triangles.push_back({at(k, -half), at(k + 1, half), at(k + 1, -half)});
  }
  return triangles;
}

// A straight hose falls onto the shape that `add` adds, from just above its top, and comes to rest.
struct Rest {
  RodState state;
  double depth = 0, sliding = 0, carried = 0;
};

template <class Add>
Rest draped(const Add& add) {
  RodProperties p = hose(40);
  p.tool_end = End::free;
  const Rod rod(p);
  const Frame place{{0.6, 0, 0.96}, Quaternion::Identity()};
  World world(rod, {}, rod.straight(planar_frame(0, 1, 0)), std::span(&place, 1));
  add(world);
  REQUIRE(settle(world, std::span(&place, 1), 20000, 1e-6).status == EquilibriumStatus::converged);
  Rest rest;
  for (int k = 0; k < 100; ++k)
    rest.depth = std::max(rest.depth, world.advance(world.state().clamps, std::span(&place, 1)).max_depth);
  for (const Contact& c : world.contacts()) {
    rest.carried += c.normal_force * c.normal.z() + c.friction_force.z();
    if (c.normal_force > 1e-6) rest.sliding = std::max(rest.sliding, c.sliding_speed);
  }
  rest.state = world.state();
  return rest;
}

double furthest(const RodState& a, const RodState& b) {
  double distance = 0;
  for (size_t i = 0; i < a.position.size(); ++i) distance = std::max(distance, (a.position[i] - b.position[i]).norm());
  return distance;
}

}  // namespace

TEST_CASE("nearest points of an axis and a triangle are those of a search over both") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return Vector3(number(random), number(random), number(random)); };
  constexpr int grid = 40;
  int crossing = 0;
  for (int k = 0; k < 150; ++k) {
    const Triangle t{point(), point(), point()};
    const Vector3 from = point(), to = point();
    const NearestToTriangle found = nearest_points(t, from, to);
    double best = 1e9;
    for (int i = 0; i <= grid; ++i)
      for (int j = 0; i + j <= grid; ++j)
        for (int m = 0; m <= grid; ++m) {
          const double u = double(i) / grid, v = double(j) / grid, w = double(m) / grid;
          best = std::min(best, (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - from - w * (to - from)).norm());
        }
    crossing += found.distance == 0;
    CHECK(found.distance <= best + 1e-12);
    // The nearest grid point is within one cell of the best point on the triangle, and within half a cell on the axis.
    CHECK(found.distance >= best - ((t[1] - t[0]).norm() + (t[2] - t[0]).norm() + (to - from).norm() / 2) / grid);
    CHECK((found.on_axis - found.on_triangle).norm() == Approx(found.distance).margin(1e-12));
  }
  CHECK(crossing > 5);
}

TEST_CASE("an axis above a plate of many triangles meets it straight below and nowhere else") {
  std::vector<Triangle> plate;
  for (int i = -10; i < 10; ++i)
    for (int j = -10; j < 10; ++j) {
      const Vector3 a(0.01 * i, 0.01 * j, 0), b = a + Vector3(0.01, 0, 0), c = a + Vector3(0.01, 0.01, 0),
                                              d = a + Vector3(0, 0.01, 0);
      plate.push_back({a, b, c});
      plate.push_back({a, c, d});
    }
  const Mesh mesh(plate);
  const auto touching = mesh.near({-0.0213, 0.003, 0.03}, {0.0277, 0.011, 0.03}, 0.06);
  CHECK(touching.size() >= 2);  // both ends, at least
  for (const Mesh::MeshContact& at : touching) {
    CHECK((at.normal - Vector3::UnitZ()).norm() < 1e-9);
    CHECK(at.distance == Approx(0.03));
  }
  // In the groove between two plates both sides carry the hose.
  std::vector<Triangle> groove = box_triangles({{0.2, 0, 0}, Quaternion::Identity()}, {0.2, 1, 1});
  for (const Triangle& t : box_triangles({{0, 0, -0.2}, Quaternion::Identity()}, {1, 1, 0.2})) groove.push_back(t);
  int down = 0, side = 0;
  for (const Mesh::MeshContact& at : Mesh(groove).near({0.07, -0.02, -0.071}, {0.07, 0.02, -0.071}, 0.04)) {
    down += at.normal.z() > 0.999;
    side += at.normal.x() < -0.999;
  }
  CHECK(down == 2);
  CHECK(side == 2);
}

TEST_CASE("the tree of boxes finds what all triangles together give") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Triangle> triangles;
  for (int k = 0; k < 300; ++k) {
    const Vector3 at(number(random), number(random), number(random));
    Triangle t;
    for (Vector3& corner : t) corner = at + 0.1 * Vector3(number(random), number(random), number(random));
    triangles.push_back(t);
  }
  const Mesh mesh(triangles);
  for (int k = 0; k < 100; ++k) {
    const Vector3 from(number(random), number(random), number(random)), to = from + Vector3(0.05, 0.02, 0.01);
    double least = 1e9;
    for (const Triangle& t : triangles) least = std::min(least, nearest_points(t, from, to).distance);
    const auto touching = mesh.near(from, to, 0.2);
    REQUIRE(touching.empty() == (least > 0.2));
    if (!touching.empty()) CHECK(touching.front().distance == Approx(least).margin(1e-12));
  }
}

TEST_CASE("a hose lies on a meshed cylinder as on the capsule") {
  const Rest round = draped([](World& world) { world.add(0, CapsuleShape{{0, -0.5, -0.05}, {0, 0.5, -0.05}, 0.05}); });
  const Rest meshed = draped([](World& world) {
    world.add(0, std::make_shared<const Mesh>(cylinder(0.05, 0.5, 64)), {{0, 0, -0.05}, Quaternion::Identity()});
  });
  CHECK(meshed.depth < deepest);
  CHECK(round.carried > 10);
  // 64 faces differ from the circle by 0.05 (pi/64)^2/2 = 6e-5 m. Friction keeps each hose where it first came to rest.
  CHECK(furthest(round.state, meshed.state) < 2e-3);
  CHECK(meshed.carried == Approx(round.carried).epsilon(5e-3));
}

TEST_CASE("a hose drapes over the edges of a box, by itself and as twelve triangles") {
  const Vector3 sides(0.3, 0.5, 0.2);
  const Frame top{{0, 0, -0.1}, Quaternion::Identity()};
  const Rest box = draped([&](World& world) { world.add(0, BoxShape{top, sides}); });
  const Rest meshed =
      draped([&](World& world) { world.add(0, std::make_shared<const Mesh>(box_triangles(top, sides))); });
  for (const Rest& rest : {box, meshed}) {
    CHECK(rest.depth < deepest);
    CHECK(rest.sliding < 1e-4);
    CHECK(rest.carried > 10);
  }
  CHECK(furthest(box.state, meshed.state) < 5e-3);
}

TEST_CASE("a hose through a surface lies in it with all its thickness") {
  RodProperties p = hose(40);
  p.tool_end = End::free;
  const Rod rod(p);
  const Frame place{{0.6, 0, 1}, Quaternion::Identity()};
  World world(rod, {}, rod.straight(planar_frame(0, 1, 0)), std::span(&place, 1));
  const Triangle across{Vector3(0.003, -1, -1), Vector3(0.003, 1, -1), Vector3(0.003, 0, 1)};
  world.add(0, std::make_shared<const Mesh>(std::vector{across}));
  CHECK(world.advance(world.state().clamps, std::span(&place, 1)).max_depth == Approx(p.diameter));
}
