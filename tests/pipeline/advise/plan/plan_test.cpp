// Plans against closed forms: age replacement of a Weibull life, constant failure rates, the information in survivors of a plant.
#include "pipeline/advise/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>

#include "pipeline/advise/plan/doubtful_plan.h"
#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/advise/plan/pooled_lives.h"
#include "pipeline/base/readable.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double week = 70;  // [h of operation]: 10 per day
const Day start = *day_from("2026-11-23");

/// Quantiles of a Weibull life, one list for each world's scale [h].
LifeTable weibull(double shape, const std::vector<double>& scales, std::size_t draws = 20000) {
  LifeTable table{scales.size(), draws, {}, 40000, week};
  for (const double scale : scales)
    for (std::size_t d = 0; d < draws; ++d)
      table.hours.push_back(
          static_cast<float>(scale * std::pow(-std::log1p(-(double(d) + 0.5) / double(draws)), 1 / shape)));
  return table;
}

/// Dresspacks of these ages [weeks].
Fleet fleet_of(const std::vector<int>& ages, double planned = 0, double unplanned = 0) {
  Fleet fleet;
  for (const int age : ages)
    fleet.rows.push_back(
        {{}, "r" + std::to_string(fleet.rows.size()), "d", start - std::chrono::days(7 * age), {}, planned, unplanned});
  fleet.has_costs = unplanned > 0;
  return fleet;
}

/// A window in each of these weeks.
std::vector<Window> windows_in(const std::vector<int>& weeks) {
  std::vector<Window> windows;
  for (const int of : weeks) windows.push_back({start + std::chrono::days(7 * of), start + std::chrono::days(7 * of)});
  return windows;
}

/// Returns a text with its line breaks and indents as single blanks.
std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
  return text;
}

std::vector<int> many(std::size_t count, int age) { return std::vector<int>(count, age); }

}  // namespace

TEST_CASE("a count of lives says on which side of a limit their median is") {
  const LifeTable table{2,
                        3,
                        {1, 2, 900, 4, 5, std::numeric_limits<float>::infinity()},
                        40,
                        80};  // median 5 of all, 4 of the finite ones
  CHECK(table.median() == 5);
  CHECK_FALSE(table.half_end_before(5));
  CHECK(table.half_end_before(5.5));
  CHECK(table.horizon_or_median() == 40);
  const auto with_horizon = [&](double hours) {
    LifeTable other = table;
    other.robot_life_hours = hours;
    return other.horizon_or_median();
  };
  CHECK(with_horizon(4) == 4);
  CHECK(with_horizon(3.9) == 4);
  CHECK(with_horizon(0.5) == 4);
  LifeTable endless = table;
  std::ranges::fill(endless.hours, std::numeric_limits<float>::infinity());
  CHECK(endless.horizon_or_median() == 40);
}

TEST_CASE("a plan names the dresspacks that reach the age of a mode without validation") {
  // Ages 5, 40 and 60 weeks of 70 h: 350, 2,800 and 4,200 h. The plan ends 24 weeks from today, because of its two windows.
  Fleet fleet = fleet_of({5, 40, 60});
  Plan plan = plan_of(fleet, {{"d", weibull(3, {1e6})}}, windows_in({4, 14}), start, {0.2, false});
  REQUIRE((plan.end - plan.today).count() == 24 * 7);
  const auto words = [&](double hours) {
    const std::string text = age_words(fleet, plan, {{"d", {{"jacket wear", hours}}}}, {{"d", week}});
    CHECK(text.find('\n') + 1 == text.size());  // one line, so that a page breaks it by its own width; empty: none
    return text;
  };
  CHECK(words(2900).find("jacket wear") != std::string::npos);
  CHECK(words(2900).find("Inspect now: r2.") != std::string::npos);
  CHECK(words(2900).find("before they are replaced: r1.") != std::string::npos);  // 2,800 + 24 weeks of 70 h
  CHECK(words(100).find("Inspect now: r0, r1, r2.") != std::string::npos);
  CHECK(words(4200 + 24 * week + 1).empty());
  // r1 reaches 2,900 h after a week: it is named while its wires live that long in 1 of 10 cases.
  Plan fails = plan;
  for (const double failed : {0.8, 0.95}) {
    fails.rows[1].fails_in_week[0] = failed;
    const std::string text = age_words(fleet, fails, {{"d", {{"jacket wear", 2900}}}}, {{"d", week}});
    CHECK((text.find("replaced: r1.") != std::string::npos) == (failed < 0.9));
  }
  CHECK(age_words(fleet, plan, {}, {}).empty());
  const std::string lines = wrapped_lines("  1,234  a test\n" + words(2900), 118);
  CHECK(lines.starts_with("  1,234  a test\nNot validated"));
  for (std::size_t begin = 0, end; (end = lines.find('\n', begin)) != std::string::npos; begin = end + 1)
    CHECK(end - begin <= 118);
  // Hours under an earlier duty count by their wear: 3,000 h that wear a tenth as much, and 1,200 h.
  fleet.rows[2].before = {{"gentle", 3000}};
  CHECK(worn_hours(fleet.rows[2], 4200, [](const std::string& duty) { return duty == "d" ? 2900 : 29000; }) == 1500);
  CHECK(worn_hours(fleet.rows[2], 1000, [](const std::string& duty) { return duty == "d" ? 2900 : 29000; }) == 100);
  const auto with_gentle = [&](std::vector<AgeLimit> gentle) {
    return age_words(fleet, plan, {{"d", {{"jacket wear", 2900}}}, {"gentle", std::move(gentle)}}, {{"d", week}});
  };
  CHECK(with_gentle({{"jacket wear", 29000}}).find("replaced: r1, r2.") != std::string::npos);
  CHECK(with_gentle({{"jacket wear", 2900}}).find("Inspect now: r2.") != std::string::npos);
  CHECK(with_gentle({}).find("r2") == std::string::npos);  // no wear: 1,200 h and 24 weeks of 70 h
  fleet.rows[2].before.clear();
  // If it is replaced in the first window, its age increases by at most 4 weeks.
  for (RowPlan& row : plan.rows) row.window = 0;
  CHECK(words(2800 + 4 * week + 1).find("r1") == std::string::npos);
  CHECK(words(2800 + 4 * week - 1).find("replaced: r1.") != std::string::npos);
  // A dresspack's own hours per week are used.
  fleet.rows[1].hours_per_week = 10;
  plan.rows[1].window.reset();
  CHECK(words(2800 + 24 * 10 + 1).find("r1") == std::string::npos);
  CHECK(words(2800 + 24 * 10 - 1).find("r1") != std::string::npos);
}

TEST_CASE("with frequent windows a dresspack is replaced at the best age of a Weibull life") {
  constexpr double shape = 3, scale = 5000, planned = 1, unplanned = 6;
  // The age with the least cost per hour, by brute force over ages of an hour.
  double best = 0, least = std::numeric_limits<double>::infinity(), running = 0;
  for (double age = 1; age < 3 * scale; ++age) {
    const double lives = std::exp(-std::pow(age / scale, shape));
    running += std::exp(-std::pow((age - 0.5) / scale, shape));
    if (const double rate = (planned * lives + unplanned * (1 - lives)) / running; rate < least)
      least = rate, best = age;
  }
  std::vector<int> ages;
  for (int age = 0; age < 90; ++age) ages.push_back(age);
  const Plan plan = plan_of(fleet_of(ages, planned, unplanned), {{"d", weibull(shape, {scale})}}, windows_in({1, 2}),
                            start, {0.1, true});
  for (std::size_t k = 0; k < ages.size(); ++k) {
    const double at_window = (ages[k] + 1) * week;
    INFO("age at the window " << at_window << ", best " << best);
    // One interval of a week, and steps of 2 % in the age of (D6) at a flat minimum.
    if (at_window < best - 2 * week) CHECK(plan.rows[k].window != std::optional<std::size_t>(0));
    if (at_window > best + 2 * week) CHECK(plan.rows[k].window == std::optional<std::size_t>(0));
  }
  // A new dresspack that can be replaced every week: cost per hour by the closed form, over twenty of its lives.
  std::vector<int> weeks;
  for (int of = 1; of <= 20 * int(best / week); ++of) weeks.push_back(of);
  const Plan longer = plan_of(fleet_of(many(20, 0), planned, unplanned), {{"d", weibull(shape, {scale})}},
                              windows_in(weeks), start, {0.1, true});
  const double hours = 20 * week * (weeks.back() + 1);
  CHECK(longer.cost / hours == Approx(least).epsilon(0.05));  // the last life of each is not at its end
  CHECK(longer.cost < 0.75 * longer.cost_without_windows);
}

