// Damage of whole histories: published blocks, tables against the exact evaluation, assignment to time.
#include "fatigue/damage.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "fatigue/stress_path.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;
using pipeline::Counting;
using pipeline::MeanStress;
using pipeline::Stress;

namespace {

constexpr double published = 1e-9;  // relative; the tolerance of the published values
constexpr double same_sum = 1e-12;  // relative: equal terms, possibly in another order

// dfieser/lcf-strain-life (commit a6a8d40c), tests/test_simulate.py; MPa. Numbers recomputed in 40 digits.
pipeline::Material block_steel() {
  auto m = material(200000, 900, -0.1, 0.6, -0.55);
  m.cyclic_strength = 1650;
  m.cyclic_hardening_exponent = 0.15;
  return m;
}

struct Loop {
  double amplitude, mean, stress_amplitude, stress_mean, stress_max;
};

struct Block {
  const char* name;
  std::vector<double> strains;
  std::vector<Loop> loops;
  double swt, morrow, none;  // damage per block
  std::vector<double> swt_cycles, morrow_cycles, none_cycles;
};

const std::vector<Block> blocks{
    {"constant amplitude",
     {0.008, -0.008},
     {{0.008, 0, 729.902174306376, 0, 729.902174306376}},
     0.00143685759040942,
     0.000468932484882416,
     0.000468932484882416,
     {695.963195430562},
     {2132.50314754959},
     {2132.50314754959}},
    {"two levels",
     {0.01, -0.01, 0.005, -0.005},
     {{0.005, 0, 639.528711378806, 28.1061678719116, 667.634879250717},
      {0.01, 0, 768.905801246571, 0, 768.905801246571}},
     0.00283470036534389,
     0.000927032460199225,
     0.000922778957001273,
     {1884.2055648299, 434.032918571146},
     {6394.61136667251, 1297.60458537132},
     {6573.40468677878, 1297.60458537132}},
    {"pulsating",
     {0.01, 0},
     {{0.005, 0.005, 639.528711378806, 129.377089867765, 768.905801246571}},
     0.000686297979394698,
     0.00017238541212805,
     0.00015212816609501,
     {1457.09302667914},
     {5800.95489319704},
     {6573.40468677878}},
    {"interrupted branch",
     {0.01, -0.002, 0.006, -0.01},
     {{0.004, 0.002, 589.818717542833, 5.98768525343025, 595.806402796264},
      {0.01, 0, 768.905801246571, 0, 768.905801246571}},
     0.00258593611799727,
     0.00085575151374632,
     0.000855117434971443,
     {3546.55949908403, 434.032918571146},
     {11750.7815048699, 1297.60458537132},
     {11838.9929074054, 1297.60458537132}},
};

std::vector<Reversal> numbered(const std::vector<double>& strains) { return find_reversals(strains); }

/// Returns the reversals of a random walk in single precision, as dresslife-strain stores them.
std::vector<Reversal> random_history(std::mt19937& random, int samples, double size, double offset = 0) {
  std::normal_distribution<double> step(0, size);
  std::vector<double> history;
  double x = 0;
  for (int i = 0; i < samples; ++i) {
    x = 0.9 * x + step(random);
    history.push_back(static_cast<float>(x + offset));
  }
  return find_reversals(history);
}

std::vector<float> strains_of(const std::vector<Reversal>& reversals) {
  std::vector<float> strains;
  for (const Reversal& r : reversals) strains.push_back(static_cast<float>(r.strain));
  return strains;
}

}  // namespace

TEST_CASE("published strain blocks: loops, stresses, lives and damage") {
  for (const Block& block : blocks) {
    INFO(block.name);
    for (const auto mean_stress : {MeanStress::swt, MeanStress::morrow, MeanStress::none}) {
      pipeline::Fatigue settings;
      settings.mean_stress = mean_stress;
      const auto cycles = evaluate_cycles(numbered(block.strains), block_steel(), settings);
      REQUIRE(cycles.size() == block.loops.size());
      const auto& lives = mean_stress == MeanStress::swt      ? block.swt_cycles
                          : mean_stress == MeanStress::morrow ? block.morrow_cycles
                                                              : block.none_cycles;
      for (std::size_t i = 0; i < cycles.size(); ++i) {
        const Loop& loop = block.loops[i];
        CHECK(cycles[i].cycle.range() / 2 == Approx(loop.amplitude).epsilon(published));
        CHECK(cycles[i].cycle.mean() == Approx(loop.mean).epsilon(published).margin(1e-15));
        CHECK(cycles[i].stress_max == Approx(loop.stress_max).epsilon(published));
        CHECK(cycles[i].stress_mean == Approx(loop.stress_mean).epsilon(published).margin(1e-9));
        CHECK(cycles[i].stress_max - cycles[i].stress_mean == Approx(loop.stress_amplitude).epsilon(published));
        CHECK(1 / cycles[i].damage == Approx(lives[i]).epsilon(published));
      }
      const double damage = mean_stress == MeanStress::swt      ? block.swt
                            : mean_stress == MeanStress::morrow ? block.morrow
                                                                : block.none;
      CHECK(sum_of_damage(cycles) == Approx(damage).epsilon(published));
    }
  }
}

