// Visual checks against counted ones, closed forms and limits.
#include "fatigue/inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/catch.h"

namespace dresslife::fatigue {

using pipeline::found_before;

TEST_CASE("inspection: checks of even intervals that begin at any phase, counted") {
  constexpr int phases = 100000;
  for (const double visible : {0.0, 30.0, 160.0, 400.0, 1000.0})
    for (const double found : {0.0, 0.3, 0.75, 1.0}) {
      constexpr double interval = 160;
      double missed = 0;
      for (int k = 0; k < phases; ++k) {
        double all = 1;
        for (double check = interval * (k + 0.5) / phases; check < visible; check += interval) all *= 1 - found;
        missed += all / phases;
      }
      constexpr double one_phase = 1.0 / phases;  // lies on either side of a check
      CHECK(found_before(visible, interval, found) == Approx(1 - missed).margin(2 * one_phase));
    }
}

TEST_CASE("inspection: frequent checks find all, rare ones in proportion to the visible time") {
  CHECK(found_before(100, 1e-3, 0.5) == Approx(1));
  CHECK(found_before(100, 1e6, 0.5) == Approx(0.5e-4));
  CHECK(found_before(0, 10, 1) == 0);
  double last = 1;
  for (double interval = 1; interval < 1e4; interval *= 1.3) {
    const double found = found_before(500, interval, 0.75);
    CHECK(found <= last);
    last = found;
  }
}

TEST_CASE("inspection: only failures before the replacement count, and what is visible from the start is found last") {
  pipeline::Inspection inspection;
  inspection.interval_weeks = 1;
  pipeline::Fatigue fatigue;
  fatigue.operating_hours_per_week = 100, fatigue.robot_life_hours = 5000;
  constexpr double repeat = 3600, never = std::numeric_limits<double>::infinity();
  const std::vector<double> lives{2, 3, 4, never};  // 100, 1,000, 10,000 h
  const std::vector<double> intact(4, never);
  const Inspected half = inspected(lives, intact, repeat, 0.5, inspection, fatigue);
  CHECK(half.failed_share == 0.5);
  const double first = 0.75 * 0.5, second = 1 - std::pow(0.25, 5);  // half a check, five checks
  CHECK(half.found_share == Approx((first + second) / 2));
  CHECK(half.unseen_share == Approx((2 - first - second) / 4));
  CHECK(inspected(lives, intact, repeat, 1, inspection, fatigue).found_share == 0);
  CHECK(inspected(lives, intact, repeat, 1, inspection, fatigue).unseen_share == 0.5);
  CHECK(inspected(lives, intact, repeat, 0, inspection, fatigue).found_share > half.found_share);
  const Inspected none = inspected({never, 4}, {never, never}, repeat, 0.5, inspection, fatigue);
  CHECK(none.failed_share == 0);
  CHECK(std::isnan(none.found_share));
  CHECK(none.unseen_share == 0);
  // Wires that fail at 500 h: the dresspack is replaced before the wear of 1,000 h. Of one that fails at 50 h the others are
  // replaced, too, as soon as it is 1 of 10.
  CHECK(inspected(lives, {2.7, 2.7, 2.7, 2.7}, repeat, 0.5, inspection, fatigue).failed_share == 0.25);
  std::vector<double> weak(20, never), worn(20, 3);
  weak[0] = 1.7;
  CHECK(inspected(worn, weak, repeat, 0.5, inspection, fatigue).failed_share == 0.95);
  std::fill_n(weak.begin(), 5, 1.7);
  CHECK(inspected(worn, weak, repeat, 0.5, inspection, fatigue).failed_share == 0);
}

}  // namespace dresslife::fatigue
