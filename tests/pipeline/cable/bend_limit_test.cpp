#include "pipeline/cable/bend_limit.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("a corrugated hose bends as far as the parts in it and its makers allow, anything else as far as its diameter does") {
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
  dresspack.least_bend_radius = 0.2;
  CHECK(least_bend_radius(dresspack) == 0.2);
}
