// Bend reliefs against the boundary layer of a pulled rod, and the least help that a neighbour's strain allows.
#include "fatigue/clamps.h"

#include <cmath>

#include "tests/catch.h"

namespace dresslife::fatigue {

TEST_CASE(
    "clamps: a pulled rod's layer, integrated, has its angle, and an even relief the curvature of (F32)") {
  const double layer = std::sqrt(8.0 / 200), angle = 0.3;  // E I 8 N m2, pull 200 N
  for (const double relief : {0.0, 0.05, 0.2}) {
    const double at_clamp = angle / layer / (1 + relief / layer);
    double turned = at_clamp * relief;
    const double step = layer / 1000;  // midpoints: error 1e-7
    for (double s = step / 2; s < 30 * layer; s += step) turned += at_clamp * std::exp(-s / layer) * step;
    CHECK(turned == Approx(angle).epsilon(1e-6));
  }
}

TEST_CASE("clamps: the least help of a relief is that of (F32) at most") {
  const double layer = 0.04, distance = 0.05;
  for (const double beyond : {0.0, 1e-4, 5e-4})
    for (const double relief : {0.01, 0.06, 0.3}) {
      const double of_layer = 1e-3, at_clamp = beyond + of_layer,
                   beside = beyond + of_layer * std::exp(-distance / layer);
      const double exact = beyond + of_layer / (1 + relief / layer);
      const double left = relieved_strain(at_clamp, beside, distance, relief);
      CHECK(left >= Approx(exact));
      CHECK(left <= at_clamp);
      CHECK(left >= beside);  // a relief helps no further than to the neighbour's strain
    }
}

TEST_CASE("clamps: no relief, an endless one, and a strain that does not fall away") {
  CHECK(relieved_strain(2e-3, 1e-3, 0.05, 0) == 2e-3);
  CHECK(relieved_strain(2e-3, 1e-3, 0.05, 1e9) == Approx(1e-3));
  CHECK(relieved_strain(1e-3, 1e-3, 0.05, 0.1) == 1e-3);
  CHECK(relieved_strain(1e-3, 3e-3, 0.05, 0.1) == 1e-3);
  CHECK(relieved_strain(1e-3, 0, 0.05, 0.1) == 0);
  double last = 2e-3;
  for (double relief = 0.005; relief < 0.5; relief *= 1.5) {
    const double left = relieved_strain(2e-3, 1e-3, 0.05, relief);
    CHECK(left <= last);
    last = left;
  }
}

TEST_CASE("clamps: strain reliefs hold by the diameter of the cable") {
  CHECK(strain_relief_force(4e-3) == 5);
  CHECK(strain_relief_force(10.6e-3) == 42);
  CHECK(strain_relief_force(11.1e-3) == 55);
  CHECK(strain_relief_force(0.2) == 115);
}

}  // namespace dresslife::fatigue
