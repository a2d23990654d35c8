// The best routings compared within the mounting tolerance (T1).
#include "pipeline/advise/improve/tolerance.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

Outcome outcome(double hours) {
  Outcome of;
  of.hours = hours;
  of.beyond.assign(outcome_limits, -1.0);
  if (hours == 0) of.failure = "too short";
  return of;
}

/// Returns a finalist with these lives under one deviation each. `runs` counts its runs.
Finalist finalist(double hours, std::vector<double> lives, int& runs) {
  Finalist of{outcome(hours), std::vector<Nudge>(lives.size()), {}};
  of.run = [lives, &runs](const std::vector<std::size_t>& numbers) {
    std::vector<Outcome> outcomes;
    for (const std::size_t k : numbers) outcomes.push_back(outcome(lives[k])), ++runs;
    return outcomes;
  };
  return of;
}

TEST_CASE("tolerance: the longest life in the worst place wins, not the longest as drawn") {
  int sharp = 0, blunt = 0, last = 0;
  const std::vector<Finalist> finalists{finalist(1000, {900, 60, 800, 700, 600, 500}, sharp),
                                        finalist(700, {650, 600, 690, 500, 640, 720}, blunt),
                                        finalist(450, {450, 450, 450, 450, 450, 450}, last)};
  const std::vector<WithinTolerance> judged = within_tolerance(finalists, outcome(100));
  REQUIRE(judged.size() == 2);  // the last has at most 450 h, less than the second within its tolerance
  CHECK(last == 0);
  CHECK(best_within(judged) == 1);
  CHECK(judged[0].worst.hours == 60);
  CHECK(judged[1].worst.hours == 500);
  CHECK(judged[1].nudges[0].share == Approx(650.0 / 700));
}

TEST_CASE("tolerance: each case has the share beyond limits at other values of the job as drawn") {
  int runs = 0;
  Finalist of = finalist(1000, {900, 800}, runs);
  Outcome as_it_is = outcome(1000);
  as_it_is.exceeding = of.drawn.exceeding = 0.05;
  of.run = [](const std::vector<std::size_t>& numbers) {
    std::vector<Outcome> outcomes(numbers.size(), outcome(900));
    for (Outcome& one : outcomes) one.exceeding = 0.5;  // known of full runs only
    return outcomes;
  };
  CHECK(within_tolerance({of}, as_it_is).front().worst.kept == Kept::modes);
}

