// A duty against closed forms: programs with damage at one place and at two, equal programs, histories.
#include "pipeline/advise/plan/mixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;
constexpr std::size_t many = 10000;

/// Lives of 10^median repeats, with a scatter of a tenth of a decade between median and 10 %.
LifeResponse mode_of(double median, const std::string& name = "wires of cable") {
  LifeResponse response;
  response.mode = name;
  response.construction = "hose", response.material = "copper";
  response.knowledge = prior_of({});
  response.knowledge.mean.setZero(), response.knowledge.covariance.setZero();
  response.planned = {{median - 0.1, median, median + 0.1}};
  response.worst_life = {median};
  return response;
}

/// Places with wires of one site each. damage: (place, wire). modes, failing: (place).
std::shared_ptr<const WireDamage> wires_of(const std::vector<std::vector<double>>& damage,
                                           const std::vector<std::uint32_t>& modes, std::uint32_t failing) {
  WireLayout layout;
  std::vector<double> of_sites;
  for (std::size_t place = 0; place < damage.size(); ++place) {
    for (const double of_wire : damage[place]) {
      of_sites.push_back(of_wire);
      layout.wire.push_back(static_cast<std::uint32_t>(layout.place.size()));
      layout.place.push_back(static_cast<std::uint32_t>(place));
    }
    layout.mode.push_back(modes[place]), layout.failing.push_back(failing);
  }
  layout.sort_sites();
  return std::make_shared<const WireDamage>(std::make_shared<const WireLayout>(layout), of_sites,
                                            std::ranges::max(modes) + 1);
}

/// A program with two places with three wires each; a conductor fails with its second wire.
EvaluatedProgram program(const std::string& name, double median, const std::vector<std::vector<double>>& damage) {
  return {name, 60, std::make_shared<const FailureModes>(FailureModes{mode_of(median)}), wires_of(damage, {0, 0}, 2)};
}

const std::vector<std::vector<double>> first_place{{3, 2, 1}, {0, 0, 0}}, second_place{{0, 0, 0}, {3, 2, 1}};

DutyDamage damage_of(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                     std::size_t samples) {
  std::vector<double> repeats;
  for (const Rate& rate : rates) repeats.push_back(rate.repeats_per_hour);
  return damage_under(programs, rates, SamePlace(programs).at(repeats), "", samples);
}

}  // namespace

TEST_CASE("a program mixed with itself is itself, in any order and parts") {
  const EvaluatedProgram one = program("a", 5, first_place), same = program("b", 5, first_place);
  const DutyLives whole = lives_under(damage_of({one}, {{30, 0}}, many));
  const DutyDamage mixed = damage_of({one, same}, {{10, 0}, {20, 0}}, many);
  const DutyLives parts = lives_under(mixed);
  const DutyLives nothing_more = lives_under(damage_of({one, same}, {{30, 0}, {0, 0}}, many));
  for (std::size_t p = 0; p < 3; ++p) {
    CHECK(parts.percentiles[p] == Approx(whole.percentiles[p]).epsilon(rounding));
    CHECK(nothing_more.percentiles[p] == Approx(whole.percentiles[p]).epsilon(rounding));
    CHECK(lives_with(mixed, {0, 1}, {1})[p] == Approx(1.5 * whole.percentiles[p]).epsilon(rounding));
    CHECK(lives_with(mixed, {2, 1}, {1})[p] == Approx(0.75 * whole.percentiles[p]).epsilon(rounding));
  }
  CHECK(parts.share[0] == Approx(1.0 / 3).epsilon(rounding));
  CHECK(parts.share[1] == Approx(2.0 / 3).epsilon(rounding));
  CHECK(whole.percentiles[1] == Approx(1e5 / 30).epsilon(1e-4));  // 10,000 samples
}

