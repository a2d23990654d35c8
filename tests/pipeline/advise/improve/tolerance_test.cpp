// The best routings judged by how long they live within the mounting tolerance (T1).
#include "pipeline/advise/improve/tolerance.h"

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

/// A finalist with one clamp, whose lives with it off are these; counts its runs.
Finalist finalist(double hours, std::vector<double> lives, int& runs) {
  Finalist of{hours, std::vector<Nudge>(lives.size()), {}};
  of.run = [lives, &runs](std::size_t first, std::size_t count) {
    std::vector<Outcome> outcomes(count);
    for (std::size_t k = 0; k < count; ++k) {
      outcomes[k].hours = lives[first + k];
      if (lives[first + k] == 0) outcomes[k].failure = "too short";
      ++runs;
    }
    return outcomes;
  };
  return of;
}

TEST_CASE("tolerance: the longest life in the worst place wins, not the longest as drawn") {
  int sharp = 0, blunt = 0, last = 0;
  const std::vector<Finalist> finalists{finalist(1000, {900, 60, 800, 700, 600, 500}, sharp),
                                        finalist(700, {650, 600, 690, 500, 640, 720}, blunt),
                                        finalist(450, {450, 450, 450, 450, 450, 450}, last)};
  const std::vector<WithinTolerance> judged = within_tolerance(finalists);
  REQUIRE(judged.size() == 2);  // the last lives at most 450 h, less than the second within its tolerance
  CHECK(last == 0);
  CHECK(best_within(judged) == 1);
  CHECK(judged[0].least_hours == 60);
  CHECK(judged[1].least_hours == 500);
  CHECK(judged[1].nudges[0].share == Approx(650.0 / 700));
}

TEST_CASE("tolerance: one that falls behind is given up, and one that does not run lives 0 h") {
  int first = 0, second = 0;
  const std::vector<double> fails{900, 0, 900, 900, 900, 900, 900, 900, 900, 900, 900, 900};
  const std::vector<WithinTolerance> judged =
      within_tolerance({finalist(1000, std::vector<double>(12, 800), first), finalist(950, fails, second)});
  REQUIRE(judged.size() == 2);
  CHECK(second == 6);
  CHECK_FALSE(judged[1].whole);
  CHECK(judged[1].least_hours == 0);
  CHECK(judged[1].nudges[1].words == "too short");
  CHECK(best_within(judged) == 0);
  CHECK(
      tolerance_words(judged[0].nudges, 0.01) ==
      "With a clamp or the length off by 10 mm it lives at least 0.8 times as long, and all limits are kept\n");
}

}  // namespace
}  // namespace dresslife::pipeline