TEST_CASE("tolerance: the job's own routing stays, unless another one is clearly better in lives and modes") {
  Outcome own = outcome(1e5), other = outcome(2e5);
  own.robot_life = other.robot_life = 40'000;
  own.modes = {{"jacket wear", 24'400}, {"abrasion", 18'700}};
  other.modes = {{"jacket wear", 6'850}};
  int runs = 0;
  const auto chosen = [&](const Outcome& with) {
    std::vector<Finalist> finalists{finalist(1e5, {}, runs), finalist(2e5, {}, runs)};
    finalists[0].drawn = with, finalists[1].drawn = own;
    return best_within(within_tolerance(finalists, own), 1);
  };
  CHECK(chosen(other) == 1);  // the jackets wear through earlier than anything of the own routing
  other.modes = {{"jacket wear", 23'000}};
  CHECK(chosen(other) == 0);  // 23,000 h to the first mode instead of 18,700 h
  other.modes = {{"jacket wear", 24'400}, {"abrasion", 19'000}};
  CHECK(chosen(other) == 1);  // 2 % is no difference
}

TEST_CASE("tolerance: the job's own routing is judged, whatever its place among the finalists") {
  int runs = 0;
  const std::vector<Finalist> finalists{finalist(1000, {995, 999}, runs), finalist(990, {400, 980}, runs),
                                        finalist(980, {400, 970}, runs), finalist(950, {940, 945}, runs)};
  CHECK(within_tolerance(finalists, outcome(950)).size() == 1);
  const std::vector<WithinTolerance> judged = within_tolerance(finalists, outcome(950), {}, 3);
  REQUIRE(judged.size() == 4);
  CHECK(judged[3].worst.hours == 950);  // its bound
  CHECK(best_within(judged, 3) == 3);   // 995 h are not clearly more
}

TEST_CASE("tolerance: of random finalists the winner is that of a whole evaluation, with fewer runs") {
  std::mt19937 random(7);
  std::lognormal_distribution<double> spread(0, 0.7);
  std::uniform_real_distribution<double> one(0, 1);
  int saved = 0, not_first = 0;
  for (int round = 0; round < 300; ++round) {
    constexpr std::size_t count = 3, nudges = 24;
    std::vector<Finalist> finalists;
    std::vector<double> worst;
    std::vector<double> drawn(count);
    for (double& hours : drawn) hours = 1000 * spread(random);
    std::sort(drawn.rbegin(), drawn.rend());
    int runs = 0;
    for (const double hours : drawn) {
      std::vector<double> lives(nudges);
      for (double& life : lives) life = one(random) < 0.02 ? 0 : hours * spread(random);
      worst.push_back(std::min(hours, *std::min_element(lives.begin(), lives.end())));
      finalists.push_back(finalist(hours, lives, runs));
    }
    std::vector<ToleranceCount> counts;
    const std::vector<WithinTolerance> judged =
        within_tolerance(finalists, outcome(1), [&](const ToleranceCount& of) { counts.push_back(of); });
    const WithinTolerance& best = judged[best_within(judged)];
    REQUIRE(best.whole);
    CHECK(best.worst.hours == *std::max_element(worst.begin(), worst.end()));
    CHECK(counts.back().done < counts.back().likely);
    CHECK(counts.back().done + counts.back().next == runs);
    CHECK(counts.back().likely >= runs);
    saved += static_cast<int>(count * nudges) - runs;
    not_first += best_within(judged) > 0;
  }
  CHECK(saved > 300 * 24);  // at least a third
  CHECK(not_first > 50);
}

TEST_CASE("tolerance: the nudge that costs one finalist most is the first of the others") {
  int runs = 0;
  std::vector<double> good(12, 900), bad(12, 900);
  good[9] = 700, bad[9] = 100;
  const std::vector<Finalist> finalists{finalist(1000, good, runs), finalist(999, bad, runs)};
  const std::vector<WithinTolerance> judged = within_tolerance(finalists, outcome(1));
  REQUIRE(judged.size() == 2);
  CHECK(judged[0].whole);
  CHECK(best_within(judged) == 0);
  CHECK(std::is_sorted(judged[1].numbers.begin(), judged[1].numbers.end()));
  const WithinTolerance original = within_tolerance(finalist(1000, bad, runs), outcome(1),
                                                    [](const Merit& worst) { return worst.hours < 700; }, judged, {});
  CHECK(original.numbers.size() == 4);
  CHECK(original.worst.hours == 100);
}

TEST_CASE("tolerance: one that falls behind is given up, and one that does not run is last") {
  int first = 0, second = 0;
  const std::vector<double> fails{900, 0, 900, 900, 900, 900, 900, 900, 900, 900, 900, 900};
  const std::vector<WithinTolerance> judged = within_tolerance(
      {finalist(1000, std::vector<double>(12, 800), first), finalist(950, fails, second)}, outcome(100));
  REQUIRE(judged.size() == 2);
  CHECK(second == 4);
  CHECK_FALSE(judged[1].whole);
  CHECK(judged[1].worst.kept == Kept::nothing);
  CHECK(judged[1].nudges[1].words == "too short");
  CHECK(best_within(judged) == 0);
}

/// A search over one angle: p10 rises toward a cliff, beyond which no job runs, and has a lower plateau on the other side.
Outcome at_angle(double degrees) {
  if (degrees > 80) return outcome(0);
  return outcome(degrees > 40 ? 10 * degrees : 500);
}

TEST_CASE(
    "tolerance: an optimum beside a cliff loses against a robust one, also where the first three stand at the cliff") {
  const auto at = [](double degrees) {
    std::vector<Nudge> nudges(2);
    Finalist of{at_angle(degrees), nudges, {}};
    of.run = [degrees](const std::vector<std::size_t>& numbers) {
      std::vector<Outcome> outcomes;
      for (const std::size_t k : numbers) outcomes.push_back(at_angle(degrees + (k == 0 ? -10 : 10)));
      return outcomes;
    };
    return of;
  };
  const std::vector<WithinTolerance> judged =
      within_tolerance({at(80), at(79), at(78), at(75), at(60), at(0)}, outcome(100));
  REQUIRE(judged.size() == 5);
  CHECK(best_within(judged) == 4);  // 600 h without deviation, 500 h within the tolerance
  CHECK(judged[4].worst.hours == 500);
  // Brute force: no other finalist has a better worst life.
  for (const double degrees : {80.0, 79.0, 78.0, 75.0, 60.0, 0.0})
    CHECK(std::min({at_angle(degrees).hours, at_angle(degrees - 10).hours, at_angle(degrees + 10).hours}) <= 500);
}

TEST_CASE("tolerance: keeping all limits comes before a longer life") {
  const auto at = [](double hours, double beyond) {
    Finalist of{outcome(hours), std::vector<Nudge>(1), {}};
    of.run = [=](const std::vector<std::size_t>&) {
      Outcome off = outcome(hours);
      off.beyond[0] = beyond;
      return std::vector<Outcome>{off};
    };
    return of;
  };
  CHECK(best_within(within_tolerance({at(2000, 0.01), at(1000, -0.01)}, outcome(100))) == 1);
}

TEST_CASE(
    "tolerance: estimates without uncertain inputs leave few full runs, and the worst case of the winner is one of them") {
  std::mt19937 random(7);
  std::lognormal_distribution<double> spread(0, 0.7), error(0, 0.4);  // 0.4: measured error of an estimate
  constexpr std::size_t count = 3, nudges = 24;
  constexpr double rounds = 200, known_share = 0.3;  // without uncertain inputs a third of the life
  double full = 0, log_loss = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Finalist> finalists;
    std::vector<double> worst, drawn(count);
    for (double& hours : drawn) hours = 1000 * spread(random);
    std::sort(drawn.rbegin(), drawn.rend());
    int runs = 0;
    for (const double hours : drawn) {
      std::vector<double> lives(nudges), known(nudges);
      for (std::size_t k = 0; k < nudges; ++k)
        lives[k] = hours * spread(random), known[k] = known_share * lives[k] * error(random);
      worst.push_back(std::min(hours, *std::min_element(lives.begin(), lives.end())));
      finalists.push_back(finalist(hours, lives, runs));
      finalists.back().run_known = [known, hours](const std::vector<std::size_t>& numbers) {
        std::vector<Outcome> outcomes{outcome(known_share * hours)};
        for (const std::size_t k : numbers) outcomes.push_back(outcome(known[k]));
        return outcomes;
      };
    }
    const std::vector<WithinTolerance> judged = within_tolerance(finalists, outcome(1));
    const std::size_t best = best_within(judged);
    REQUIRE(judged[best].whole);
    for (std::size_t k = 0; k < nudges; ++k)
      if (judged[best].outcomes[k].hours == judged[best].worst.hours) CHECK_FALSE(judged[best].nudges[k].estimated);
    full += runs / rounds;
    log_loss += std::log(*std::max_element(worst.begin(), worst.end()) / worst[best]) / rounds;
  }
  CHECK(full < 12);       // of 72
  CHECK(log_loss < 0.4);  // less than the error of one estimate
}

TEST_CASE("tolerance: a limit that a run without uncertain inputs exceeds counts as in a full run") {
  const auto at = [](double hours, double beyond) {
    Finalist of{outcome(hours), std::vector<Nudge>(1), {}};
    of.run = [=](const auto&) { return std::vector<Outcome>{outcome(hours)}; };
    of.run_known = [=](const auto&) {
      Outcome off = outcome(hours);
      off.beyond[0] = beyond;
      return std::vector<Outcome>{outcome(hours), off};
    };
    return of;
  };
  CHECK(best_within(within_tolerance({at(2000, 0.01), at(1000, -0.01)}, outcome(100))) == 1);
  const auto enough = [](const Merit& worst) { return worst.kept < Kept::limits; };
  CHECK(within_tolerance(at(2000, 0.01), outcome(100), enough, {}, {}).nudges[0].estimated);  // it needs no full run
  CHECK_FALSE(within_tolerance(at(2000, -0.01), outcome(100), enough, {}, {}).nudges[0].estimated);
}

TEST_CASE("tolerance: an estimate scales each life and takes the shorter one without damage") {
  Outcome drawn = outcome(1000), own = outcome(200), off = outcome(50);
  drawn.modes = {{"abrasion", 600}, {"kink", HUGE_VAL}};
  own.modes = {{"abrasion", 300}, {"kink", HUGE_VAL}};
  off.modes = {{"abrasion", 100}, {"kink", 70}};
  off.beyond[2] = 0.5;
  const Outcome of = estimated(off, own, drawn);
  CHECK(of.hours == Approx(250));
  CHECK(of.modes[0].hours == Approx(200));
  CHECK(of.modes[1].hours == 70);
  CHECK(of.beyond[2] == 0.5);
  CHECK(estimated(outcome(HUGE_VAL), outcome(HUGE_VAL), drawn).hours == 1000);
  CHECK(estimated(outcome(0), own, drawn).failure == "too short");
}

TEST_CASE("tolerance: the words name the tolerance, the loss and where it occurs") {
  using Nudge = ImprovementStory::Nudge;
  const Nudge good{"length, - 10 mm", true, 0.9, "", "jacket wear", 5000},
      bad{"tool clamp, x + 10 mm", true, 0.8, "", "", 0};
  const MountingTolerance tolerance = tolerance_of(10, 10);
  const std::string with = "With a clamp or length off by 10 mm, a clamp tilted by 5.7 deg or an end turned by 10 deg ";
  CHECK(
      tolerance_words({good, bad}, tolerance) ==
      with +
          "the wires live at least 0.8 times as long (tool clamp, x + 10 mm), jacket wear comes after 5,000 h at the earliest "
          "(length, - 10 mm), and all limits are kept.\n");
  const Nudge refused{"end at the tool turned, - 10 deg", false, 0, "too short", "", 0};
  CHECK(
      tolerance_words({bad, refused}, tolerance) ==
      with +
          "the wires live at least 0.8 times as long (tool clamp, x + 10 mm), and 1 of 2 such jobs pass a limit or do not run "
          "(end at the tool turned, - 10 deg: too short).\n");
  CHECK(tolerance_words({}, tolerance).empty());
  const Nudge endless{"length, - 10 mm", true, std::nan(""), "", "", 0};  // no damage with or without the deviation
  CHECK(tolerance_words({endless}, tolerance) == with + "all limits are kept.\n");
  // Without damage as drawn there is no ratio, but there are hours.
  const Nudge damaged{"length, + 10 mm", true, 0, "", "", 0, false, 7000},
      worse{"turn", true, 0, "", "", 0, false, 600};
  CHECK(tolerance_words({damaged, worse}, tolerance) ==
        with + "the wires live at least 600 h (turn), and all limits are kept.\n");
  Nudge estimate = good;
  estimate.estimated = true;
  CHECK_THAT(tolerance_words({bad, estimate}, tolerance),
             Catch::EndsWith(" Lives of 1 of 2 such jobs are estimates by runs without uncertain inputs.\n"));
}

}  // namespace
