#include "pipeline/cable/overlap.h"

#include <cmath>
#include <numbers>

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

Dresspack dresspack_of(int count, double radius_mm, double helix_radius_mm, double lay_angle_deg) {
  Component cable, conductor;
  cable.name = "cable";
  cable.radius = 0.02;
  conductor.name = "conductor";
  conductor.count = count;
  conductor.radius = 1e-3 * radius_mm;
  conductor.helix_radius = 1e-3 * helix_radius_mm;
  conductor.lay_angle = lay_angle_deg * degree;
  conductor.where = {"pack.yaml", 7, 3};
  cable.components = {conductor};
  Dresspack dresspack;
  dresspack.components = {cable};
  return dresspack;
}

}  // namespace

TEST_CASE("neighbouring helices are as far apart as points laid on them") {
  // Brute force over both helices. An error of half a step of 2e-4 rad in the nearest points changes the distance by (1e-4)^2.
  for (const double lay_angle : {5.0, 25.0, 45.0, 60.0})
    for (const int count : {2, 3, 7, 31}) {
      const double R = 2.825e-3, rise = R / std::tan(lay_angle * degree), turned = 2 * std::numbers::pi / count;
      double nearest = 1;
      for (double phi = -4; phi < 4; phi += 2e-4)
        nearest = std::min(nearest, std::hypot(R - R * std::cos(phi + turned), R * std::sin(phi + turned), rise * phi));
      CHECK(neighbour_distance(R, lay_angle * degree, count) == Approx(nearest).epsilon(1e-5));
    }
  CHECK(neighbour_distance(1, 0, 6) == Approx(1));
}

TEST_CASE("parts that overlap on their circle are warned of, with what would fit") {
  std::vector<std::string> warnings;
  for (const Warning& warning : overlap_warnings(dresspack_of(7, 1.175, 2.825, 25))) warnings.push_back(warning.line());
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("pack.yaml:7:3: warning: the 7 parts 'conductor' are 2.254 mm apart") &&
                              Catch::Contains("0.096 mm less than their diameter") &&
                              Catch::Contains("Likely cause: ") &&
                              Catch::Contains("or count: 6 or less, or helix_radius_mm: "));
  // The angle of the remedy fits. A tenth of a degree more does not.
  const std::size_t at = warnings[0].find("lay_angle_deg: ") + 15;
  const double most = std::stod(warnings[0].substr(at));
  CHECK(neighbour_distance(2.825, most * degree, 7) >= 2.35);
  CHECK(neighbour_distance(2.825, (most + 0.1) * degree, 7) < 2.35);
  const double wider = std::stod(warnings[0].substr(warnings[0].find("helix_radius_mm: ") + 17));
  CHECK(neighbour_distance(wider, 25 * degree, 7) >= 2.35);
  CHECK(neighbour_distance(wider - 0.002, 25 * degree, 7) < 2.35);
  CHECK(overlap_warnings(dresspack_of(7, 1.175, 2.825, 15)).empty());
  CHECK(overlap_warnings(dresspack_of(6, 1.175, 2.825, 25)).empty());
  // Six around one of equal size touch when straight. A lay of 5 degrees needs 0.4 % more room.
  CHECK(overlap_warnings(dresspack_of(6, 0.075, 0.15, 5)).empty());
  // If they are straight, no lay angle helps, only a smaller number.
  CHECK_THAT(overlap_warnings(dresspack_of(8, 1.175, 2.825, 0)).at(0).words,
             Catch::Contains("Remedy: count: 7 or less, or helix_radius_mm: 3.071 or more"));  // 1.175 / sin(pi/8)
}

TEST_CASE("parts that can only be a mistake are refused") {
  CHECK_THROWS_WITH(overlap_warnings(dresspack_of(40, 1.175, 5.8, 0)),
                    Catch::Contains("pack.yaml:7:3: error: the 40 parts 'conductor' are") &&
                        Catch::Contains("give count: 15 or less"));
  CHECK_NOTHROW(overlap_warnings(dresspack_of(25, 1.175, 5.8, 0)));
}

TEST_CASE("a steep lay angle may be a lay length, and the remedy ends where no length makes it flat") {
  const auto remedy = [](const Dresspack& dresspack) {
    const std::vector<Warning> warnings = overlap_warnings(dresspack);
    REQUIRE(warnings.size() == 1);
    return warnings[0].line();
  };
  // tan = 2 pi 2.825 / 45: 21.5 deg, where seven parts of 2.3 mm fit
  CHECK_THAT(remedy(dresspack_of(7, 1.15, 2.825, 45)),
             Catch::Contains("lay_angle_deg: 21.5 if 45 is the lay length in mm"));
  // 25 mm off the axis a lay of 60 mm is 69 deg.
  const std::string far = remedy(dresspack_of(9, 6, 25, 60));
  CHECK_THAT(
      far, Catch::Contains("lay_angle_deg: the angle of the cable (8 to 25)") && !Catch::Contains("is the lay length"));
}

