#include "pipeline/study/run_share.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

double seconds_left(double seconds, double share) { return seconds / share * (1 - share); }

}  // namespace

TEST_CASE("run share: a strain stage that many fatigue stages share does not count for each of them") {
  // One job after the other: simulation 8 s, strain 80 s, then 100 fatigue stages of 1 s each.
  RunShare run({1, 1, 100});
  run.ended(0, 8);
  // No fatigue stage has ended. The usual ratio to the other stages is within a factor of two of this job's.
  CHECK(seconds_left(88, run.ended(1, 88)) == Approx(100).epsilon(0.5));
  for (int k = 1; k <= 50; ++k) {
    const double share = run.ended(2, 88 + k);
    CHECK(seconds_left(88 + k, share) == Approx(100 - k).epsilon(1e-9));  // rounding: all times are equal
  }
}

TEST_CASE("run share: jobs on two cores, each stage in the same time in both") {
  RunShare pairs({20, 20, 20});  // ten pairs of 8 + 80 + 1 s
  // Of the simulations alone: the other stages by their usual times, 90 and 1 for 9.
  pairs.ended(0, 8);
  double share = pairs.ended(0, 8);
  CHECK(seconds_left(8, share) == Approx(10 * 8 * 100 / 9.0 - 8).epsilon(1e-9));  // rounding
  for (const auto& [stage, seconds] : {std::pair{1, 88.0}, {1, 88.0}, {2, 89.0}, {2, 89.0}})
    share = pairs.ended(static_cast<std::size_t>(stage), seconds);
  CHECK(seconds_left(89, share) == Approx(9 * 89.0).epsilon(1e-9));  // rounding
}