TEST_CASE("damage of programs adds up at one place, and not at two") {
  const EvaluatedProgram mild = program("mild", 6, {{0.3, 0.2, 0.1}, {0, 0, 0}});
  const EvaluatedProgram hard = program("hard", 5, first_place), elsewhere = program("elsewhere", 5, second_place);
  const std::vector<Rate> rates{{10, 0}, {10, 0}};
  const DutyDamage same = damage_of({mild, hard}, rates, many), apart = damage_of({hard, elsewhere}, rates, many);
  CHECK(same.same_place[0] == Approx(1).epsilon(rounding));
  CHECK(apart.same_place[0] == Approx(0.5).epsilon(rounding));
  CHECK(lives_under(same).percentiles[1] == Approx(1 / (10 / 1e5 + 10 / 1e6)).epsilon(1e-4));
  // The programs damage different places.
  CHECK(lives_under(apart).percentiles[1] == Approx(1e5 / 10).epsilon(1e-4));
  // Without the second program the first has its own life: the share of the same place depends on the rates.
  const std::vector<EvaluatedProgram> both{hard, elsewhere};
  const SamePlace places(both);
  CHECK(lives_with(apart, {1, 0}, places.at({10, 0}))[1] == Approx(1e5 / 10).epsilon(1e-4));
  CHECK(lives_with(apart, {1, 3}, places.at({10, 30}))[1] == Approx(1e5 / 30).epsilon(1e-4));
  // The second wire of three determines the failure. Equal damage of one wire at each place is not the damage of the same place.
  const EvaluatedProgram another_wire = program("another wire", 5, {{1, 2, 3}, {0, 0, 0}});
  CHECK(damage_of({hard, another_wire}, rates, many).same_place[0] == Approx(1).epsilon(rounding));  // 4, 4, 4
  const EvaluatedProgram other_wires = program("other wires", 5, {{0, 2, 2}, {0, 0, 0}});
  CHECK(damage_of({hard, other_wires}, rates, many).same_place[0] == Approx(3.0 / 4).epsilon(rounding));  // 3, 4, 3
}

TEST_CASE("a program more makes no life longer, also where the samples differ from the medians") {
  const EvaluatedProgram hard = program("hard", 5, first_place), elsewhere = program("elsewhere", 5, second_place);
  const std::vector<Rate> rates{{10, 0},
                                {10, 100}};  // at the medians each does half of the damage, in samples one dominates
  const std::vector<EvaluatedProgram> both{hard, elsewhere};
  const SamePlace places(both);
  const DutyDamage mixed = damage_of(both, rates, many);
  const LifePercentiles lives = lives_under(mixed).percentiles,
                        alone = lives_under(damage_of({hard}, {{10, 0}}, many)).percentiles;
  const LifePercentiles without = lives_with(mixed, {1, 0}, places.at({10, 0})),
                        twice = lives_with(mixed, {1, 2}, places.at({10, 20}));
  for (std::size_t p = 0; p < 3; ++p) {
    CHECK(lives[p] <= alone[p] * (1 + rounding));
    CHECK(without[p] == Approx(alone[p]).epsilon(rounding));
    CHECK(twice[p] <= lives[p] * (1 + rounding));
  }
  CHECK(lives[0] < 0.8 * alone[0]);  // where 'elsewhere' repeats more often it dominates
}

TEST_CASE("the first of two modes decides in each sample, and programs may wear different modes") {
  const auto with_modes = [](const std::string& name, double one, double other) {
    return EvaluatedProgram{name, 60,
                            std::make_shared<const FailureModes>(
                                FailureModes{mode_of(one, "wires of one"), mode_of(other, "wires of other")}),
                            wires_of({{1}, {1}}, {0, 1}, 1)};
  };
  const EvaluatedProgram first = with_modes("first", 5, 12), second = with_modes("second", 12, 4);
  const DutyDamage duty = damage_of({first, second}, {{1, 0}, {1, 0}}, many);
  const DutyLives lives = lives_under(duty);
  CHECK(lives.percentiles[1] == Approx(1e4).epsilon(1e-4));
  CHECK(lives.share[1] == Approx(1).epsilon(1e-6));  // a life of 1e12 has some damage
  CHECK(lives_with(duty, {1, 0}, {1, 1})[1] == Approx(1e5).epsilon(1e-4));
}

TEST_CASE("the damage of each mode is that at its own places") {
  // Both programs damage one place of the first mode. Each damages its own place of the second mode, which fails first.
  const auto with_places = [](const std::string& name, double one, double other) {
    return EvaluatedProgram{
        name, 60,
        std::make_shared<const FailureModes>(FailureModes{mode_of(7, "wires of one"), mode_of(5, "wires of other")}),
        wires_of({{1}, {one}, {other}}, {0, 1, 1}, 1)};
  };
  const DutyDamage duty = damage_of({with_places("first", 1, 0), with_places("second", 0, 1)}, {{1, 0}, {1, 0}}, many);
  REQUIRE(duty.same_place[0] == Approx(1).epsilon(rounding));
  REQUIRE(duty.same_place[1] == Approx(0.5).epsilon(rounding));
  CHECK(lives_under(duty).percentiles[1] == Approx(1e5).epsilon(1e-4));
  CHECK(lives_with(duty, {1, 1}, duty.same_place)[1] == Approx(1e5).epsilon(1e-4));
}