TEST_CASE("by risk a dresspack is replaced where a Weibull life fails in the interval more often") {
  constexpr double shape = 2.5, scale = 4000;
  for (const double risk : {0.02, 0.1, 0.3}) {
    const Plan plan =
        plan_of(fleet_of({5, 20, 40, 60}), {{"d", weibull(shape, {scale})}}, windows_in({4, 14}), start, {risk, false});
    for (std::size_t k = 0; k < 4; ++k) {
      const double age = plan.rows[k].age_hours;
      const auto lives = [&](double weeks) { return std::exp(-std::pow((age + weeks * week) / scale, shape)); };
      CHECK(plan.rows[k].fails_before_first == Approx(1 - lives(4) / lives(0)).margin(2e-4));  // 20,000 draws
      CHECK(plan.rows[k].fails_until_next[0] == Approx(1 - lives(14) / lives(4)).margin(2e-4));
      CHECK(plan.rows[k].fails_until_next[1] == Approx(1 - lives(24) / lives(14)).margin(2e-4));
      CHECK((plan.rows[k].window == std::optional<std::size_t>(0)) == (1 - lives(14) / lives(4) > risk));
    }
  }
}

TEST_CASE("dresspacks that fail young or never are not replaced: a new one would be worse") {
  // Shape 0.6: the remaining life increases with age. Tested for each world alone, and for two worlds together.
  for (const auto& [shape, scales] :
       {std::pair(0.6, std::vector<double>{4000}), std::pair(1.0, std::vector<double>{500, 100000})}) {
    const auto tables = std::map<std::string, LifeTable>{{"d", weibull(shape, scales, 4000)}};
    const Plan plan = plan_of(fleet_of(many(20, 4), 1, 6), tables, windows_in({2, 10, 30, 60}), start, {0.1, true});
    for (const RowPlan& row : plan.rows) CHECK_FALSE(row.window);
    CHECK(plan.cost == Approx(plan.cost_without_windows).epsilon(1e-12));
    if (shape == 1) continue;  // with a constant rate a new one is equal except for rounding
    const Plan by_risk = plan_of(fleet_of(many(20, 4)), tables, windows_in({2, 10, 30, 60}), start, {0.01, false});
    for (const RowPlan& row : by_risk.rows) CHECK_FALSE(row.window);
  }
}

TEST_CASE("the failures of the weeks add up to those until the windows, and to those of the years") {
  const Plan plan =
      plan_of(fleet_of({5, 40, 60}), {{"d", weibull(2.5, {4000, 9000})}}, windows_in({4, 14}), start, {0.2, false});
  REQUIRE(plan.failures_in_week.size() == 24);
  for (const RowPlan& row : plan.rows) {
    const auto until = [&](std::size_t end) {
      return std::accumulate(row.fails_in_week.begin(), row.fails_in_week.begin() + std::ptrdiff_t(end), 0.0);
    };
    CHECK(until(4) == Approx(row.fails_before_first).epsilon(1e-9));  // sums of the same parts, rounded otherwise
    CHECK(until(14) == Approx(1 - (1 - row.fails_before_first) * (1 - row.fails_until_next[0])).epsilon(1e-9));
  }
  // A plan that ends within a week counts only the days of this week. The interval after one window is a year.
  const Plan year_later =
      plan_of(fleet_of({40}), {{"d", weibull(2.5, {4000, 9000})}}, windows_in({4}), start, {1, false});
  CHECK(std::accumulate(year_later.rows[0].fails_in_week.begin(), year_later.rows[0].fails_in_week.end(), 0.0) ==
        Approx(year_later.rows[0].fails_before).margin(4e-4));
  double unplanned = 0;
  for (const YearOfPlan& year : plan.years) unplanned += year.unplanned;
  // Both have equal failures of later dresspacks. Those of today's are expected here, and counted in 1,000 plants there.
  CHECK(std::accumulate(plan.failures_in_week.begin(), plan.failures_in_week.end(), 0.0) ==
        Approx(unplanned).margin(4 * std::sqrt(unplanned / 1000)));
  CHECK(plan_weeks_csv(fleet_of({5, 40, 60}), plan)
            .starts_with("name,fails_in_week_of_2026-11-23,fails_in_week_of_2026-11-30,"));
}

TEST_CASE("a week of few sampled lives has no chance of its own: its failures are those of the law") {
  // 500 worlds of 64 lives each. One week contains one of these lives on average.
  constexpr double shape = 2.5, scale = 60000;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  LifeTable table{500, 64, {}, 40000, week};
  for (std::size_t w = 0; w < table.worlds; ++w) {
    std::vector<float> lives;
    for (std::size_t d = 0; d < table.draws; ++d)
      lives.push_back(static_cast<float>(scale * std::pow(-std::log(uniform(random)), 1 / shape)));
    std::sort(lives.begin(), lives.end());
    table.hours.insert(table.hours.end(), lives.begin(), lives.end());
  }
  const Plan plan = plan_of(fleet_of({26}), {{"d", table}}, windows_in({52}), start, {1, false});
  double worst = 0;
  for (std::size_t k = 0; k < 52; ++k) {
    const auto alive = [&](double weeks) { return std::exp(-std::pow((26 + weeks) * week / scale, shape)); };
    const double law = (alive(double(k)) - alive(double(k + 1))) / alive(0);
    worst = std::max(worst, std::abs(plan.rows[0].fails_in_week[k] / law - 1));
  }
  CHECK(worst < 0.4);  // two deviations of the 32 parts of lives in a week; by count 1, for a week without a life
}

TEST_CASE(
    "without windows a constant failure rate needs so many spare dresspacks, with the spread of a Poisson number") {
  constexpr double mean = 2000;
  const Plan plan = plan_of(fleet_of(many(50, 10)), {{"d", weibull(1, {mean})}}, windows_in({26}), start, {1, false});
  const double expected = 50 * week * 365.2425 / 7 / mean;
  REQUIRE(plan.years.size() >= 1);
  CHECK(plan.years[0].planned == 0);
  CHECK(plan.years[0].unplanned ==
        Approx(expected).margin(4 * std::sqrt(expected / 1000)));  // 1,000 plants, 4 deviations
  CHECK(plan.years[0].low == Approx(expected - 1.645 * std::sqrt(expected)).margin(3));
  CHECK(plan.years[0].high == Approx(expected + 1.645 * std::sqrt(expected)).margin(3));
}

