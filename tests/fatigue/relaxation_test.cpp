// Relaxation of mean stress: the law, the life under it by closed forms and repeat by repeat, and its effect on histories.
#include "fatigue/relaxation.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "fatigue/damage.h"
#include "fatigue/stress_path.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/instruction_set.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;
using pipeline::MeanStress;
using pipeline::MeanStressRelaxation;

namespace {

constexpr double promised = 1e-5;        // of a life with smooth damage (relaxation.h)
constexpr double promised_short = 5e-4;  // of a life shorter than a hundred repeats
constexpr std::array<MeanStress, 4> rules{MeanStress::none, MeanStress::swt, MeanStress::morrow, MeanStress::walker};

pipeline::Material soft_copper() {
  auto m = material(117e9, 491.5e6, -0.112, 1.215, -0.6);
  m.relaxation_threshold_strain = 2.8e-4;
  return m;
}

pipeline::Fatigue with(MeanStress rule, MeanStressRelaxation relaxation = MeanStressRelaxation::power_law) {
  pipeline::Fatigue settings;
  settings.mean_stress = rule;
  settings.mean_stress_relaxation = relaxation;
  return settings;
}

DamageOfShares each(const std::function<double(double)>& damage) {
  return [damage](std::span<const double> share, std::span<double> of) {
    for (std::size_t i = 0; i < share.size(); ++i) of[i] = damage(share[i]);
  };
}

/// Returns a swing that contains smaller ones, shifted by a constant strain, in the precision of dresslife-strain.
std::vector<float> busy_swing(double amplitude, double offset) {
  std::vector<float> strains;
  for (const double x : {0.2, 1.0, 0.3, 0.7, -0.5, 0.1, -1.0, -0.2, -0.6, 0.5, -0.1})
    strains.push_back(static_cast<float>(amplitude * x + offset));
  return strains;
}

std::vector<Reversal> reversals_of(const std::vector<float>& strains) {
  std::vector<Reversal> reversals;
  for (const float strain : strains) reversals.push_back({strain, static_cast<std::int64_t>(reversals.size())});
  return reversals;
}

}  // namespace

TEST_CASE("relaxation: the exponent is 0 up to the threshold and falls straight from there") {
  const Relaxation law(soft_copper(), with(MeanStress::swt));
  CHECK_FALSE(law.never());
  CHECK(law.exponent(0) == 0);
  CHECK(law.exponent(2.8e-4) == 0);
  CHECK(law.exponent(5.6e-4) == Approx(-0.085));
  CHECK(law.exponent(2.8e-3) == Approx(-0.085 * 9));
  auto quicker = soft_copper();
  quicker.relaxation_exponent = 0.2;
  CHECK(Relaxation(quicker, with(MeanStress::swt)).exponent(5.6e-4) == Approx(-0.2));
}

TEST_CASE("relaxation: what never relaxes, and what does at once") {
  CHECK(Relaxation(copper(), with(MeanStress::swt)).never());  // without a threshold
  CHECK(Relaxation(soft_copper(), with(MeanStress::swt, MeanStressRelaxation::none)).never());
  auto once = with(MeanStress::swt);
  once.counting = pipeline::Counting::half_cycles;
  CHECK(Relaxation(soft_copper(), once).never());
  auto measured = soft_copper();
  measured.strain_life_table = {{0.01, 1e3}, {0.001, 1e6}};
  CHECK(Relaxation(measured, with(MeanStress::swt, MeanStressRelaxation::complete)).never());
  CHECK(Relaxation(copper(), with(MeanStress::swt, MeanStressRelaxation::complete)).complete());
}

TEST_CASE("relaxation: mean share over a life, closed form against the sum and its limits") {
  for (const double r : {-0.01, -0.3, -1.0, -1.5}) {
    constexpr int repeats = 200000;
    double sum = 0;  // the integral of n^r over (n - 1, n) lies between the values at its ends
    for (int n = 2; n <= repeats; ++n) sum += std::pow(n - 0.5, r);
    CHECK(mean_share(repeats, r) == Approx((1 + sum) / repeats).epsilon(0.02));  // error of the first terms of the sum
  }
  CHECK(mean_share(1e6, 0) == 1);
  CHECK(mean_share(1e6, -1e-12) == Approx(1));
  CHECK(mean_share(0.3, -0.5) == 1);
  CHECK(mean_share(infinity, -0.1) == 0);
  CHECK(mean_share(1e6, -1 + 1e-10) == Approx(mean_share(1e6, -1)).epsilon(1e-8));
}

