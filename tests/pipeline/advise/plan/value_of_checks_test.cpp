// The value of visual checks against plants in which every check is simulated, and against closed forms.
#include "pipeline/advise/plan/value_of_checks.h"

#include <cmath>
#include <limits>
#include <random>

#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/base/statistics.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double week = 100, planned = 1000, unplanned = 9000;  // [h of operation], money
const Day start = *day_from("2026-11-23");

AbrasionLife life_with(double median, double spread, double visible_from, double interval_weeks, double found_percent) {
  AbrasionLife life;
  life.median = median, life.early = median * std::pow(10, spread * normal_quantile(0.1)),
  life.visible_from = visible_from;
  life.inspection.interval_weeks = interval_weeks, life.inspection.found_percent = found_percent;
  return life;
}

Installed installed_for(int weeks, const std::string& duty = "d") {
  return {{}, "r" + std::to_string(weeks), duty, start - std::chrono::days(7 * weeks), {}, planned, unplanned};
}

/// Wires that never fail, for the duties d and other.
std::map<std::string, LifeTable> endless() {
  const LifeTable table{1, 1, {std::numeric_limits<float>::infinity()}, 40000, week};
  return {{"d", table}, {"other", table}};
}

/// A plan in which no dresspack is replaced: the first window after `weeks`, the end after twice as many.
struct Plant {
  Fleet fleet;
  std::map<std::string, LifeTable> tables = endless();
  Plan plan;

  explicit Plant(std::vector<Installed> rows, int weeks = 50) {
    fleet.rows = std::move(rows), fleet.has_costs = true;
    const Day first = start + std::chrono::days(7 * weeks);
    plan = plan_of(
        fleet, tables,
        {{start + std::chrono::days(7 * (weeks / 2)), start + std::chrono::days(7 * (weeks / 2))}, {first, first}},
        start, {0.1, true});
  }
  std::vector<CheckValue> values(const std::map<std::string, AbrasionLife>& lives) const {
    return *values_of_checks(fleet, tables, lives, plan);
  }
};

}  // namespace

TEST_CASE("checks: what they save is what they save in plants in which each check is made") {
  constexpr double spread = 0.4, visible_from = 0.6, found = 0.3;
  for (const double interval_weeks : {0.5, 3.0, 12.0})
    for (const double median : {400.0, 3000.0, 20000.0})
      for (const int age_weeks : {0, 15}) {
        const Plant plant({installed_for(age_weeks)}, 50);
        const AbrasionLife life = life_with(median, spread, visible_from, interval_weeks, 100 * found);
        const double age = week * age_weeks, end = 75 * week,
                     interval = interval_weeks * week;  // two windows 25 weeks apart
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform;
        double saved = 0, squares = 0, fails = 0, fails_squares = 0, today = 0;
        constexpr int plants = 20000;
        for (int k = 0; k < plants;) {
          const double one = median * std::pow(10, spread * normal(random));
          if (one <= age) continue;  // all have survived
          ++k;
          double number = 0, of_plant = 0;
          for (double installed = -age; installed + one < end; installed += one) {
            ++number;
            bool seen = false;
            for (double check = interval * uniform(random) + std::max(0.0, installed + visible_from * one);
                 check < installed + one; check += interval)
              seen = seen || uniform(random) < found;
            of_plant += seen ? unplanned - planned : 0;
          }
          saved += of_plant, squares += of_plant * of_plant, fails += number, fails_squares += number * number;
          if (age >= visible_from * one) today += one < age + end ? unplanned - planned : -planned;
        }
        const CheckValue value = plant.values({{"d", life}}).front();
        INFO(interval_weeks << " weeks, median " << median << ", age " << age);
        // Four standard errors of the plants, plus half of one of the 1,000 values of z, each of which is a step of the sums.
        const auto error = [&](double sum, double of_squares) {
          return 4 * std::sqrt((of_squares / plants - sum * sum / plants / plants) / plants);
        };
        CHECK(value.fails == Approx(fails / plants).margin(error(fails, fails_squares) + 1e-3));
        CHECK(value.regular == Approx(saved / plants).margin(error(saved, squares) + 1e-3 * unplanned));
        CHECK(value.found * (unplanned - planned) == Approx(value.regular));
        CHECK(value.today == Approx(found * std::max(0.0, today / plants)).margin(4 * unplanned / std::sqrt(plants)));
      }
}

