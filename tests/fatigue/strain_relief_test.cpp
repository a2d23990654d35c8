#include "fatigue/strain_relief.h"

#include "tests/catch.h"

namespace dresslife::fatigue {

TEST_CASE("strain relief: the standard's pull by diameter, each step with its upper end") {
  CHECK(held_by_strain_relief(4e-3) == 5);
  CHECK(held_by_strain_relief(4.1e-3) == 30);
  CHECK(held_by_strain_relief(2 * 5.5e-3) == 42);
  CHECK(held_by_strain_relief(11.1e-3) == 55);
  CHECK(held_by_strain_relief(20e-3) == 70);
  CHECK(held_by_strain_relief(31e-3) == 80);
  CHECK(held_by_strain_relief(43e-3) == 90);
  CHECK(held_by_strain_relief(55e-3) == 100);
  CHECK(held_by_strain_relief(60e-3) == 115);
}

}  // namespace dresslife::fatigue