TEST_CASE("relaxation: life under a damage that is straight in the share, closed form") {
  // a L + c [1 + (L^(1+r) - 1)/(1+r)] = 1
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decade(-9, -1), power(-2, 0), unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    const double relaxed = std::pow(10, decade(random)), r = power(random);
    const double more = i % 2 ? relaxed * std::pow(10, 4 * unit(random) - 2) : -relaxed * unit(random);
    if (relaxed + more >= 1) continue;
    const double life = relaxing_life(r, each([&](double share) { return relaxed + more * share; }));
    INFO(relaxed << " " << more << " " << r << " " << life);
    CHECK(relaxed * life + more * life * mean_share(life, r) ==
          Approx(1).epsilon(life > 100 ? promised : promised_short));
  }
}

TEST_CASE("relaxation: life by a steep damage, repeat by repeat") {
  for (const double offset : {0.5, 3.0, -0.6}) {
    for (const double r : {-0.05, -0.2, -0.7, -3.0}) {
      const auto damage = [&](double share) { return 1e-5 * std::pow(1 + offset * share, 4.5); };
      double sum = damage(1);
      int repeats = 1;
      for (; sum < 1; ++repeats) {  // midpoint rule; the first repeats are curved and need more pieces
        const int pieces = repeats < 100 ? 100 : 1;
        for (int piece = 0; piece < pieces; ++piece)
          sum += damage(std::pow(repeats + (piece + 0.5) / pieces, r)) / pieces;
      }
      const double life = relaxing_life(r, each(damage));
      INFO(offset << " " << r);
      CHECK(std::fabs(life - repeats) < 1 + promised * repeats);  // the break is within a repeat
    }
  }
}

TEST_CASE("relaxation: limits of a life") {
  CHECK(relaxing_life(-0.3, each([](double) { return 0.0; })) == infinity);
  CHECK(relaxing_life(-0.3, each([](double) { return 1e-7; })) == Approx(1e7).epsilon(promised));
  CHECK(relaxing_life(0, each([](double share) { return 1e-7 * share; })) == Approx(1e7));
  CHECK(relaxing_life(-0.3, each([](double share) { return 1 + share; })) == 0.5);  // in the first repeat
  // Damage that decreases to zero before the wire breaks: the total is 1e-3 (1 + 1/0.5).
  CHECK(relaxing_life(-1.5, each([](double share) { return 1e-3 * share; })) == infinity);
  // Compression that relaxes so slowly that damage has not begun after 2^50 repeats, and compression that relaxes in the end.
  CHECK(relaxing_life(-1e-4, each([](double share) { return share > 0.5 ? 0.0 : 1e-3; })) == infinity);
  CHECK(rough_relaxing_life(std::pow(10, -1e-4), std::pow(5.5, -1e-4),
                            [](double share) { return share > 0.5 ? 0.0 : 1e-3; }) == 1e15);
  // No damage at first, because of compression; all of the damage later.
  const double late = relaxing_life(-0.5, each([](double share) { return share > 0.1 ? 0.0 : 1e-4 * (0.1 - share); }));
  CHECK(late > 1e5);
  CHECK(late < 1.1e5);
}

TEST_CASE("relaxation: the rough life of the innermost loop") {
  for (const double offset : {-0.8, 0.5, 3.0})
    for (const double size : {1e-8, 1e-5, 1e-2})
      for (const double r : {-0.05, -0.3, -1.0}) {
        const auto damage = [&](double share) { return size * std::pow(1 + offset * share, 4.5); };
        const double rough = rough_relaxing_life(std::pow(10, r), std::pow(5.5, r), damage);
        INFO(offset << " " << size << " " << r);
        CHECK(rough == Approx(relaxing_life(r, each(damage))).epsilon(0.35));
      }
}

TEST_CASE("relaxation: a constant strain is forgotten by a history that is old") {
  constexpr double rounding = 1e-4;  // strains in single precision, times the slope of the life
  DamageCounter::Workspace memory;
  for (const MeanStress rule : rules) {
    const DamageCounter relaxed(soft_copper(), with(rule, MeanStressRelaxation::complete));
    const DamageCounter kept(soft_copper(), with(rule, MeanStressRelaxation::none));
    for (const double amplitude : {4e-4, 1e-3, 5e-3}) {
      const double alone = relaxed(busy_swing(amplitude, 0), memory);
      for (const double offset : {-0.012, -2e-4, 3e-4, 0.012}) {
        INFO(int(rule) << " " << amplitude << " " << offset);
        CHECK(relaxed(busy_swing(amplitude, offset), memory) == Approx(alone).epsilon(rounding));
      }
      if (rule == MeanStress::none) continue;
      CHECK(kept(busy_swing(amplitude, 0.012), memory) >
            1.05 * alone);  // the effect of an offset that complete relaxation removes
      CHECK(kept(busy_swing(amplitude, -0.012), memory) < alone / 1.05);
    }
  }
}

