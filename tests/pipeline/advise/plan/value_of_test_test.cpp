// The value of a test against costs calculated by hand, and its bounds.
#include "pipeline/advise/plan/value_of_test.h"

#include <cmath>
#include <limits>

#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/job/uncertainty.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double week = 70;  // [h of operation]: 10 per day
const Day start = *day_from("2026-11-23");

std::vector<Window> windows_in(const std::vector<int>& weeks) {
  std::vector<Window> windows;
  for (const int of : weeks)
    windows.push_back({start + std::chrono::days(7 * of), start + std::chrono::days(7 * of)});
  return windows;
}

Fleet new_dresspacks(std::size_t count, double planned, double unplanned) {
  Fleet fleet;
  for (std::size_t i = 0; i < count; ++i)
    fleet.rows.push_back({{}, "r" + std::to_string(i), "d", start, {}, planned, unplanned});
  fleet.has_costs = true;
  return fleet;
}

}  // namespace

TEST_CASE("a perfect test of two equally likely worlds saves what each costs less by itself") {
  // In one world every dresspack fails at 2,000 h, in the other none ever fails.
  constexpr double life = 2000, robot = 40000, planned = 1, unplanned = 10;
  const float endless = std::numeric_limits<float>::infinity();
  const std::map<std::string, LifeTable> tables{
      {"d", LifeTable{2, 1, {static_cast<float>(life), endless}, robot, week}}};
  const Fleet fleet = new_dresspacks(3, planned, unplanned);
  const Plan plan = plan_of(fleet, tables, windows_in({10, 20}), start, {0.1, true});
  constexpr double last = 1400, end = 2100;  // [h]: the windows are at 700 and 1,400
  // Before the test: replaced at the last window before 2,000 h, later always just before this age, because of the first world.
  const double before = planned + planned / life * (end - last);
  // After the test: the same in the first world. In the second it is replaced as late as possible: the latest time is 700 h times
  // 1.5^10 after the window. The hours beyond the plan are worth the cost of one dresspack per robot's life.
  const double latest = last + 700 * std::pow(1.5, 10), never = planned - planned / robot * (latest - end);
  const double expected = 3 * (before - (before + never) / 2);
  // Ages of (D6) are 2 % apart: 2 % of the 0.35 that successors cost.
  CHECK(value_of_test({0, "", {-1, 1}}, 1e-6, fleet, tables, plan) ==
        Approx(expected).margin(3 * 0.02 * 0.35));
  CHECK(value_of_test({0, "", {4, 4.5}}, 1e-6, fleet, tables, plan) ==
        Approx(value_of_test({0, "", {-1, 1}}, 1e-6, fleet, tables, plan)).epsilon(1e-12));  // a calibrated one
  // A test without information saves nothing. A better test never saves less.
  CHECK(value_of_test({0, "", {-1, 1}}, 1e6, fleet, tables, plan) == Approx(0).margin(1e-4));
  constexpr double rounding = 1e-12;  // of sums of about ten terms
  double least = 0;
  for (const double error : {1e6, 4.0, 1.0, 0.5, 0.25, 1e-6}) {
    const double saves = value_of_test({0, "", {-1, 1}}, error, fleet, tables, plan);
    CHECK(saves > least - rounding);
    least = saves;
  }
  const std::string words = test_words({{{index_of(Uncertain::friction_inside), "hose", {}}, 1234},
                                        {{index_of(Uncertain::model), "", {}}, 1e-4}},
                                       plan);
  CHECK(words.find("1,230  One bending test of a cable (one hour): friction_inside of 'hose'\n") !=
        std::string::npos);
  CHECK(words.find("model") == std::string::npos);  // less than a thousandth of the plan's cost
  CHECK(test_words({}, plan).find("No test") != std::string::npos);
  // A parameter that is equal in both worlds.
  CHECK(value_of_test({0, "", {0.3, 0.3}}, 0.1, fleet, tables, plan) == Approx(0).margin(rounding));
}