TEST_CASE("failures, spare dresspacks and costs are those of plants that are drawn from the Weibull lives themselves") {
  constexpr double shape = 2.5, planned = 1, unplanned = 6;
  const std::vector<double> scales{4000, 9000};
  const std::vector<int> ages{5, 40, 60};  // [weeks]
  const Plan plan = plan_of(fleet_of(ages, planned, unplanned), {{"d", weibull(shape, scales)}}, windows_in({10}),
                            start, {0.1, true});
  REQUIRE(std::any_of(plan.rows.begin(), plan.rows.end(), [](const RowPlan& row) { return row.window.has_value(); }));
  const double window = 10 * week, end = days_between(start, plan.end) * week / 7, year = 365.2425 * week / 7;
  const auto alive = [&](double scale, double age) { return std::exp(-std::pow(age / scale, shape)); };
  std::vector<double> weights;
  for (const double scale : scales) {
    double& weight = weights.emplace_back(1);
    for (const int age : ages) weight *= alive(scale, age * week);
  }
  std::mt19937 random(3);
  std::discrete_distribution<std::size_t> world(weights.begin(), weights.end());
  std::uniform_real_distribution<double> uniform;
  constexpr int count = 200'000;
  std::array<double, 2> cost{}, failures{}, replaced{}, without{};  // sums of values and of their squares
  std::vector<double> first_year;
  const auto add = [](std::array<double, 2>& sums, double value) { sums[0] += value, sums[1] += value * value; };
  for (int k = 0; k < count; ++k) {
    const double scale = scales[world(random)];
    double money = 0, failed = 0, exchanged = 0, first = 0, bare = 0;
    for (std::size_t i = 0; i < ages.size(); ++i) {
      const double age = ages[i] * week;
      const auto life = [&](double from) {
        return scale * std::pow(std::pow(from / scale, shape) - std::log(1 - uniform(random)), 1 / shape);
      };
      const double own = life(age) - age;
      for (const bool by_plan : {true, false}) {
        double at = own;
        if (by_plan && plan.rows[i].window && at >= window) {  // one that failed before the window is new
          money += planned, ++exchanged, first += window < year;
          at = window + life(0);
        }
        for (; at < end; at += life(0)) {
          (by_plan ? money : bare) += unplanned;
          if (by_plan) ++failed, first += at < year;
        }
      }
    }
    add(cost, money), add(failures, failed), add(replaced, exchanged), add(without, bare), first_year.push_back(first);
  }
  double all_planned = 0, all_unplanned = 0;
  for (const YearOfPlan& of : plan.years) all_planned += of.planned, all_unplanned += of.unplanned;
  // Four standard errors of the plan's 1,000 plants. Its lives are 20,000 quantiles of each world, whose error is far smaller.
  const auto check = [&](double found, const std::array<double, 2>& sums) {
    const double mean = sums[0] / count, error = std::sqrt((sums[1] / count - mean * mean) / 1000);
    CHECK(found == Approx(mean).margin(4 * error));
  };
  check(plan.cost, cost), check(all_unplanned, failures), check(all_planned, replaced),
      check(plan.cost_without_windows, without);
  std::sort(first_year.begin(), first_year.end());
  // Whole numbers: the result may be the neighbouring number.
  CHECK(plan.years[0].low == Approx(first_year[count / 20]).margin(1));
  CHECK(plan.years[0].high == Approx(first_year[count - count / 20]).margin(1));
}

TEST_CASE("survivors tell which world the plant is in, and the spread between plants stays") {
  // Two worlds with a constant failure rate each; n dresspacks have survived to the age a.
  constexpr double bad = 1000, good = 20000, age = 10 * week;
  for (const std::size_t count : {1, 4, 30}) {
    const Plan plan =
        plan_of(fleet_of(many(count, 10)), {{"d", weibull(1, {bad, good})}}, windows_in({10}), start, {1, false});
    const double survive_bad = std::exp(-double(count) * age / bad),
                 survive_good = std::exp(-double(count) * age / good);
    const double of_bad = survive_bad / (survive_bad + survive_good);
    const auto fails = [&](double mean) { return 1 - std::exp(-10 * week / mean); };
    CHECK(plan.rows[0].fails_before_first == Approx(of_bad * fails(bad) + (1 - of_bad) * fails(good)).margin(1e-3));
    // Worlds of a calibration that already includes the survivors: they are not counted twice.
    PlanRule counted{1, false};
    counted.knows_survivors = true;
    const Plan known =
        plan_of(fleet_of(many(count, 10)), {{"d", weibull(1, {bad, good})}}, windows_in({10}), start, counted);
    CHECK(known.rows[0].fails_before_first == Approx((fails(bad) + fails(good)) / 2).margin(1e-3));
  }
  // New dresspacks contain no information: the number of failures is that of one world or of the other, not of their mean.
  const Plan fresh =
      plan_of(fleet_of(many(100, 0)), {{"d", weibull(1, {bad, good})}}, windows_in({26}), start, {1, false});
  const double year = week * 365.2425 / 7;
  CHECK(fresh.years[0].low < 1.5 * 100 * year / good);
  CHECK(fresh.years[0].high > 0.9 * 100 * year / bad);
  CHECK(fresh.effective_worlds == Approx(2).epsilon(1e-12));
}

TEST_CASE("a plan of too few effective worlds stops, and its other numbers do not depend on the threads") {
  const std::map<std::string, LifeTable> tables{{"d", weibull(2.5, {2000, 4000, 8000})},
                                                {"e", weibull(1.5, {3000, 5000, 6000})}};
  Fleet fleet = fleet_of({20, 30, 40, 20}, 1, 6);
  fleet.rows[1].duty = fleet.rows[3].duty = "e", fleet.rows[2].unplanned_cost = 9;
  CHECK(rows_of_policies(fleet) == std::vector<std::vector<std::size_t>>{{0}, {2}, {1, 3}});
  PlanRule rule{0.1, true};
  const auto plan_with = [&](const char* threads) {
    ::setenv("DRESSLIFE_THREADS", threads, 1);
    const Plan plan = plan_of(fleet, tables, windows_in({4, 14}), start, rule);
    ::unsetenv("DRESSLIFE_THREADS");
    return plan;
  };
  const Plan one = plan_with("1"), three = plan_with("3");
  CHECK(one.cost == three.cost);
  CHECK(one.failures_in_week == three.failures_in_week);
  CHECK(one.reach_their_age == three.reach_their_age);
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    CHECK(one.rows[i].window == three.rows[i].window);
    CHECK(one.rows[i].fails_before == three.rows[i].fails_before);
  }
  rule.enough_worlds = one.effective_worlds * 1.01;
  const Plan stopped = plan_with("1");
  CHECK(stopped.effective_worlds == one.effective_worlds);
  CHECK(stopped.rows.empty());
  rule.enough_worlds = one.effective_worlds * 0.99;
  CHECK(plan_with("1").rows.size() == 4);
}

TEST_CASE("survivors are weighed by the law of the lives, not by the chance of the few samples of a world") {
  // log10 of a life is normal: of the median of a world, and within a world. 64 lives of each world are known.
  constexpr double median = 7500, of_worlds = 0.3, within = 0.32, age = 60 * week, later = 120 * week;
  constexpr int dresspacks = 200;
  const auto alive = [](double hours, double z) {
    return 0.5 * std::erfc((std::log10(hours / median) - of_worlds * z) / within / std::sqrt(2.0));
  };
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  LifeTable table{2000, 64, {}, 40000, week};
  for (std::size_t w = 0; w < table.worlds; ++w) {
    const double z = normal(random);
    std::vector<float> lives;
    for (std::size_t d = 0; d < table.draws; ++d)
      lives.push_back(static_cast<float>(median * std::pow(10, of_worlds * z + within * normal(random))));
    std::sort(lives.begin(), lives.end());
    table.hours.insert(table.hours.end(), lives.begin(), lives.end());
  }
  double fails = 0, all = 0;  // sums over z, by the law
  for (double z = -6; z < 8; z += 0.01) {
    const double weight = std::exp(-z * z / 2) * std::pow(alive(age, z), dresspacks);
    fails += weight * (1 - alive(later, z) / alive(age, z)), all += weight;
  }
  remove_chance(table);
  const Plan plan = plan_of(fleet_of(many(dresspacks, 60)), {{"d", table}}, windows_in({60}), start, {1, false});
  // About 100 worlds have weight, and the number of failures differs by half between them: four standard errors.
  CHECK(plan.rows[0].fails_before_first == Approx(fails / all).epsilon(0.2));
}