TEST_CASE("stress along a history is that of its cycles where it turns, whatever lies between") {
  constexpr int between = 7;    // samples between reversals
  constexpr double left = 0.4;  // remaining share of the offset
  std::mt19937 random(5);
  std::uniform_real_distribution<double> strain(-0.01, 0.015);
  std::vector<double> history{strain(random)};
  for (int turn = 0; turn < 60; ++turn) {
    const double from = history.back(), to = (turn % 2 ? 1 : -1) * std::fabs(strain(random));
    for (int k = 1; k <= between; ++k) history.push_back(from + (to - from) * k / between);
  }
  std::vector<Reversal> turns;
  for (std::size_t k = 0; k < history.size(); k += between) turns.push_back({history[k], static_cast<std::int64_t>(k)});
  for (const auto counting : {pipeline::Counting::repeating, pipeline::Counting::half_cycles})
    for (const auto rule : {pipeline::Stress::cyclic, pipeline::Stress::elastic}) {
      pipeline::Fatigue settings;
      settings.counting = counting;
      settings.stress = rule;
      const std::vector<double> stress = stress_along(history, copper(), settings, left);
      REQUIRE(stress.size() == history.size());
      const auto cycles = evaluate_cycles(turns, copper(), settings, left);
      REQUIRE(!cycles.empty());
      for (const DamagingCycle& cycle : cycles) {
        const double begin = stress[static_cast<std::size_t>(cycle.cycle.begin.sample)],
                     end = stress[static_cast<std::size_t>(cycle.cycle.end.sample)];
        CHECK(std::max(begin, end) == Approx(cycle.stress_max).epsilon(1e-12));
        CHECK(begin / 2 + end / 2 == Approx(cycle.stress_mean).epsilon(1e-12).margin(1e-3));
      }
    }
  CHECK(stress_along({}, copper(), {}).empty());
}

TEST_CASE("a constant amplitude's life is the curve's life") {
  pipeline::Fatigue settings;
  settings.mean_stress = MeanStress::none;
  const DamageCounter counter(copper(), settings);
  DamageCounter::Workspace workspace;
  const StrainLife life(copper(), MeanStress::none);
  for (const float amplitude : {0.0005f, 0.001f, 0.01f, 0.025f}) {
    const double one = counter(std::vector<float>{0, amplitude, -amplitude, 0}, workspace);
    CHECK(one == Approx(life.damage({amplitude, 0, 0})).epsilon(DamageCounter::table_error));
    CHECK(life_in_repeats(one) == Approx(life.reversals({amplitude, 0, 0}) / 2).epsilon(DamageCounter::table_error));
  }
}

TEST_CASE("tables agree with the exact evaluation for every combination of settings") {
  auto hard = material(205e9, 1500e6, -0.05, 0.4, -0.6);  // the smallest |b| for which table_error holds
  auto given = copper();
  given.cyclic_strength = 300e6;
  given.cyclic_hardening_exponent = 0.25;
  std::mt19937 random(31);
  DamageCounter::Workspace workspace;
  double worst = 0;
  int compared = 0;
  for (const auto& m : {copper(), aluminium(), hard, given}) {
    for (const auto stress : {Stress::cyclic, Stress::elastic}) {
      for (const auto mean_stress : {MeanStress::none, MeanStress::morrow, MeanStress::swt, MeanStress::walker}) {
        for (const auto counting : {Counting::repeating, Counting::half_cycles}) {
          pipeline::Fatigue settings;
          settings.stress = stress, settings.mean_stress = mean_stress, settings.counting = counting;
          settings.endurance_strain = 2e-4;
          const DamageCounter counter(m, settings);
          for (int trial = 0; trial < 60; ++trial) {
            const double size = std::pow(10, -4 + 3.5 * (trial % 20) / 20.0);  // 1e-4 to 0.2
            const auto history = random_history(random, 3 + 5 * trial, size, trial % 3 == 0 ? -size : 0);
            const double exact = sum_of_damage(evaluate_cycles(history, m, settings));
            const double fast = counter(strains_of(history), workspace);
            CHECK(sum_of_damage(counter.cycles(history)) == Approx(fast).epsilon(same_sum).margin(0));
            if (exact == 0) {
              CHECK(fast == 0);
              continue;
            }
            worst = std::max(worst, std::fabs(fast / exact - 1));
            ++compared;
          }
        }
      }
    }
  }
  CAPTURE(worst);
  CHECK(compared > 2000);
  CHECK(worst < DamageCounter::table_error);
}