TEST_CASE("parts of two components that would lie in each other are warned of, those that touch are not") {
  Dresspack dresspack = dresspack_of(1, 1, 0, 0);
  std::vector<Component>& parts = dresspack.components[0].components;
  Component ring = parts[0];
  ring.name = "ring";
  ring.count = 3;
  ring.helix_radius = 2e-3;  // around the middle one, which they touch
  parts.push_back(ring);
  CHECK(overlap_warnings(dresspack).empty());
  parts[1].helix_radius = 1.9e-3;
  REQUIRE(overlap_warnings(dresspack).size() == 1);
  CHECK_THAT(overlap_warnings(dresspack)[0].words, Catch::Contains("'conductor' and 'ring' come as near as 1.9 mm") &&
                                                       Catch::Contains("0.100 mm less than their radii together"));
  // Three more in their gaps fit if they have the same lay, straight or not. With another lay they meet the others.
  parts.erase(parts.begin());
  parts[0].helix_radius = 2e-3;
  parts.push_back(parts[0]);
  parts[1].name = "between";
  parts[1].phase = std::numbers::pi / 3;
  for (const double lay : {0.0, 10.0}) {
    parts[0].lay_angle = parts[1].lay_angle = lay * degree;
    CHECK(nearest_distance(parts[0], parts[1]) == Approx(neighbour_distance(2e-3, lay * degree, 6)));
    CHECK(overlap_warnings(dresspack).empty());
  }
  parts[1].hand = Hand::left;
  CHECK(nearest_distance(parts[0], parts[1]) == 0);
  CHECK(overlap_warnings(dresspack).size() == 1);
  parts[1].hand = Hand::right;
  parts[1].phase = 5 * degree;  // nearly the same place: certainly a mistake
  CHECK_THROWS_WITH(overlap_warnings(dresspack),
                    Catch::Contains("'ring' and 'between' come as near as 0.1718 mm") &&  // 2 mm x 5 deg x cos(10 deg)
                        Catch::Contains("nearer than half of these"));
  CHECK_THROWS(refuse_gross_overlap(dresspack));
  parts[1].phase = std::numbers::pi / 4;  // 45 deg from one and 75 deg from another
  CHECK(nearest_distance(parts[0], parts[1]) == Approx(neighbour_distance(2e-3, 10 * degree, 8)));
  CHECK(overlap_warnings(dresspack).size() == 1);

  // Helices are nearer along the helix than in the cross-section. Eight parts overlap whether they are one component or two.
  for (Component& part : parts)
    part.count = 4, part.radius = 1.5e-3, part.helix_radius = 4e-3, part.lay_angle = 25 * degree;
  CHECK(nearest_distance(parts[0], parts[1]) < 3e-3);
  CHECK(8e-3 * std::sin(22.5 * degree) > 3e-3);
  REQUIRE(overlap_warnings(dresspack).size() >= 1);
  CHECK_THAT(overlap_warnings(dresspack)[0].words, Catch::Contains("'ring' and 'between' come as near as 2.806 mm"));
}

TEST_CASE("a hose that its parts fill by more than 70 % is warned of, with a bore that is wide enough") {
  Component cable;
  cable.name = "cable", cable.count = 4, cable.radius = 5e-3, cable.helix_radius = 7.5e-3;
  Dresspack dresspack;
  dresspack.diameter = 0.03, dresspack.components = {cable};
  CHECK(overlap_warnings(dresspack).empty());  // no hose
  dresspack.inner_diameter = 0.0240;           // 4 x 5^2 of 12^2: 69 %
  CHECK(overlap_warnings(dresspack).empty());
  dresspack.core_diameter = 3e-3;
  const std::vector<Warning> filled = overlap_warnings(dresspack);
  REQUIRE(filled.size() == 1);
  CHECK_THAT(filled[0].words, Catch::Contains("the parts fill 71 % of the bore of 24 mm (limit 70 %") &&
                                  Catch::Contains("inner_diameter_mm: 24.2 or more"));
  dresspack.inner_diameter = 0.0242;
  CHECK(overlap_warnings(dresspack).empty());
  dresspack.core_components = {cable};  // in place of the core's circle
  CHECK(overlap_warnings(dresspack).size() == 1);
}