TEST_CASE("survivors that the model hardly expects are named, and an age that no sample reaches is no safe one") {
  // One world, a constant failure rate: the probability that eight survive is S(a)^8.
  constexpr double mean = 1000, age = 10 * week;
  const Fleet eight = fleet_of(many(8, 10));
  const Plan plan = plan_of(eight, {{"d", weibull(1, {mean})}}, windows_in({10}), start, {1, false});
  CHECK(plan.reach_their_age == Approx(std::exp(-age / mean)).epsilon(1e-3));
  CHECK(plan.all_alive == Approx(std::exp(-8 * age / mean)).epsilon(8e-3));
  CHECK(plan_words(eight, plan).find("unlikely by the model: 1 of 270 such plants") != std::string::npos);
  const Fleet one = fleet_of({1});
  CHECK(plan_words(one, plan_of(one, {{"d", weibull(1, {mean})}}, windows_in({10}), start, {1, false}))
            .find("unlikely") == std::string::npos);
  // A calibration that already includes them, under which none of 64 survives so long.
  PlanRule counted{0.1, false};
  counted.knows_survivors = true;
  const Plan past = plan_of(fleet_of({300}), {{"d", weibull(2, {mean}, 64)}}, windows_in({10, 20}), start, counted);
  CHECK(past.reach_their_age == 0);
  CHECK(doubtful_ages(fleet_of({300}), past).size() == 1);
  CHECK(doubtful_ages(eight, plan).empty());
  // One of 400 has an age that one in 4,500 reaches, and one that one in 150 reaches.
  const auto old_one = [&](int weeks) {
    std::vector<int> ages = many(400, 1);
    ages[7] = weeks;
    const Fleet fleet = fleet_of(ages);
    return doubtful_ages(fleet, plan_of(fleet, {{"d", weibull(1, {mean})}}, windows_in({10}), start, counted));
  };
  REQUIRE(old_one(120).size() == 1);
  CHECK(old_one(120)[0].line().find("'r7' has run 8,400 h") != std::string::npos);
  CHECK(old_one(72).empty());
  CHECK(past.rows[0].fails_before_first == 1);
  CHECK(past.rows[0].fails_in_week[0] == 1);
  CHECK(past.failures_in_week[0] == Approx(1).margin(0.1));  // plus some of the new ones
}

TEST_CASE("a dresspack that ran longer than its robot's life is doubted") {
  std::map<std::string, LifeTable> tables{{"d", weibull(1, {40000})}};
  const Fleet fleet = fleet_of({5, 60, 70});  // at most 4,900 h
  const Plan plan = plan_of(fleet, tables, windows_in({10}), start, {0.1, false});
  tables.at("d").robot_life_hours = 5000;
  CHECK(doubtful_hours(fleet, plan, tables).empty());
  tables.at("d").robot_life_hours = 4000;
  const std::vector<Warning> warnings = doubtful_hours(fleet, plan, tables);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words, Catch::Contains("ran 4,200 h until ") &&
                                    Catch::Contains("(limit 4,000 h: the robot's life) (and 1 more)"));
  tables.at("d").robot_life_hours = 0;  // a test rig
  CHECK(doubtful_hours(fleet, plan, tables).empty());
}

TEST_CASE("the damage of earlier duties adds up in each draw") {
  LifeTable now{1, 2, {2000, 8000}, 40000, week}, before{1, 2, {1000, 4000}, 40000, week},
      never{1, 2, {INFINITY, INFINITY}, 40000, week};
  now.of_draw = {8000, 2000};  // the sample with the longer life now had the shorter life before
  before.of_draw = {1000, 4000};
  const std::map<std::string, LifeTable> tables{{"d", now}, {"before", before}, {"never", never}};
  Fleet fleet = fleet_of({0});
  const auto lives = [&](const std::string& duty, std::vector<Installed::Spell> spells) {
    fleet.rows[0].duty = duty, fleet.rows[0].before = std::move(spells);
    return first_lives(fleet, tables).front()->hours;
  };
  CHECK(lives("d", {}) == now.hours);
  CHECK(lives("d", {{"before", 500}}) == std::vector<float>{500 + 7 * 2000 / 8, 500 + 8000 / 2});
  CHECK(lives("d", {{"before", 1500}}) == std::vector<float>{1000, 1500 + 5 * 2000 / 8});  // one has failed before
  CHECK(lives("d", {{"before", 250}, {"never", 3000}, {"before", 250}}) ==
        std::vector<float>{3500 + 7 * 2000 / 8, 3500 + 8000 / 2});
  CHECK(lives("never", {{"before", 1500}}) == std::vector<float>{1000, INFINITY});
}

TEST_CASE("a history counts as hours of today's duty that wear a dresspack as much") {
  // Under the hard duty every life is a quarter.
  std::map<std::string, LifeTable> tables{{"d", weibull(2.5, {4000, 8000})}, {"hard", weibull(2.5, {1000, 2000})}};
  tables.at("hard").hours_per_week = 2 * week;
  DutyFile file;
  file.duties.resize(2);
  Duty &d = file.duties[0], &hard = file.duties[1];
  d.name = "d", hard.name = "hard";
  // expected: hours of today's duty alone that the same share of dresspacks reaches.
  const auto check = [&](std::vector<PastDuty> history, std::size_t warned, const std::array<double, 2>& expected) {
    d.history = std::move(history);
    Fleet fleet = fleet_of({20, 4});
    fleet.rows[1].hours_per_week = 35;
    CHECK(add_histories(fleet, file, tables, start).size() == warned);
    CHECK(*fleet.rows[0].run_hours >= 20 * week);
    CHECK(*fleet.rows[1].run_hours == Approx(4 * 35));
    const auto lives = first_lives(fleet, tables);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t w = 0; w < 2; ++w)
        CHECK(lives[i]->alive(w, *fleet.rows[i].run_hours) ==
              Approx(tables.at("d").alive(w, expected[i])).margin(6e-5));  // one of 20,000
  };
  PastDuty hours, days;
  hours.duty = days.duty = "hard";
  hours.hours = 100;
  days.from = day_text(start - std::chrono::days(70)), days.to = day_text(start - std::chrono::days(15));
  check({hours}, 0, {20 * week - 100 + 4 * 100, 140 - 100 + 4 * 100});
  // 56 days. The second dresspack is 28 days old and was in use for 14 of them.
  check({days}, 0, {12 * week + 4 * 8 * 2 * week, 2 * 35 + 4 * 2 * 35});
  check({hours, days}, 0, {12 * week - 100 + 4 * (100 + 8 * 2 * week), 4 * 4 * 35});
  days.from = day_text(start - std::chrono::days(140)), days.to = day_text(start - std::chrono::days(1));  // all days
  check({days}, 0, {4 * 20 * 2 * week, 4 * 4 * 35});
  hours.hours = 200;  // more than the second one has run: all of its hours
  check({hours}, 1, {20 * week - 200 + 4 * 200, 4 * 140});
  hours.duty = "d";
  check({hours}, 1, {20 * week, 140});
}