TEST_CASE("the damage of the mode that fails first is the same with and without the damage of each program") {
  // Two modes, one place each that both programs damage, and places of the second mode of their own.
  const auto with_modes = [](const std::string& name, double one, double other, double first, double second) {
    return EvaluatedProgram{name, 60,
                            std::make_shared<const FailureModes>(
                                FailureModes{mode_of(one, "wires of one"), mode_of(other, "wires of other")}),
                            wires_of({{1}, {first}, {second}}, {0, 1, 1}, 1)};
  };
  constexpr std::size_t samples = 500;
  // In the last two, both programs damage nearly the same place of the second mode, which fails first.
  for (const auto& [harder, of_second, elsewhere] :
       {std::tuple(4.0, 5.2, 0.2), {5.0, 5.2, 0.2}, {6.0, 5.2, 0.2}, {4.0, 4.1, 0.8}, {4.0, 3.9, 0.9}}) {
    const std::vector<EvaluatedProgram> programs{with_modes("first", 5, harder, 1, elsewhere),
                                                 with_modes("second", harder + 1, of_second, elsewhere / 2, 1)};
    const std::vector<Rate> rates{{3, 40}, {2, 80}};
    const std::vector<double> share = SamePlace(programs).at({3, 2});
    REQUIRE(share[1] < 1);
    std::vector<RepeatDamage> of_repeat;
    for (const EvaluatedProgram& of : programs)
      of_repeat.push_back(damage_of_lives(mode_lives(*of.modes, "", samples)));
    std::vector<double> factors;
    const std::vector<double> first = first_mode_damage(
        programs, rates, share,
        [&](const EvaluatedProgram& of) -> const RepeatDamage& { return of_repeat[of.job == "first" ? 0 : 1]; },
        [&](const EvaluatedProgram& of, double percent) -> const std::vector<double>& {
          return factors = repeat_factors(of.job, percent, "", samples);
        });
    const std::vector<double> stored = damage_under(programs, rates, share, "", samples).of_first_mode();
    REQUIRE(first.size() == samples);
    for (std::size_t s = 0; s < samples; ++s) CHECK(first[s] == Approx(stored[s]).epsilon(rounding));
  }
}