TEST_CASE("without the effect of compression each cycle has at least the damage of zero mean stress") {
  std::mt19937 random(43);
  DamageCounter::Workspace workspace;
  for (const auto mean_stress : {MeanStress::none, MeanStress::morrow, MeanStress::swt, MeanStress::walker})
    for (const auto counting : {Counting::repeating, Counting::half_cycles}) {
      pipeline::Fatigue settings;
      settings.mean_stress = mean_stress, settings.counting = counting;
      const DamageCounter by_rule(copper(), settings);
      const DamageCounter safe(copper(), settings, pipeline::instruction_set(), most_reversals,
                               Compression::without_effect);
      const StrainLife life(copper(), mean_stress);
      int larger = 0;
      for (int trial = 0; trial < 60; ++trial) {
        const double size = std::pow(10, -4 + 2.5 * (trial % 20) / 20.0);  // 1e-4 to 0.03
        const auto history = random_history(random, 3 + 5 * trial, size, trial % 2 == 0 ? -3 * size : 0);
        double exact = 0;
        for (const DamagingCycle& of : evaluate_cycles(history, copper(), settings)) {
          const double compressive = std::min(of.stress_mean, 0.0);
          exact += of.cycle.count *
                   life.damage({of.cycle.range() / 2, of.stress_max - compressive, of.stress_mean - compressive});
        }
        const double fast = safe(strains_of(history), workspace);
        CHECK(fast == Approx(exact).epsilon(DamageCounter::table_error).margin(0));
        CHECK(sum_of_damage(safe.cycles(history)) == Approx(fast).epsilon(same_sum).margin(0));
        larger += fast > 1.01 * by_rule(strains_of(history), workspace);
      }
      CHECK((larger > 10) == (mean_stress != MeanStress::none));
    }
}

TEST_CASE("histories counted together have each the damage they have alone on every instruction set") {
  std::mt19937 random(37);
  std::vector<std::vector<float>> histories;
  for (int k = 0; k < 150; ++k) {
    if (k % 3 > 0) {  // nearly equal to its neighbour
      histories.push_back(histories.back());
      for (float& strain : histories.back()) strain *= 1 + 1e-3f * static_cast<float>(k % 5);
    } else {
      const double size = std::pow(10, -4 + 3.5 * (k % 20) / 20.0);
      histories.push_back(strains_of(random_history(random, 2 + 3 * k, size, k % 2 == 0 ? -size : 0)));
    }
  }
  histories[7] = {};
  histories[20] = {0.01f};
  histories[33] = {0.004f, 0.001f, 0.002f, 0.002f, -0.001f, -0.003f, 0.002f};  // does not alternate
  histories[46] = {0, 3, -30, 10, 0};                                          // outside the tables
  histories[59] = {0.02f, 0.02f};
  histories[60] = {0, -0.01f, 0};
  std::vector<StrainList> lists;
  for (const auto& history : histories) lists.push_back({history.data(), history.size()});

  for (const auto mean_stress : {MeanStress::swt, MeanStress::none, MeanStress::morrow}) {
    pipeline::Fatigue settings;
    settings.mean_stress = mean_stress;
    for (const pipeline::InstructionSet set : pipeline::instruction_sets()) {
      INFO(pipeline::name_of(set));
      const DamageCounter counter(copper(), settings, set);
      DamageCounter::Workspace workspace;
      std::vector<double> alone, together(lists.size()), shifted(lists.size() - 1);
      for (const auto& history : histories) alone.push_back(counter(history, workspace));
      counter(lists, together, workspace);
      CHECK(together == alone);
      counter(std::span(lists).subspan(1), shifted, workspace);
      CHECK(shifted == std::vector<double>(alone.begin() + 1, alone.end()));
      for (std::size_t k = 0; k < histories.size(); ++k) {
        const auto reversals = find_reversals(std::vector<double>(histories[k].begin(), histories[k].end()));
        const double exact = sum_of_damage(evaluate_cycles(reversals, copper(), settings));
        CHECK(together[k] == Approx(exact).epsilon(DamageCounter::table_error).margin(0));
      }
    }
  }
}