TEST_CASE("what if: a dresspack that gets a harder duty keeps its damage, and the plant its worlds") {
  // Under the hard duty every life is half.
  const std::map<std::string, LifeTable> tables{{"d", weibull(2.5, {4000, 8000})},
                                                {"hard", weibull(2.5, {2000, 4000})}};
  const Fleet fleet = fleet_of({20, 20, 20});
  Fleet changed = fleet;
  changed.rows[1].duty = "hard";
  changed.rows.push_back({{}, "one more", "hard", start, {}, 0, 0});
  keep_ages(changed, fleet, tables, start, start);
  const PlanRule rule{0.1, false};
  const Plan plan = plan_of(fleet, tables, windows_in({4, 14}), start, rule);
  PlanRule same = rule;
  same.weights = plan.weights;
  const Plan other = plan_of(changed, tables, windows_in({4, 14}), start, same);
  CHECK(other.rows[0].age_hours == plan.rows[0].age_hours);
  CHECK(other.rows[0].fails_before_first == plan.rows[0].fails_before_first);
  CHECK(other.rows[1].age_hours == Approx(plan.rows[1].age_hours).epsilon(1e-9));
  CHECK(other.rows[3].age_hours == 0);
  // The remaining life is half: four weeks have the failures that otherwise eight have.
  const Plan later = plan_of(fleet, tables, windows_in({8, 28}), start, rule);
  CHECK(other.rows[1].fails_before_first == Approx(later.rows[1].fails_before_first).margin(4e-4));  // 20,000 draws
  CHECK(other.weights == plan.weights);
  const std::string words = what_if_words("other", fleet, plan, changed, other);
  CHECK(words.starts_with("What if other were the fleet\n"));
  CHECK(words.find("dresspacks                                             3                     4           + 1\n") !=
        std::string::npos);
  const std::vector<BesideRow> beside = beside_rows(fleet, plan, changed, other);
  const auto failures = [](const Plan& of) {
    double sum = 0;
    for (const YearOfPlan& year : of.years) sum += year.unplanned;
    return sum;
  };
  CHECK(std::stod(beside[2].more.substr(2)) ==
        Approx(std::abs(failures(other) - failures(plan))).epsilon(0.05));  // two digits
  CHECK(beside[2].more[0] == (failures(other) > failures(plan) ? '+' : '-'));
  CHECK(words.find("one more: ") != std::string::npos);
  CHECK(words.find("(not in today's fleet)") != std::string::npos);
  // Sums in another order differ by rounding only, which is no difference.
  Plan reordered = other;
  for (YearOfPlan& year : reordered.years) year.unplanned *= 1 + 1e-15;
  const std::vector<BesideRow> no_change = beside_rows(changed, other, changed, reordered);
  CHECK(std::ranges::all_of(no_change, [](const BesideRow& row) { return row.more == "0"; }));
  // The same fleet again changes nothing.
  Fleet unchanged = fleet;
  keep_ages(unchanged, fleet, tables, start, start);
  CHECK(what_if_words("other", fleet, plan, unchanged, plan_of(unchanged, tables, windows_in({4, 14}), start, same))
            .find("Replaced at another time than in the plan of today's fleet: none") != std::string::npos);
}

TEST_CASE("what if from a later day: until then a dresspack wears as before, then as under its new duty") {
  constexpr double shape = 2.5, scale = 4000, hard_scale = 1000;
  std::map<std::string, LifeTable> tables{{"d", weibull(shape, {scale})}, {"hard", weibull(shape, {hard_scale})}};
  tables.at("hard").hours_per_week = 2 * week;
  const Fleet fleet = fleet_of({20, 20});
  Fleet changed = fleet;
  changed.rows[1].duty = "hard";
  keep_ages(changed, fleet, tables, start, start + std::chrono::days(7 * 6));
  const Plan plan = plan_of(changed, tables, windows_in({4, 14}), start, {0.99, false});
  // The law in hours of the old duty. A week of the new duty counts as eight of the old.
  const auto alive = [&](double weeks) {
    return std::exp(-std::pow((20 + std::min(weeks, 6.0) + 8 * std::max(0.0, weeks - 6)) * week / scale, shape));
  };
  const double draws = 2e-4;  // of 20,000 lives, some at a border
  CHECK(plan.rows[1].fails_before_first == Approx(1 - alive(4) / alive(0)).margin(draws));
  CHECK(plan.rows[1].fails_until_next[0] == Approx(1 - alive(14) / alive(4)).margin(draws));
  CHECK(plan.rows[1].fails_before_first == Approx(plan.rows[0].fails_before_first).margin(draws));
  for (const std::size_t of : {0, 5, 6, 12})
    CHECK(plan.rows[1].fails_in_week[of] ==
          Approx((alive(double(of)) - alive(double(of) + 1)) / alive(0)).margin(draws));
  // Simulated plants: the failures of 24 weeks, of which later dresspacks have only a few. 4 deviations of 1,000 plants.
  double unplanned = 0;
  for (const YearOfPlan& year : plan.years) unplanned += year.unplanned;
  CHECK(std::accumulate(plan.failures_in_week.begin(), plan.failures_in_week.end(), 0.0) ==
        Approx(unplanned).margin(4 * std::sqrt(unplanned / 1000)));
  tables.emplace("never", weibull(shape, {INFINITY}));
  changed.rows[1].duty = "never", changed.rows[1].before.clear(), changed.rows[1].change.reset();
  keep_ages(changed, fleet, tables, start, start + std::chrono::days(7 * 6));
  const Plan saved = plan_of(changed, tables, windows_in({6, 14}), start, {0.99, false});
  CHECK(saved.rows[1].fails_before_first == Approx(1 - alive(6) / alive(0)).margin(draws));
  CHECK(saved.rows[1].fails_until_next[0] == Approx(0).margin(draws));  // the last life is spread to both of its sides
  // Also dresspacks installed before the change: at constant failure rates, 1 in 10 weeks, then 4, the plants have equal numbers.
  std::map<std::string, LifeTable> constant{{"d", weibull(1, {10 * week})}, {"hard", weibull(1, {5 * week})}};
  constant.at("hard").hours_per_week = 2 * week;
  const Fleet young = fleet_of({0});
  Fleet harder = young;
  harder.rows[0].duty = "hard";
  keep_ages(harder, young, constant, start, start + std::chrono::days(7 * 6));
  double failures = 0;
  for (const YearOfPlan& year : plan_of(harder, constant, windows_in({4, 14}), start, {1, false}).years)
    failures += year.unplanned;
  const double expected = 6 * 0.1 + 18 * 0.4;
  CHECK(failures == Approx(expected).margin(4 * std::sqrt(expected / 1000)));
}

TEST_CASE("what if from a later day: each part of the plan has the replacements and the cost of its own duty") {
  constexpr double shape = 4, scale = 6000, planned = 1, unplanned = 10, harder = 4;
  constexpr int change = 150, end = 300;  // [weeks]
  const std::map<std::string, LifeTable> tables{{"d", weibull(shape, {scale}, 4000)},
                                                {"hard", weibull(shape, {scale / harder}, 4000)}};
  // The least cost per hour of age replacement, by brute force over ages of an hour.
  double least = std::numeric_limits<double>::infinity(), running = 0;
  for (double age = 1; age < 2 * scale; ++age) {
    const double lives = std::exp(-std::pow(age / scale, shape));
    running += std::exp(-std::pow((age - 0.5) / scale, shape));
    least = std::min(least, (planned * lives + unplanned * (1 - lives)) / running);
  }
  std::vector<int> weeks(end - 1);
  std::iota(weeks.begin(), weeks.end(), 1);
  std::vector<int> ages(20);  // so that replacements are spread over all weeks
  std::iota(ages.begin(), ages.end(), 0);
  for (const bool to_hard : {true, false}) {
    const char *const before = to_hard ? "d" : "hard", *const after = to_hard ? "hard" : "d";
    Fleet fleet = fleet_of(ages, planned, unplanned);
    for (Installed& row : fleet.rows) row.duty = before;
    Fleet changed = fleet;
    for (Installed& row : changed.rows) row.duty = after;
    keep_ages(changed, fleet, tables, start, start + std::chrono::days(7 * change));
    const Plan plan = plan_of(changed, tables, windows_in(weeks), start, {0.1, true});
    const double hours = double(ages.size()) * week, expected = least * hours * (change + harder * (end - change));
    const double of_hard_first = least * hours * (harder * change + (end - change));
    INFO(before << " then " << after);
    // The last life of each dresspack is not at its end; 20 to 100 lives each.
    CHECK(plan.cost == Approx(to_hard ? expected : of_hard_first).epsilon(0.1));
    // Before the change today's dresspacks are replaced at the ages of the unchanged plan.
    const Plan now = plan_of(fleet, tables, windows_in(weeks), start, {0.1, true});
    for (std::size_t k = 0; k < ages.size(); ++k)
      if (now.rows[k].window && *now.rows[k].window + 2 < change) {
        REQUIRE(plan.rows[k].window);
        CHECK(std::abs(double(*plan.rows[k].window) - double(*now.rows[k].window)) <= 2);  // the cost is flat there
      }
    // 1,000 simulated plants: the smaller number has an error of 3 %
    CHECK(plan.years[1].planned == Approx(now.years[1].planned).epsilon(0.1));
    CHECK(plan.years[1].unplanned == Approx(now.years[1].unplanned).epsilon(0.1));
  }
}

