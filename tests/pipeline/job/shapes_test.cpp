// Distances of points from capsules and boxes.
#include "pipeline/job/shapes.h"

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

TEST_CASE("shapes: the distance of a point is that from the nearest surface, negative inside") {
  const std::vector<Capsule> capsule{{{0, 0, 0}, {1, 0, 0}, 0.1}};
  const std::vector<Box> turned{{{5, 0, 0}, {0, 0, 90 * degree}, {2, 4, 6}}};  // 4 m along x, 2 m along y
  CHECK(distance_from(capsule, {}, {0.5, 0.3, 0}) == Approx(0.2));
  CHECK(distance_from(capsule, {}, {1.3, 0, 0.4}) == Approx(0.4));  // 3, 4, 5: beyond the end of the axis
  CHECK(distance_from(capsule, {}, {0.5, 0, 0}) == Approx(-0.1));
  CHECK(distance_from({}, turned, {5, 2, 0}) == Approx(1));
  CHECK(distance_from({}, turned, {2.9, 0, 0}) == Approx(0.1));
  CHECK(distance_from({}, turned, {10, 5, 0}) == Approx(5));  // 3, 4, 5: from an edge
  CHECK(distance_from({}, turned, {5, 0.7, 0}) == Approx(-0.3));
  CHECK(distance_from(capsule, turned, {1.9, 0, 0}) == Approx(0.8));
  CHECK(distance_from({}, {}, {0, 0, 0}) == HUGE_VAL);
}