TEST_CASE("a polymer's damage is its table's, whatever the settings of metals") {
  pipeline::Material hose;
  hose.name = "hose";
  hose.youngs_modulus = 0.4e9;
  hose.strain_life_table = {{0.1, 1e3}, {0.01, 1e5}, {0.005, 1e8}};
  std::mt19937 random(36);
  DamageCounter::Workspace workspace;
  for (const auto mean_stress : {MeanStress::none, MeanStress::swt}) {
    pipeline::Fatigue settings;
    settings.mean_stress = mean_stress;
    settings.endurance_strain = 0.004;
    const DamageCounter counter(hose, settings);
    // +-0.05 about any mean, plus a ripple below the endurance strain
    const std::vector<float> swing{0.06f, 0.062f, 0.061f, -0.04f};
    CHECK(counter(swing, workspace) ==
          Approx(StrainLifeTable(hose.strain_life_table).damage((0.062f + 0.04f) / 2)).epsilon(same_sum));
    for (int trial = 0; trial < 50; ++trial) {
      const auto history = random_history(random, 200, 0.01);
      const double exact = sum_of_damage(evaluate_cycles(history, hose, settings));
      CHECK(exact > 0);
      CHECK(counter(strains_of(history), workspace) == Approx(exact).epsilon(same_sum));
      CHECK(sum_of_damage(counter.cycles(history)) == Approx(exact).epsilon(same_sum));
    }
  }
}

TEST_CASE("histories that do not alternate do the damage of their reversals") {
  std::mt19937 random(35);
  std::uniform_int_distribution<int> level(-4, 4);  // few levels give plateaus, ties and runs in one direction
  const pipeline::Fatigue settings;
  const DamageCounter counter(copper(), settings);
  DamageCounter::Workspace workspace;
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<float> samples;
    for (int i = 0; i < 2 + trial % 30; ++i) samples.push_back(0.003f * level(random));
    const auto reversals = find_reversals(std::vector<double>(samples.begin(), samples.end()));
    const double exact = sum_of_damage(evaluate_cycles(reversals, copper(), settings));
    CHECK(counter(samples, workspace) == Approx(exact).epsilon(DamageCounter::table_error));
  }
}

TEST_CASE("stress of the repeated history: mirrored strains mirror the stresses") {
  std::mt19937 random(32);
  pipeline::Fatigue settings;
  for (int trial = 0; trial < 50; ++trial) {
    auto history = random_history(random, 60, 0.003);
    const auto cycles = evaluate_cycles(history, copper(), settings);
    for (Reversal& r : history) r.strain = -r.strain;
    const auto mirrored = evaluate_cycles(history, copper(), settings);
    REQUIRE(cycles.size() == mirrored.size());
    for (std::size_t i = 0; i < cycles.size(); ++i) CHECK(cycles[i].stress_mean == -mirrored[i].stress_mean);
  }
}

TEST_CASE("a second repeat is like the first: twice the history does twice the damage") {
  std::mt19937 random(33);
  pipeline::Fatigue settings;
  for (int trial = 0; trial < 50; ++trial) {
    auto history = random_history(random, 80, 0.003);
    const double once = sum_of_damage(evaluate_cycles(history, copper(), settings));
    auto twice = history;
    for (Reversal r : history) {
      r.sample += 80;
      twice.push_back(r);
    }
    constexpr double rounding = 1e-9;  // relative: a few hundred exact lives
    CHECK(sum_of_damage(evaluate_cycles(twice, copper(), settings)) == Approx(2 * once).epsilon(rounding));
  }
}

TEST_CASE("damage placed in time and by step sums to the whole") {
  constexpr std::size_t samples = 700, steps = 9;
  std::mt19937 random(34);
  for (const auto counting : {Counting::repeating, Counting::half_cycles}) {
    pipeline::Fatigue settings;
    settings.counting = counting;
    const auto cycles = evaluate_cycles(random_history(random, samples, 0.002), copper(), settings);
    const double total = sum_of_damage(cycles);
    REQUIRE(total > 0);
    const auto in_time = damage_over_time(cycles, samples);
    REQUIRE(in_time.size() == samples);
    CHECK(std::accumulate(in_time.begin(), in_time.end(), 0.0) == Approx(total).epsilon(same_sum));
    std::vector<std::int32_t> step;
    for (std::size_t t = 0; t < samples; ++t) step.push_back(static_cast<std::int32_t>(t * steps / samples));
    const auto by_step = damage_by_step(in_time, step, steps);
    REQUIRE(by_step.size() == steps);
    CHECK(std::accumulate(by_step.begin(), by_step.end(), 0.0) == Approx(total).epsilon(same_sum));
    const auto opened = damage_over_time(cycles, samples, Moment::opens);
    CHECK(std::accumulate(opened.begin(), opened.end(), 0.0) == Approx(total).epsilon(same_sum));
    step.assign(samples, -1);  // outside any line
    CHECK(damage_by_step(in_time, step, steps) == std::vector<double>(steps, 0.0));
  }
}