TEST_CASE("a fleet is read from a spreadsheet's table, and what is wrong in it is named at its cell") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    scratch.write("fleet.csv", text);
    return read_fleet(scratch / "fleet.csv", start);
  };
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Fleet fleet = read(
      "name;duty;installed;hours_per_week;planned_cost;unplanned_cost\nr 1;day;2025-02-28;100;5;50\nr 2;day;;;5;50\n");
  REQUIRE(fleet.rows.size() == 2);
  CHECK(day_text(fleet.rows[0].since) == "2025-02-28");
  CHECK(fleet.rows[0].hours_per_week == 100.0);
  CHECK(fleet.rows[1].since == start);
  CHECK(fleet.has_costs);
  CHECK(refusal("name,duty,installed\nr,day,2025-2-3\n").find("'2025-2-3' is no date; write 2025-02-03") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2025-02-30\n").find("fleet.csv:2:7: error: '2025-02-30' is no date") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2025-2-3\n").find("'2025-2-3' is no date; write 2025-02-03") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2025-02-30\n").find("as in 2027-07-12 (2025-02 has 28 days)") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,31.02.2025\n").find("(2025-02 has 28 days)") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2025-28-02\n").find("(a year has 12 months)") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,soon\n").find("write YYYY-MM-DD") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,28/02/2025\n").find("write 2025-02-28") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2/3/2025\n")
            .find("2025-03-02 if the day comes first, 2025-02-03 if the month does") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,45716\n").find("write 2025-02-28 if that is the number of a spreadsheet") !=
        std::string::npos);
  CHECK(refusal("name,installed,duty\nr,2025-02-28,day\n").find("exchange the titles") == std::string::npos);
  CHECK(refusal("name,duty,installed\nr,2025-02-28,day\n").find("exchange the titles") != std::string::npos);
  CHECK(refusal("name;duty;installed;hours_per_week\nr;day;;37,500\n").find("write 37500 or 37.500") !=
        std::string::npos);
  const std::string costs = "name;duty;installed;planned_cost;unplanned_cost\nr;day;;";
  CHECK(read(costs + "1.200,50;9500\n").rows[0].planned_cost == 1200.5);
  CHECK(read(costs + "1,200.50;9500\n").rows[0].planned_cost == 1200.5);
  CHECK(read(costs + "1200;1.234.567,89\n").rows[0].unplanned_cost == 1234567.89);
  CHECK(read("name;duty;installed;Ausbau\nr;day;01.02.2025;\n").rows.size() == 1);
  CHECK(refusal("name;duty;installed;Ausbau\nr;day;01.02.2025;01.02.2026\n")
            .find("fleet.csv:2:18: error: a dresspack that is in use no more (Ausbau: 01.02.2026)") !=
        std::string::npos);
  CHECK(refusal(costs + "1200;9.500\n")
            .find("fleet.csv:2:13: error: unplanned_cost is '9.500', in which the point may separate "
                  "thousands; write 9500 or 9.5") != std::string::npos);
  CHECK(read(costs + "0.125;9.50\n").rows[0].unplanned_cost == 9.5);
  CHECK(read(costs + "1200,5;1234.500\n").rows[0].unplanned_cost == 1234.5);
  const Fleet german =
      read("name;duty;installed;hours_per_week\nr;day;28.02.2025 08:00;37,5\n");  // in the form that `calibrate` reads
  CHECK(day_text(german.rows[0].since) == "2025-02-28");
  CHECK(german.rows[0].hours_per_week == 37.5);
  const Fleet titles =
      read("Roboter;Einsatz;Einbaudatum;Wochenstunden;Kosten geplant;Kosten ungeplant\nr;day;28.02.2025;37,5;5;50\n");
  CHECK(titles.rows[0].name == "r");
  CHECK(day_text(titles.rows[0].since) == "2025-02-28");
  CHECK(titles.rows[0].hours_per_week == 37.5);
  CHECK(titles.rows[0].unplanned_cost == 50);
  CHECK(titles.renamed.size() == 6);
  CHECK(titles.renamed[2] == "installed = 'Einbaudatum'");
  CHECK(read("name,duty,installed,robot\nr,day,,A\n").unused == std::vector<std::string>{"robot"});
  CHECK(
      refusal("Roboter,Schlauchpaket,duty,installed\nr,A,day,\n")
          .find("fleet.csv:1:9: error: columns 'Roboter' and 'Schlauchpaket' both mean name; title one of them name") !=
      std::string::npos);
  CHECK(refusal("name,duty,instaled\nr,day,\n").find("did you mean 'installed'?") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,2027-01-01\n").find("after today") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,\nr,day,\n").find("is the name of line 2, too") != std::string::npos);
  CHECK(refusal("name,duty\nr,day\n").find("no column 'installed'") != std::string::npos);
  CHECK(refusal("name,duty,installed,hours\nr,day,,3\n").find("unknown column 'hours'") != std::string::npos);
  CHECK(refusal("name,duty,installed,hours_so_far\nr,day,,3\n").find("for an hour counter give hours_per_week") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed,Kosten\nr,day,,3\n")
            .find("unknown column 'Kosten'; columns: name, duty, installed") != std::string::npos);
  CHECK(read("Name;Duty;Installed;Hours per week\nr;day;;80,5\n").rows[0].hours_per_week ==
        std::optional<double>(80.5));
  CHECK(refusal("name,duty,installed,planned_cost\nr,day,,3\n").find("no column 'unplanned_cost'") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed,planned_cost,unplanned_cost\nr,day,,3,2\n").find("must be larger") !=
        std::string::npos);
  CHECK(refusal("name,duty,installed,hours_per_week\nr,day,,200\n").find("must be 0.1 .. 168") != std::string::npos);
  const std::string all =
      refusal("name,duty,installed,hours_per_week\nr,day,soon,300\n,day,,\nr,day,,\n");  // all rows at once
  for (const char* line : {":2:7: error: 'soon' is no date", ":2:12: error: hours_per_week is '300'",
                           ":3:1: error: name is empty", ":4:1: error: 'r' is the name of line 2, too"})
    CHECK_THAT(all, Catch::Contains(line));
  CHECK(read("Name,DUTY,Installed,Plant area,Note\nr,day,2025-02-28,hall 3,\n").unused ==
        std::vector<std::string>{"Plant area", "Note"});
  CHECK(refusal("name,duty,installed\n").find("no row") != std::string::npos);
  CHECK(refusal("name,duty,installed,\nr,day,,\n").find("a column has no title; give it one") != std::string::npos);
  CHECK(refusal("name,duty,installed\nr,day,\nT\xfcr,day,\n").find("fleet.csv:3: error: is no text in UTF-8") !=
        std::string::npos);
  CHECK(read("\xEF\xBB\xBFname,duty,installed\r\nT\xc3\xbcr,day,\r\n").rows[0].name == "T\xc3\xbcr");
  CHECK(refusal(std::string("\xff\xfen\0a\0m\0", 8)).find("fleet.csv:1: error: is no text in UTF-8") !=
        std::string::npos);
}

