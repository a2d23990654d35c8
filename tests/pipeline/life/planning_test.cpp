#include "pipeline/life/planning.h"

#include "tests/catch.h"

namespace dresslife::pipeline {

TEST_CASE("scatter: wires that make up a share") {
  CHECK(wires_of_share(0, 92) == 1);
  CHECK(wires_of_share(10, 92) == 10);  // 9 are less than 10 %
  CHECK(wires_of_share(10, 70) == 7);   // not 8 because of rounding
  CHECK(wires_of_share(100, 92) == 92);
}

TEST_CASE("months of operation") {
  CHECK(months(80 * 52.1775, 80) == Approx(12));  // one Gregorian year of 80-hour weeks
}

}  // namespace dresslife::pipeline