TEST_CASE("damage stands where its cycle ends, in the original order of time") {
  // From the largest strain at sample 3 the period is 3 4 | 0 1 2 3: the small cycle 1-2 and the large cycle 3-0.
  pipeline::Fatigue settings;
  const std::vector<Reversal> history{{-0.01, 0}, {0.005, 1}, {0.002, 2}, {0.02, 3}, {-0.009, 4}};
  const auto cycles = evaluate_cycles(history, copper(), settings);
  REQUIRE(cycles.size() == 2);
  CHECK((cycles[0].cycle.begin.sample == 1 && cycles[0].cycle.end.sample == 2));
  CHECK((cycles[1].cycle.begin.sample == 3 && cycles[1].cycle.end.sample == 0));
  const auto in_time = damage_over_time(cycles, 5);
  CHECK(in_time == std::vector<double>{cycles[1].damage, 0, cycles[0].damage, 0, 0});
  CHECK(damage_over_time(cycles, 5, Moment::opens) == std::vector<double>{0, cycles[0].damage, 0, cycles[1].damage, 0});
}

TEST_CASE("histories without cycles do no damage") {
  const DamageCounter counter(copper(), {});
  DamageCounter::Workspace workspace;
  CHECK(counter(std::vector<float>{}, workspace) == 0);
  CHECK(counter(std::vector<float>{0.1f}, workspace) == 0);
  CHECK(counter(std::vector<float>{0.1f, 0.1f}, workspace) == 0);
  CHECK(counter(std::vector<float>{0, 0}, workspace) == 0);
  CHECK(evaluate_cycles({}, copper(), {}).empty());
  CHECK(evaluate_cycles(std::vector<Reversal>{{0.1, 0}}, copper(), {}).empty());
}

TEST_CASE("two reversals that are counted once are half a cycle") {
  pipeline::Fatigue settings;
  settings.counting = Counting::half_cycles;
  const DamageCounter counter(copper(), settings);
  DamageCounter::Workspace workspace;
  const std::vector<float> strains{0.004f, -0.004f};
  const std::vector<DamagingCycle> cycles =
      evaluate_cycles(find_reversals(std::vector<double>{0.004f, -0.004f}), copper(), settings);
  REQUIRE(cycles.size() == 1);
  CHECK(cycles[0].cycle.count == 0.5);
  CHECK(counter(strains, workspace) == Approx(cycles[0].damage).epsilon(DamageCounter::table_error));
}

TEST_CASE("damage sums, life, hours and months") {
  // dpzhuX/ffpack (commit b90bdeca), miner rule: counts and cycles to failure
  const auto miner = [](const std::vector<std::pair<double, double>>& sets) {
    std::vector<DamagingCycle> cycles;
    for (const auto& [count, life] : sets) cycles.emplace_back().damage = count / life;
    return sum_of_damage(cycles);
  };
  constexpr double sum_rounding = 1e-12;
  CHECK(miner({{10, 100}, {200, 2000}}) == Approx(0.2).epsilon(sum_rounding));
  CHECK(miner({{10, 1000}, {200, 20000}, {50, 500}}) == Approx(0.12).epsilon(sum_rounding));
  CHECK(miner({{1, 100}, {2, 2000}, {3, 30}, {4, 40}}) == Approx(0.211).epsilon(sum_rounding));
  CHECK(miner({{50, 100}, {1000, 2000}, {15, 30}, {40, 40}}) == Approx(2.5).epsilon(sum_rounding));

  CHECK(life_in_repeats(0.036) == Approx(27.7777777777778));
  CHECK(life_in_repeats(0) == std::numeric_limits<double>::infinity());
  CHECK(hours(27.0, 180.0) == Approx(1.35));
}

TEST_CASE("an absurd strain breaks the wire at once, and no more than at once") {
  for (const auto mean_stress : {MeanStress::none, MeanStress::morrow, MeanStress::swt, MeanStress::walker}) {
    pipeline::Fatigue settings;
    settings.mean_stress = mean_stress;
    const DamageCounter counter(aluminium(), settings);
    DamageCounter::Workspace workspace;
    CHECK(counter(std::vector<float>{0, 3, -3, 0}, workspace) == 2);
    CHECK(counter(std::vector<float>{0, 1e30f, -1e30f, 0}, workspace) == 2);
  }
}