TEST_CASE("a plan states why a dresspack is in no window") {
  const auto words = [](const LifeTable& life, const Fleet& fleet, PlanRule rule) {
    return kept_words(fleet, plan_of(fleet, {{"d", life}}, windows_in({2, 10}), start, rule));
  };
  const std::string safe = words(weibull(3, {20000}), fleet_of({4}), {0.1, false});
  CHECK_THAT(safe, Catch::Contains("is at most 0.0") && Catch::Contains("(limit 10 %): r0") &&
                       Catch::Contains("replaced at once"));
  CHECK_THAT(words(weibull(0.6, {4000}), fleet_of({4}), {0.01, false}),
             Catch::Contains("fails as often or more often in this") && Catch::Contains("time: r0."));
  CHECK_THAT(words(weibull(0.6, {4000}), fleet_of({4}, 1, 6), {0.1, true}), Catch::Contains("costs less, on average"));
  CHECK(words(weibull(3, {1000}), fleet_of({10}), {0.1, false}).empty());
  const std::vector<int> many(25, 4);
  CHECK_THAT(words(weibull(3, {20000}), fleet_of(many), {0.1, false}),
             Catch::Contains("r19") && !Catch::Contains("r20") && Catch::Contains("and 5 more in the table."));
}

TEST_CASE("a plan states the probability of failure before the first window beside that between windows") {
  // 38 weeks until the first window, then two weeks between windows
  const Fleet fleet = fleet_of({100});
  const Plan plan = plan_of(fleet, {{"d", weibull(3, {20000})}}, windows_in({38, 40}), start, {0.1, false});
  const RowPlan& row = plan.rows[0];
  REQUIRE_FALSE(row.window);
  const double between = std::max(row.fails_until_next[0], row.fails_until_next[1]);
  CHECK(row.fails_before_first > 5 * between);
  CHECK(in_one_line(kept_words(fleet, plan))
            .find("Before the first window, when no replacement is planned, the probability of failure is at most " +
                  percent_text(row.fails_before_first) + ". After that, until " + day_text(plan.end) +
                  ", the probability between two windows is at most " + percent_text(between) + " (limit 10 %): r0.") !=
        std::string::npos);
}

TEST_CASE("a plan counts in each window also the replacements of dresspacks that are put in after today") {
  const Fleet fleet = fleet_of(many(30, 60));
  const std::map<std::string, LifeTable> tables{{"d", weibull(3, {5000})}};
  const Plan plan = plan_of(fleet, tables, windows_in({4, 30}), start, {0.05, false});
  // Today's are replaced in the first window. After 26 weeks the new ones fail in the next interval with 34 % and are replaced.
  REQUIRE(plan.later_in_window.size() == 2);
  double planned = 0, todays = 0;
  for (const YearOfPlan& year : plan.years) planned += year.planned;
  for (const RowPlan& row : plan.rows) todays += 1 - row.fails_before;
  CHECK(plan.later_in_window[1] > 25);
  // 4 deviations of 1,000 plants: of each, about 2 dresspacks
  CHECK(todays + plan.later_in_window[0] + plan.later_in_window[1] == Approx(planned).margin(4 * 2 / std::sqrt(1000)));
  const std::string later = readable(plan.later_in_window[1], 2),
                    of_window = "none of today's dresspacks; on average " + later + " of those put in after today";
  CHECK(plan_words(fleet, plan).find("2027-06-21 .. 2027-06-21: " + of_window + "\n") != std::string::npos);
  const std::string calendar = plan_calendar(fleet, plan);
  CHECK(calendar.find("SUMMARY:Replace on average " + later + " dresspacks put in after 2026-11-23\r\n") !=
        std::string::npos);
  CHECK(calendar.find("No dresspack") == std::string::npos);
  const std::string beside = what_if_words("other", fleet, plan, fleet, plan);
  const auto line = [&](const std::string& what, const std::string& number) {
    std::string text = what + std::string(34 - what.size(), ' ');
    for (int k = 0; k < 2; ++k) text += "  " + std::string(20 - number.size(), ' ') + number;
    return text;
  };
  CHECK(beside.find(line("today's replaced from 2027-06-21", "0") + "             0\n" +
                    line("put in after today, on average", later)) != std::string::npos);
  // Without such replacements a window is empty.
  const Plan empty = plan_of(fleet, tables, windows_in({4, 8}), start, {0.05, false});
  CHECK(plan_words(fleet, empty).find("2027-01-18 .. 2027-01-18: nothing to replace\n") != std::string::npos);
  CHECK(plan_calendar(fleet, empty).find("SUMMARY:No dresspack to replace\r\n") != std::string::npos);
}

TEST_CASE("what if: a dresspack with another window has both windows, each with the name of its plan") {
  const Fleet fleet = fleet_of({60});
  const std::map<std::string, LifeTable> tables{{"d", weibull(3, {5000})}, {"gentle", weibull(3, {1e6})}};
  Fleet changed = fleet;
  changed.rows[0].duty = "gentle";
  const Plan plan = plan_of(fleet, tables, windows_in({4, 30}), start, {0.05, false});
  const Plan other = plan_of(changed, tables, windows_in({4, 30}), start, {0.05, false});
  CHECK(what_if_words("other", fleet, plan, changed, other)
            .find("Replaced at another time than in the plan of today's fleet: 1\n  r0: in no window (today's fleet: "
                  "from 2026-12-21)\n") != std::string::npos);
}

TEST_CASE("windows are days in order, after today") {
  const std::vector<Window> windows = windows_from("2027-07-12..2027-08-01,2027-12-20", start);
  REQUIRE(windows.size() == 2);
  CHECK(day_text(windows[0].last) == "2027-08-01");
  CHECK(windows[1].first == windows[1].last);
  CHECK(day_text(windows_from("12.07.2027..01.08.2027", start)[0].last) == "2027-08-01");
  CHECK(day_text(windows_from("2027-07-12 .. 2027-08-01, 2027-12-20", start)[1].first) == "2027-12-20");
  for (const char* wrong : {"", "2027-07-12..", "2027-13-01", "2027-08-01..2027-07-12", "2026-11-23",
                            "2027-07-12..2027-08-01,2027-08-01", "2027-07-12,", "soon", "2027-07-12 - 2027-08-01"})
    CHECK_THROWS_AS(windows_from(wrong, start), InputError);
}