TEST_CASE("the worst place of a duty is that of a search through all sites") {
  constexpr std::size_t places = 60, wires_each = 7, sites_each = 3, programs = 5;
  std::mt19937 random(1);
  const auto number = [&](std::size_t below) {
    return static_cast<std::uint32_t>(std::uniform_int_distribution<std::size_t>(0, below - 1)(random));
  };
  WireLayout layout;
  for (std::uint32_t place = 0; place < places; ++place) {
    layout.mode.push_back(place % 2), layout.failing.push_back(1 + number(wires_each));
    for (std::size_t k = 0; k < wires_each; ++k) layout.place.push_back(place);
  }
  for (std::uint32_t wire = 0; wire < places * wires_each; ++wire)
    for (std::size_t k = 0; k < sites_each; ++k) layout.wire.push_back(wire);
  for (int site = 0; site < 50; ++site) layout.wire.push_back(0xffffffff);  // of the hose's wall
  std::shuffle(layout.wire.begin(), layout.wire.end(), random);
  const auto modes =
      std::make_shared<const FailureModes>(FailureModes{mode_of(7, "wires of one"), mode_of(5, "wires of other")});
  layout.sort_sites();
  const auto shared = std::make_shared<const WireLayout>(layout);
  using Damage = std::vector<double>;  // (site)
  const auto damaged = [&](double decades) {
    Damage damage;
    for (std::size_t site = 0; site < layout.wire.size(); ++site)
      damage.push_back(std::pow(10, std::uniform_real_distribution(-decades, 0.0)(random)));
    return damage;
  };
  for (const double decades : {0.1, 1.0, 6.0}) {
    std::vector<EvaluatedProgram> all;
    std::vector<double> rates;
    std::vector<Damage> of;
    for (std::size_t k = 0; k < programs; ++k) {
      of.push_back(damaged(decades)), rates.push_back(1 + number(40));
      all.push_back({"p", 60, modes, std::make_shared<const WireDamage>(shared, of.back(), 2)});
    }
    const Damage of_round = damaged(decades);
    const WireDamage round(shared, of_round, 2);
    std::vector<double> in_rounds = rates;
    in_rounds.push_back(3);
    const auto worst = [&](const std::vector<Damage>& damages, const std::vector<double>& times) {
      std::array<double, 2> most{};
      for (std::uint32_t place = 0; place < places; ++place) {
        std::vector<double> of_wire(wires_each, 0.0);
        for (std::size_t site = 0; site < layout.wire.size(); ++site) {
          if (layout.wire[site] == 0xffffffff || layout.place[layout.wire[site]] != place) continue;
          double damage = 0;
          for (std::size_t k = 0; k < damages.size(); ++k) damage += times[k] * damages[k][site];
          double& largest = of_wire[layout.wire[site] % wires_each];
          largest = std::max(largest, damage);
        }
        std::sort(of_wire.rbegin(), of_wire.rend());
        most[layout.mode[place]] = std::max(most[layout.mode[place]], of_wire[layout.failing[place] - 1]);
      }
      return most;
    };
    std::array<double, 2> apart{};
    for (std::size_t k = 0; k < programs; ++k) {
      const auto alone = worst({of[k]}, {rates[k]});
      for (std::size_t m = 0; m < 2; ++m) apart[m] += alone[m];
    }
    const auto together = worst(of, rates);
    of.push_back(of_round);
    const auto with_round = worst(of, in_rounds);
    const SamePlace places_of(all, &round);
    for (std::size_t m = 0; m < 2; ++m) {
      CHECK(places_of.at(rates)[m] == Approx(together[m] / apart[m]).epsilon(rounding));
      CHECK(places_of.at(rates, in_rounds)[m] == Approx(with_round[m] / apart[m]).epsilon(rounding));
    }
  }
}

TEST_CASE("the remaining life is the life without the past, of the dresspacks that have survived it") {
  const DutyDamage duty = damage_of({program("a", 5, first_place)}, {{10, 0}}, many);
  const DutyDamage idle = damage_of({program("a", 5, first_place)}, {{0, 0}}, many);
  const DutyLives fresh = lives_under(duty), same = lives_under(duty, {{&idle, 5000}});
  CHECK(same.survived == 1);
  CHECK(same.remaining == fresh.percentiles);
  const double past = 10000;  // the median life
  const DutyLives old = lives_under(duty, {{&duty, past}});
  CHECK(old.survived == Approx(0.5).margin(1e-4));
  // Half of the survivors fail before the life that three quarters of all reach; a tenth fail before that of 55 %.
  std::vector<double> lives = fresh.log10_hours;
  std::sort(lives.begin(), lives.end());
  constexpr double between_samples = 1e-3;
  CHECK(old.remaining[1] == Approx(std::pow(10, lives[3 * many / 4]) - past).epsilon(between_samples));
  CHECK(old.remaining[0] == Approx(std::pow(10, lives[55 * many / 100]) - past).epsilon(20 * between_samples));
  // Two halves of a history are equal to the whole.
  CHECK(lives_under(duty, {{&duty, past / 2}, {&duty, past / 2}}).remaining[1] ==
        Approx(old.remaining[1]).epsilon(rounding));
}

TEST_CASE("uncertain numbers of repeats widen the lives and leave the median") {
  const EvaluatedProgram one = program("a", 5, first_place);
  const DutyLives known = lives_under(damage_of({one}, {{10, 0}}, many));
  const DutyLives uncertain = lives_under(damage_of({one}, {{10, 50}}, many));
  CHECK(uncertain.percentiles[1] == Approx(known.percentiles[1]).epsilon(0.02));  // of 10,000 samples
  // Standard deviations of ln life add as squares: 0.1 decades at 10 % are 0.18; a spread of 50 % is sqrt(ln 1.25) = 0.47.
  const double decile = 1.2815515655446004, of_wires = 0.1 * std::log(10.0) / decile,
               of_repeats = std::sqrt(std::log(1.25));
  CHECK(std::log(uncertain.percentiles[1] / uncertain.percentiles[0]) ==
        Approx(decile * std::hypot(of_wires, of_repeats)).epsilon(0.02));
}
