// Abrasion against closed forms: a hose rubbed with constant force, and worn volumes integrated over the shape.
#include "fatigue/wear.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"

namespace dresslife::fatigue {
namespace {

using std::numbers::pi;

constexpr int sectors = 72;
constexpr double rate = 1e-14;  // 1e-5 mm3/(N m)

pipeline::Material polymer() {
  pipeline::Material material;
  material.name = "polymer";
  material.wear = {{pipeline::Counterface::robot, rate, 5, "test"}, {pipeline::Counterface::ring, rate / 2, 3, "test"}};
  return material;
}

WornLayer smooth() { return {0.03, 1e-3, 0, 0}; }
WornLayer corrugated() { return {0.03, 0.8e-3, 1.25e-3, 5e-3}; }

/// Returns work [J] distributed over cells of `cell` [m] from `from` to `to`, in the sectors [first, first + count).
std::vector<RubbedPatch> rubbed(double work, double from, double to, double cell, int first, int count,
                                const std::string& obstacle = "link_4") {
  std::vector<RubbedPatch> patches;
  const int cells = static_cast<int>(std::lround((to - from) / cell));
  for (int k = 0; k < cells; ++k)
    for (int sector = 0; sector < count; ++sector)
      patches.push_back({from + (k + 0.5) * cell, cell, ((first + sector) % sectors + 0.5) * 2 * pi / sectors,
                         2 * pi / sectors, obstacle, work / cells / count, 10.0 + k});
  return patches;
}

}  // namespace

TEST_CASE("wear: every obstacle has the rate of its own surface, and where there is none that of the robot") {
  using pipeline::Counterface;
  pipeline::Material material = polymer();
  material.wear.push_back({Counterface::cell, 3, 1, "test"}),
      material.wear.push_back({Counterface::floor, 4, 1, "test"});
  for (const auto& [obstacle, expected] :
       {std::pair{"link_4", rate}, {"ring 2", rate / 2}, {"cell", 3.0}, {"floor", 4.0}, {"dresspack", rate}})
    CHECK(wear_rate(material, obstacle).rate == expected);
}

TEST_CASE("wear: what a smooth hose loses is a circle's segment, and a strip more where contacts wander") {
  const WornLayer layer = smooth();
  for (const double depth : {1e-5, 1e-4, 1e-3}) {
    const double R = layer.radius, half = std::acos(1 - depth / R);
    const double segment = R * R * (half - std::sin(half) * std::cos(half));
    const double parabola = 0.01;  // error of a parabola instead of a circle: depth / (5 R)
    CHECK(layer.area(depth, 0) == Approx(segment).epsilon(parabola));
    CHECK(layer.area(depth, 0.02) - layer.area(depth, 0) == Approx(0.02 * depth));
  }
}

TEST_CASE("wear: what a crest loses is that of a torus cut by a plane") {
  const WornLayer layer = corrugated();
  const double depth = 1e-4, r = layer.crest, ring = layer.radius - r;
  // Height of the crest's surface over the plane, integrated in both directions.
  double volume = 0;
  const double dx = 2e-6, dy = 2e-5;
  for (double x = -1e-3 + dx / 2; x < 1e-3; x += dx)
    for (double y = -5e-3 + dy / 2; y < 5e-3; y += dy) {
      const double out = std::sqrt(r * r - x * x) + ring;
      volume += std::max(0.0, std::sqrt(out * out - y * y) - (layer.radius - depth)) * dx * dy;
    }
  const double paraboloid = 0.02;  // depth / (4 r)
  CHECK(layer.area(depth, 0) * layer.pitch == Approx(volume).epsilon(paraboloid));
}

TEST_CASE("wear: a hose rubbed over an edge at constant force is worn through when k N s is the volume") {
  const pipeline::Material material = polymer();
  const double force = 20, way = 0.5, footprint = 0.06;  // the diameter
  for (const WornLayer& layer : {smooth(), corrugated()}) {
    const double volume = layer.area(layer.thickness, 0) * footprint;
    const Abrasion one = abrasion({layer, &material}, rubbed(force * way, 0.5, 0.505, 0.005, 3, 1));
    CHECK(one.repeats == Approx(volume / (rate * force * way)));
    CHECK(one.position == Approx(0.5025));
    CHECK(one.obstacle == "link_4");
    CHECK(one.time == 10);
    // Sliding over a length greater than the footprint wears by the force per length.
    const Abrasion line = abrasion({layer, &material}, rubbed(force * way, 0.5, 0.74, 0.005, 71, 1));
    CHECK(line.repeats == Approx(4 * one.repeats));
    const Abrasion ring = abrasion({layer, &material}, rubbed(force * way, 0.5, 0.505, 0.005, 3, 1, "ring 1"));
    CHECK(ring.repeats == Approx(one.repeats / 4 * 2));  // a quarter of the footprint, half the rate
  }
}

TEST_CASE("wear: the jacket of a cable drawn over an arc is worn through when k F s is its volume") {
  pipeline::Component cable;
  cable.name = "cable", cable.radius = 5e-3, cable.jacket = pipeline::Sleeve{1e-3, "polymer", {}};
  pipeline::Dresspack dresspack;
  CHECK_FALSE(jacket_of(dresspack, cable));  // no such material
  dresspack.materials = {polymer()};
  dresspack.materials[0].wear.push_back({pipeline::Counterface::hose, 2 * rate, 6, "test"});
  const std::optional<WornMaterial> jacket = jacket_of(dresspack, cable);
  REQUIRE(jacket);
  // F = T kappa per length, for a cable drawn by s over an arc of half a metre.
  constexpr double tension = 20, curvature = 2, way = 0.01, arc = 0.5;  // longer than the footprint
  const Abrasion worn = abrasion(*jacket, rubbed(tension * curvature * way * arc, 0.5, 0.5 + arc, 5e-3, 0, 1, "hose"));
  const double area = 4.0 / 3 * 1e-3 * std::sqrt(2 * 5e-3 * 1e-3);  // a circle's segment as a parabola
  CHECK(worn.repeats == Approx(area / (2 * rate * tension * curvature * way)));
  CHECK(worn.obstacle == "hose");
  cable.jacket.reset();
  CHECK_FALSE(jacket_of(dresspack, cable));
}

TEST_CASE("wear: contacts that wander around the hose wear a strip, over the zero of the angle, too") {
  const pipeline::Material material = polymer();
  const WornLayer layer = smooth();
  const auto repeats = [&](int count) {
    return abrasion({layer, &material}, rubbed(10, 0.5, 0.56, 0.005, 70, count)).repeats;
  };
  const double width = layer.radius * 2 * pi / sectors;
  for (const int count : {1, 2, 6, 30})
    CHECK(repeats(count) == Approx(layer.area(layer.thickness, (count - 1) * width) * 0.06 / (rate * 10)));
  // A little work elsewhere must not hide the place with the most work.
  auto patches = rubbed(10, 0.5, 0.56, 0.005, 70, 1);
  for (const RubbedPatch& patch : rubbed(0.1, 0.5, 0.56, 0.005, 20, 20)) patches.push_back(patch);
  CHECK(abrasion({layer, &material}, patches).repeats == Approx(repeats(1)));
}

TEST_CASE("wear: cells of other lengths give the same life, and several obstacles wear one place together") {
  const pipeline::Material material = polymer();
  const WornLayer layer = corrugated();
  const double coarse = abrasion({layer, &material}, rubbed(10, 0.48, 0.6, 0.006, 3, 2)).repeats;
  CHECK(abrasion({layer, &material}, rubbed(10, 0.48, 0.6, 0.003, 3, 2)).repeats == Approx(coarse));
  auto mixed = rubbed(5, 0.48, 0.54, 0.006, 3, 2);
  for (const RubbedPatch& patch : rubbed(5, 0.54, 0.6, 0.005, 3, 2)) mixed.push_back(patch);
  CHECK(abrasion({layer, &material}, mixed).repeats == Approx(coarse));
  auto both = rubbed(10, 0.48, 0.6, 0.006, 3, 2);
  for (const RubbedPatch& patch : rubbed(20, 0.48, 0.6, 0.006, 3, 2, "link_5")) both.push_back(patch);
  const Abrasion together = abrasion({layer, &material}, both);
  CHECK(together.repeats == Approx(coarse / 3));
  CHECK(together.obstacle == "link_5");
}

TEST_CASE("wear: the spread of a life is that of the rate and the thickness, nothing that rubs wears nothing") {
  const pipeline::Material material = polymer();
  const Abrasion one = abrasion({smooth(), &material}, rubbed(10, 0.5, 0.505, 0.005, 3, 1));
  // The area of a line contact grows with the depth to the power 3/2.
  CHECK(one.log10_spread == Approx(std::hypot(std::log10(5.0), 1.5 * thickness_spread)));
  const Abrasion none = abrasion({smooth(), &material}, {});
  CHECK(std::isinf(none.repeats));
  CHECK(none.obstacle.empty());
  const Abrasion still = abrasion({smooth(), &material}, rubbed(0, 0.5, 0.505, 0.005, 3, 1));  // no force or no sliding
  CHECK(std::isinf(still.repeats));
  CHECK(still.obstacle.empty());
}

TEST_CASE("wear: a sleeve wears before the hose, a hose without thickness or rates is not evaluated") {
  pipeline::Dresspack dresspack;
  dresspack.diameter = 0.06;
  CHECK_FALSE(worn_of(dresspack));
  dresspack.hose_corrugation = pipeline::Corrugation{5e-3, 4.5e-3, 0.8e-3, {}};
  dresspack.hose_material = "polymer";
  dresspack.materials = {polymer()};
  REQUIRE(worn_of(dresspack));
  CHECK(worn_of(dresspack)->layer.crest == 1.25e-3);
  CHECK(wear_rate(*worn_of(dresspack)->material, "ring 2").factor == 3);
  CHECK(wear_rate(*worn_of(dresspack)->material, "floor").factor == 5);  // not listed: the robot's rate
  dresspack.sleeve = pipeline::Sleeve{2e-3, "polymer", {}};
  CHECK(worn_of(dresspack)->layer.crest == 0);
  CHECK(worn_of(dresspack)->layer.thickness == 2e-3);
  dresspack.materials[0].wear.clear();
  CHECK_FALSE(worn_of(dresspack));
}

TEST_CASE("wear: the jacket of a cable without a hose wears, unless a sleeve covers it") {
  pipeline::Dresspack dresspack;
  dresspack.diameter = 0.012;
  dresspack.materials = {polymer()};
  pipeline::Component cable;
  cable.radius = 0.006;
  cable.jacket = pipeline::Sleeve{1.1e-3, "polymer", {}};
  dresspack.components = {cable};
  REQUIRE(worn_of(dresspack));
  CHECK(worn_of(dresspack)->layer.thickness == 1.1e-3);
  dresspack.sleeve = pipeline::Sleeve{2e-3, "polymer", {}};
  CHECK(worn_of(dresspack)->layer.thickness == 2e-3);
  dresspack.sleeve.reset();
  dresspack.inner_diameter = 0.012;  // now it lies in a hose
  CHECK_FALSE(worn_of(dresspack));
}

}  // namespace dresslife::fatigue
