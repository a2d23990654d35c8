#include "pipeline/job/beyond_limit.h"

#include "pipeline/base/statistics.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("the share beyond a limit is that of the normal distribution beyond the crossings of straight lines") {
  constexpr double rounding = 1e-12;
  CHECK(share_beyond({{0, 0.5}, {1, 1.5}}, 0, 1) == Approx(normal_share(-0.5)).margin(rounding));
  CHECK(share_beyond({{1, 1.5}, {0, 0.5}}, 0, 2) == Approx(normal_share(-0.25)).margin(rounding));
  CHECK(share_beyond({{0, 0.5}, {-1, 1.5}}, 0.3, 1) == Approx(normal_share(-0.8)).margin(rounding));
  // both sides, and a node that exceeds the limit between two that do not
  CHECK(share_beyond({{-1, 2}, {0, 0}, {1, 2}}, 0, 1) == Approx(2 * normal_share(-0.5)).margin(rounding));
  CHECK(share_beyond({{-1, 0}, {0, 2}, {1, 0}}, 0, 1) == Approx(1 - 2 * normal_share(-0.5)).margin(rounding));
  // beyond the outermost node the slope remains, so that the load can fall below the limit again
  CHECK(share_beyond({{0, 0}, {1, 2}, {2, 1.5}}, 0, 1) == Approx(normal_share(3) - normal_share(0.5)).margin(rounding));
  CHECK(share_beyond({{0, 2}, {1, 2}}, 0, 1) == Approx(1).margin(rounding));
  CHECK(share_beyond({{0, 1}, {1, 1}}, 0, 1) == 0);
}

TEST_CASE("values of uncertain parameters are named with factor, meaning, key and the job's own value") {
  const auto& friction = uncertain_parameters()[index_of(Uncertain::friction_hose)];
  CHECK(value_words(friction, 1.5, 1) ==
        "2.8 times the friction of the cables on their hose (strain.hose_friction_factor: 2.83)");
  CHECK(value_words(friction, -1, 3) ==
        "0.5 times the friction of the cables on their hose (strain.hose_friction_factor: 1.5)");
  CHECK(percent_words(0.184) == "18 %");
  Uncertainty known;
  CHECK(
      measurement_words(friction, known) ==
      "; or uncertainty.friction_hose: 1.22, if this measurement confirms the job's value: One cable pulled through its hose with a spring "
      "scale (one hour)");
  known.spread[index_of(Uncertain::friction_hose)] = 1.22;  // as proposed
  CHECK(measurement_words(friction, known).empty());
}