TEST_CASE(
    "relaxation: tables and exact cycles agree whatever share of the offset is left, on all instruction "
    "sets") {
  DamageCounter::Workspace memory;
  for (const pipeline::InstructionSet set : pipeline::instruction_sets())
    for (const MeanStress rule : rules)
      for (const auto stress : {pipeline::Stress::cyclic, pipeline::Stress::elastic}) {
        auto settings = with(rule);
        settings.stress = stress;
        const DamageCounter counter(soft_copper(), settings, set);
        for (const double offset : {-3e-3, 1e-3, 8e-3})
          for (const double share : {0.0, 0.3, 1.0}) {
            const std::vector<float> strains = busy_swing(2e-3, offset);
            const auto reversals = reversals_of(strains);
            const double exact = sum_of_damage(evaluate_cycles(reversals, soft_copper(), settings, share));
            INFO(int(set) << " " << int(rule) << " " << int(stress) << " " << offset << " " << share);
            CHECK(counter(strains, memory, share) == Approx(exact).epsilon(DamageCounter::table_error));
            CHECK(sum_of_damage(counter.cycles(reversals, share)) ==
                  Approx(counter(strains, memory, share)).epsilon(1e-12));
          }
      }
}

TEST_CASE("relaxation: a history that reaches its largest strain again has the stress there that it had before") {
  // Bends of a rig are equal to the last bit: two equal loops, each with all of the remaining offset.
  constexpr double as_tables = DamageCounter::table_error;
  const pipeline::Material m = soft_copper();
  for (const MeanStress rule : rules)
    for (const double sign : {1.0, -1.0}) {
      std::vector<float> once, twice, with_nooks;
      for (const double x : {0.0, 1.76e-3}) once.push_back(static_cast<float>(sign * x));
      for (const double x : {0.0, 1.76e-3, 0.0, 1.76e-3}) twice.push_back(static_cast<float>(sign * x));
      for (const double x : {0.0, 1.76e-3, 1.7e-3, 1.76e-3, 0.0, 1.76e-3, 1.7e-3, 1.76e-3})
        with_nooks.push_back(static_cast<float>(sign * x));
      for (const pipeline::InstructionSet set : pipeline::instruction_sets()) {
        const DamageCounter counter(m, with(rule), set);
        DamageCounter::Workspace workspace;
        for (const double share : {1.0, 0.5, 0.0}) {
          INFO(word(rule) << ", sign " << sign << ", share " << share);
          CHECK(counter(twice, workspace, share) == Approx(2 * counter(once, workspace, share)).epsilon(as_tables));
          CHECK(counter(with_nooks, workspace, share) ==
                Approx(sum_of_damage(evaluate_cycles(reversals_of(with_nooks), m, with(rule), share)))
                    .epsilon(as_tables));
        }
      }
    }
}

TEST_CASE("relaxation: a swing off centre by hand") {
  // From 0.010 to 0.014: at first s_max = curve(0.014), after relaxation half the branch of the range 0.004.
  const auto metal = soft_copper();
  const std::vector<Reversal> swing{{0.010, 0}, {0.014, 1}};
  const CyclicCurve curve(metal);
  const double first = curve.stress(0.014), range = curve.stress_range(0.004);
  for (const double share : {0.0, 0.25, 1.0}) {
    const auto cycles = evaluate_cycles(swing, metal, with(MeanStress::swt), share);
    REQUIRE(cycles.size() == 1);
    CHECK(cycles[0].stress_max == Approx(share * first + (1 - share) * range / 2));
    CHECK(cycles[0].stress_mean == Approx(share * (first - range / 2)).margin(1));
  }
}

TEST_CASE("relaxation: inner loops keep their place in the outer one") {
  const auto settings = with(MeanStress::swt);
  const auto reversals = reversals_of(busy_swing(2e-3, 5e-3));
  const auto kept = evaluate_cycles(reversals, soft_copper(), settings, 1),
             gone = evaluate_cycles(reversals, soft_copper(), settings, 0);
  REQUIRE(kept.size() == gone.size());
  REQUIRE(kept.size() == 5);
  for (std::size_t i = 0; i < kept.size(); ++i)
    CHECK(kept[i].stress_mean - gone[i].stress_mean == Approx(kept[0].stress_mean - gone[0].stress_mean));
}