TEST_CASE("checks: one check today is worth its share of the wear that is visible now") {
  // The plan ends long after all have failed: the value is p (C_u - C_p) P(v T <= a | T > a).
  constexpr double spread = 0.3, visible_from = 0.5, found = 0.75, median = 3000;
  const Plant plant({installed_for(20)}, 400);
  const double age = 20 * week, alive = 1 - normal_share(std::log10(age / median) / spread);
  const double visible = normal_share(std::log10(age / visible_from / median) / spread) - (1 - alive);
  const AbrasionLife life = life_with(median, spread, visible_from, 2, 100 * found);
  CHECK(plant.values({{"d", life}}).front().today ==
        Approx(found * (unplanned - planned) * visible / alive).margin(2e-3 * unplanned));
  // No value: a new dresspack without visible damage, a check that finds nothing, and a dresspack without rubbing.
  CHECK(Plant({installed_for(0)}, 400).values({{"d", life}}).front().today == 0);
  CHECK(plant.values({{"d", life_with(median, spread, visible_from, 2, 0)}}).front().regular == 0);
  CHECK(plant.values({}).front().fails == 0);
  CHECK(plant.values({{"d", life_with(std::numeric_limits<double>::infinity(), spread, visible_from, 2, 75)}})
            .front()
            .fails == 0);
  // Without regular checks, one check today has the same value.
  const CheckValue once = plant.values({{"d", life_with(median, spread, visible_from, 0, 100 * found)}}).front();
  CHECK(once.regular == 0);
  CHECK(once.found == 0);
  CHECK(once.today == plant.values({{"d", life}}).front().today);
}

TEST_CASE("checks: an old dresspack that lives makes the abrasion of all others slower") {
  const AbrasionLife life = life_with(2000, 0.5, 0.5, 2, 75);
  const double alone = Plant({installed_for(10)}).values({{"d", life}}).front().fails;
  const double beside_old = Plant({installed_for(10), installed_for(40)}).values({{"d", life}}).front().fails;
  CHECK(beside_old < 0.8 * alone);
  // A dresspack under another duty that wears four times as slowly gives less information at the same age.
  const double beside_slow = Plant({installed_for(10), installed_for(40, "other")})
                                 .values({{"d", life}, {"other", life_with(8000, 0.5, 0.5, 2, 75)}})
                                 .front()
                                 .fails;
  CHECK(beside_slow == Approx(alone));
  // 400 weeks of 100 h are twenty times the median: 2.6 deviations, 1 plant in 200. With a spread of 0.3: 1 in 140,000.
  const Plant old({installed_for(400)});
  CHECK(values_of_checks(old.fleet, old.tables, {{"d", life}}, old.plan).has_value());
  const auto none = values_of_checks(old.fleet, old.tables, {{"d", life_with(2000, 0.3, 0.5, 2, 75)}}, old.plan);
  CHECK_FALSE(none.has_value());
  CHECK(check_words(none, {}, old.fleet, old.plan).find("fewer than 1 in 1,000 such plants") != std::string::npos);
}

TEST_CASE("checks: hours under an earlier duty count by their wear") {
  Plant plant({installed_for(20)});
  const AbrasionLife own = life_with(4000, 0.3, 0.5, 2, 50);
  const auto today = [&](const std::map<std::string, AbrasionLife>& lives) { return plant.values(lives)[0].today; };
  const double before = today({{"d", own}});
  CHECK(before > 0);
  plant.fleet.rows[0].before = {{"other", 19 * week}};  // of its 20 weeks
  plant.plan = plan_of(plant.fleet, plant.tables, plant.plan.windows, start, {0.1, true});
  CHECK(plant.plan.rows[0].age_hours == 20 * week);
  CHECK(today({{"d", own}, {"other", own}}) == before);
  AbrasionLife slower = own;
  slower.median *= 19;  // as two weeks of the present duty
  CHECK(today({{"d", own}, {"other", slower}}) == Plant({installed_for(2)}).values({{"d", own}})[0].today);
  CHECK(today({{"d", own}}) ==
        Plant({installed_for(1)}).values({{"d", own}})[0].today);  // nothing rubs under the other
}

TEST_CASE("checks: the words name the dresspacks with most, and what the regular checks save") {
  const Plant plant({installed_for(0), installed_for(20), installed_for(10)});
  std::vector<CheckValue> values(3);
  values[1] = {321, 400, 0.5, 0.25}, values[2] = {500, 100, 0.1, 0.05};
  Inspection inspection;
  const std::string words = check_words(values, inspection, plant.fleet, plant.plan);
  INFO(words);
  CHECK(words.find(
            "\n        500  r10\n        321  r20\nWithout checks abrasion wears through 0.60 dresspacks until ") !=
        std::string::npos);
  CHECK(words.ends_with(".\nChecks every 2 weeks find 0.30 of these before and save 500.\n"));
  inspection.interval_weeks = 0;
  CHECK(check_words(values, inspection, plant.fleet, plant.plan).find("every") == std::string::npos);
  CHECK(check_words(std::vector<CheckValue>(3), {}, plant.fleet, plant.plan).starts_with("No visual check"));
  CHECK(csv_text(plan_table(plant.fleet, plant.plan, values)).find("checks_save\n") != std::string::npos);
  CHECK(csv_text(plan_table(plant.fleet, plant.plan, values)).find(",321,400\n") != std::string::npos);
  CHECK(csv_text(plan_table(plant.fleet, plant.plan)).find(",,\n") != std::string::npos);
}
