#include "pipeline/cable/bend_limit.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE(
    "a corrugated hose bends as far as the parts in it and its makers allow, anything else as far as its diameter does") {
  Dresspack dresspack;
  dresspack.diameter = 0.06;
  CHECK(least_bend_radius(dresspack) == Approx(0.6));
  Component cable;
  cable.radius = 0.0053;
  cable.helix_radius = 0.01845;
  dresspack.components = {cable};
  CHECK(least_bend_radius(dresspack) == Approx(0.6));  // a cable with its jacket
  dresspack.hose_corrugation = Corrugation{};
  CHECK(least_bend_radius(dresspack) == Approx(0.18));  // three diameters of the hose
  dresspack.diameter = 0.04;
  CHECK(least_bend_radius(dresspack) == Approx(0.106 + 0.01845));  // the part on the inner side of the bend
  dresspack.core_diameter = 0.026;
  CHECK(least_bend_radius(dresspack) == Approx(0.26));
  CHECK_THAT(bend_rule(dresspack), Catch::Contains("ten diameters of its core (26 mm) count"));
  Component tube;  // it takes 24^2 of the 26^2 mm2: the rest is a part of 10 mm at most
  tube.name = "tube", tube.count = 1, tube.radius = 0.012, tube.helix_radius = 0.001;
  dresspack.core_components = {tube};
  CHECK(least_bend_radius(dresspack) == Approx(0.241));
  CHECK_THAT(bend_rule(dresspack),
             Catch::Contains("ten diameters of 'tube' (24 mm) in the hose, 1 mm off its axis, count"));
  dresspack.core_components[0].radius = 0.005;
  CHECK(least_bend_radius(dresspack) == Approx(0.24));
  CHECK_THAT(bend_rule(dresspack),
             Catch::Contains("ten diameters of a core with the area that no core component takes (24 mm) count"));
  dresspack.core_components[0].count = 7;  // more than the area: the other parts decide
  CHECK(least_bend_radius(dresspack) == Approx(0.106 + 0.01845));
  dresspack.components.clear();                         // a hose with a core alone
  CHECK(least_bend_radius(dresspack) == Approx(0.12));  // three diameters of the hose
  dresspack.least_bend_radius = 0.2;
  CHECK(least_bend_radius(dresspack) == 0.2);
}