TEST_CASE("relaxation: the settled life against one that is added up by exact cycles") {
  DamageCounter::Workspace memory;
  for (const MeanStress rule : rules)
    for (const double offset : {-4e-3, 4e-3}) {
      const std::vector<float> strains = busy_swing(1.5e-3, offset);
      const auto reversals = reversals_of(strains);
      const auto settings = with(rule);
      const DamageCounter counter(soft_copper(), settings);
      const double exponent = Relaxation(soft_copper(), settings).exponent(1.5e-3);
      const auto damage = [&](double repeat) {
        return sum_of_damage(evaluate_cycles(reversals, soft_copper(), settings, std::pow(repeat, exponent)));
      };
      double sum = damage(1), repeats = 1;
      constexpr double step = 1.02;  // midpoint rule in steps of 2 %: error 1e-4
      while (sum < 1) {
        const double more = (step - 1) * repeats * damage(repeats * std::sqrt(step));
        repeats *= sum + more < 1 ? step : 1 + (step - 1) * (1 - sum) / more;
        sum += more;
      }
      INFO(int(rule) << " " << offset);
      CHECK(1 / counter.settled_damage(strains, memory) == Approx(repeats).epsilon(1e-3));
      // The estimate of the innermost loop is close.
      CHECK(counter(strains, memory) == Approx(1 / repeats).epsilon(0.3));
      const double unrelaxed = counter(strains, memory, 1), relaxed = counter(strains, memory, 0);
      CHECK(1 / repeats <= std::max(unrelaxed, relaxed) * (1 + promised));
      CHECK(1 / repeats >= std::min(unrelaxed, relaxed) * (1 - promised));
    }
}

TEST_CASE("relaxation: without the effect of compression a compressed wire lives as long as one without mean stress") {
  DamageCounter::Workspace memory;
  for (const MeanStress rule : rules)
    for (const float range : {4e-4f, 8e-3f}) {  // below and above the threshold
      const DamageCounter by_rule(soft_copper(), with(rule));
      const DamageCounter safe(soft_copper(), with(rule), pipeline::instruction_set(), most_reversals,
                               Compression::without_effect);
      const std::vector<float> compressed{0, -range}, pulled{0, range}, symmetric{range / 2, -range / 2};
      INFO(int(rule) << " " << range);
      CHECK(safe.settled_damage(compressed, memory) ==
            Approx(by_rule.settled_damage(symmetric, memory)).epsilon(promised));
      CHECK(safe(compressed, memory) == Approx(by_rule(symmetric, memory)).epsilon(promised));
      CHECK(safe.settled_damage(pulled, memory) == Approx(by_rule.settled_damage(pulled, memory)).epsilon(promised));
      if (range < 1e-3f)  // the mean stress stays
        CHECK((by_rule.settled_damage(compressed, memory) < 0.9 * by_rule.settled_damage(symmetric, memory)) ==
              (rule != MeanStress::none));
    }
}

TEST_CASE("relaxation: lives are continuous in the offset, the amplitude and the exponent") {
  DamageCounter::Workspace memory;
  const auto life_of = [&](const pipeline::Material& metal, double amplitude, double offset) {
    const DamageCounter counter(metal, with(MeanStress::swt));
    return 1 / counter.settled_damage(busy_swing(amplitude, offset), memory);
  };
  double before = life_of(soft_copper(), 8e-4, -5e-3);
  for (double offset = -5e-3; offset < 8e-3; offset += 2e-5) {
    const double life = life_of(soft_copper(), 8e-4, offset);
    INFO(offset);
    CHECK(life == Approx(before).epsilon(0.1));
    before = life;
  }
  before = life_of(soft_copper(), 2.7e-4, 3e-3);
  for (double amplitude = 2.7e-4; amplitude < 3.2e-4; amplitude *= 1.001) {  // across the threshold
    const double life = life_of(soft_copper(), amplitude, 3e-3);
    CHECK(life == Approx(before).epsilon(0.05));
    before = life;
  }
  auto metal = soft_copper();
  metal.relaxation_exponent = 0.0;
  before = life_of(metal, 8e-4, 3e-3);
  for (double exponent = 0; exponent < 1; exponent += 0.01) {
    metal.relaxation_exponent = exponent;
    const double life = life_of(metal, 8e-4, 3e-3);
    INFO(exponent);
    CHECK(life == Approx(before).epsilon(0.5));
    CHECK(life >= before * (1 - promised));  // tension that relaxes faster
    before = life;
  }
}