TEST_CASE("the calendar has an event for each window with work, in lines of 75 bytes") {
  const Fleet fleet = fleet_of(many(30, 60));
  const Plan plan = plan_of(fleet, {{"d", weibull(3, {5000})}}, windows_in({4, 8}), start, {0.05, false});
  const std::string calendar = plan_calendar(fleet, plan);
  CHECK(calendar.find("SUMMARY:Replace 30 dresspacks\r\n") != std::string::npos);
  CHECK(calendar.find("DTSTART;VALUE=DATE:20261221\r\nDTEND;VALUE=DATE:20261222\r\n") != std::string::npos);
  CHECK(calendar.find(
            "DTSTART;VALUE=DATE:20270118\r\nDTEND;VALUE=DATE:20270119\r\nSUMMARY:No dresspack to replace\r\n") !=
        std::string::npos);
  std::size_t begin = 0;
  for (std::size_t end; (end = calendar.find("\r\n", begin)) != std::string::npos; begin = end + 2)
    CHECK(end - begin <= 75);
  CHECK(begin == calendar.size());
  CHECK(csv_text(plan_table(fleet, plan)).starts_with("name,duty,installed,age_hours,"));
  const auto uid = [](const std::string& of) {
    return of.substr(of.find("UID:"), of.find("DTSTAMP") - of.find("UID:"));
  };
  Fleet other = fleet;
  other.rows.back().name = "a, b; c";
  CHECK(uid(plan_calendar(other, plan)) == uid(calendar));  // another plan of the same plant
  CHECK(plan_calendar(other, plan).find("a\\, b\\; c") != std::string::npos);
  other.rows.front().name = "of another plant";
  CHECK(uid(plan_calendar(other, plan)) != uid(calendar));
}

TEST_CASE("a plant of unlike dresspacks has the plan of each alone, if the worlds are given") {
  const std::map<std::string, LifeTable> tables{{"a", weibull(3, {4000, 6000}, 2000)},
                                                {"b", weibull(1.5, {9000, 3000}, 2000)},
                                                {"hard", weibull(2, {400, 300}, 2000)}};
  Fleet fleet = fleet_of({5, 40, 25, 12, 33}, 1, 6);
  for (const auto& [row, duty, planned, unplanned] : std::vector<std::tuple<std::size_t, const char*, double, double>>{
           {1, "a", 2, 7}, {2, "b", 1, 30}, {3, "a", 1, 8}, {4, "b", 3, 9}})
    fleet.rows[row].duty = duty, fleet.rows[row].planned_cost = planned, fleet.rows[row].unplanned_cost = unplanned;
  fleet.rows[0].duty = "a", fleet.rows[1].hours_per_week = 30, fleet.rows[4].hours_per_week = 110;
  fleet.rows[1].before = {{"hard", 20}};
  fleet.rows[3].run_hours = 100, fleet.rows[3].before = {{"b", 10}, {"hard", 600}},
  fleet.rows[3].change = {{100, 5}};  // hard for 100 days more
  for (const bool by_cost : {false, true}) {
    PlanRule rule{0.1, by_cost};
    rule.weights = {0.3, 0.7};
    const std::vector<Window> windows = windows_in({4, 14, 40});
    const Plan plan = plan_of(fleet, tables, windows, start, rule);
    double cost = 0, without = 0, planned = 0, unplanned = 0;
    std::vector<double> failures(plan.failures_in_week.size(), 0.0), bare = failures;
    std::size_t kinds = 0;
    for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
      Fleet alone = fleet;
      alone.rows = {fleet.rows[i]};
      const Plan one = plan_of(alone, tables, windows, start, rule);
      const RowPlan &row = plan.rows[i], &own = one.rows[0];
      CHECK(row.age_hours == own.age_hours);
      CHECK(row.fails_before_first == own.fails_before_first);
      CHECK(row.fails_in_week == own.fails_in_week);
      CHECK(row.fails_until_next == own.fails_until_next);
      CHECK(row.fails_before == own.fails_before);
      CHECK(row.reach_its_age == own.reach_its_age);
      CHECK(row.window == own.window);
      kinds |= std::size_t{1} << row.window.value_or(3);
      cost += one.cost, without += one.cost_without_windows;
      for (const YearOfPlan& year : one.years) planned += year.planned, unplanned += year.unplanned;
      for (std::size_t week = 0; week < failures.size(); ++week)
        failures[week] += one.failures_in_week[week], bare[week] += one.failures_in_week_without_windows[week];
    }
    CHECK(kinds != 1);  // they are replaced in different windows
    // Five dresspacks have 10,000 simulated plants. The cost of a plant is at most a hundred, with a deviation below 30: 0.3 of the mean, and
    // 4.5 of these.
    const double of_cost = 4.5 * 0.3;
    CHECK(plan.cost == Approx(cost).margin(of_cost));
    CHECK(plan.cost_without_windows == Approx(without).margin(of_cost));
    double all_planned = 0, all_unplanned = 0;
    for (const YearOfPlan& year : plan.years) all_planned += year.planned, all_unplanned += year.unplanned;
    constexpr double of_count = 4.5 * 0.03;  // the deviation of a plant's count is below 3
    CHECK(all_planned == Approx(planned).margin(of_count));
    CHECK(all_unplanned == Approx(unplanned).margin(of_count));
    CHECK(std::accumulate(plan.failures_in_week.begin(), plan.failures_in_week.end(), 0.0) ==
          Approx(std::accumulate(failures.begin(), failures.end(), 0.0)).margin(of_count));
    CHECK(std::accumulate(plan.failures_in_week_without_windows.begin(), plan.failures_in_week_without_windows.end(),
                          0.0) == Approx(std::accumulate(bare.begin(), bare.end(), 0.0)).margin(of_count));
  }
}

TEST_CASE("a plan does not depend on the order of its rows") {
  const std::map<std::string, LifeTable> tables{{"a", weibull(3, {4000, 6000}, 2000)},
                                                {"b", weibull(1.5, {900, 300}, 2000)}};
  Fleet fleet = fleet_of({5, 40, 25, 12, 33}, 1, 6);
  for (const std::size_t row : {1, 2}) fleet.rows[row].duty = "b";
  for (const std::size_t row : {0, 3, 4}) fleet.rows[row].duty = "a";
  Fleet reversed = fleet;
  std::reverse(reversed.rows.begin(), reversed.rows.end());
  const Plan one = plan_of(fleet, tables, windows_in({4, 14, 40}), start, {0.1, true});
  const Plan other = plan_of(reversed, tables, windows_in({4, 14, 40}), start, {0.1, true});
  CHECK(one.cost > 0);
  CHECK(one.cost < one.cost_without_windows);
  CHECK(other.cost == Approx(one.cost).epsilon(1e-9));  // sums in another order differ by rounding
  CHECK(other.cost_without_windows == Approx(one.cost_without_windows).epsilon(1e-9));
  for (std::size_t year = 0; year < one.years.size(); ++year)
    CHECK(other.years[year].unplanned == Approx(one.years[year].unplanned).epsilon(1e-9));
}

TEST_CASE("what if: survivors of a duty have not shown that they withstand a milder one") {
  // In each world one of the duties is the harder one. On average b is the milder one.
  const std::map<std::string, LifeTable> tables{{"a", weibull(3, {2000, 9000})}, {"b", weibull(3, {10000, 2500})}};
  Fleet now = fleet_of(many(20, 50), 1, 6), changed = now;
  for (Installed& row : now.rows) row.duty = "a";
  for (Installed& row : changed.rows) row.duty = "b";
  const Fleet always = changed;
  keep_ages(changed, now, tables, start, start);
  const std::vector<Window> windows = windows_in({20});
  const Plan stays = plan_of(now, tables, windows, start, {0.1, false});
  PlanRule rule{0.1, false};
  rule.weights = stays.weights;
  const auto first_failures = [](const Plan& plan) {
    double sum = 0;
    for (const RowPlan& row : plan.rows) sum += row.fails_before_first;
    return sum;
  };
  const double before = first_failures(stays), after = first_failures(plan_of(changed, tables, windows, start, rule));
  CHECK(stays.weights[1] > 0.99);  // twenty dresspacks survived 4,000 h, so the world is that of long lives under a
  CHECK(after > 2 * before);
  CHECK(first_failures(plan_of(always, tables, windows, start, {0.1, false})) < after);
  CHECK_THAT(what_if_words("other", now, stays, changed, plan_of(changed, tables, windows, start, rule)),
             Catch::Contains("not that it withstands another one"));
}
