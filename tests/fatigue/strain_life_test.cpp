// Lives from the strain-life curves: published numbers, round trips, limits, and the thesis' own magnitudes.
#include "fatigue/strain_life.h"

#include <cmath>

#include "fatigue/stress_path.h"
#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;
using pipeline::MeanStress;

namespace {

constexpr double published = 1e-9;    // relative; the tolerance of the published values
constexpr double round_trip = 1e-12;  // relative; rounding of a logarithm times its slope

// dfieser/lcf-strain-life (commit a6a8d40c), tests/test_life.py; MPa. Lives recomputed in 40 digits.
const pipeline::Material lcf_steel = material(200000, 1000, -0.09, 0.5, -0.6);

}  // namespace

TEST_CASE("Coffin-Manson: amplitudes of published constants, both ways") {
  const StrainLife life(lcf_steel, MeanStress::none);
  const std::vector<std::pair<double, double>> points{{1, 0.505},
                                                      {2, 0.334574591439294},
                                                      {500, 0.0148692474952436},
                                                      {5e3, 0.00534016034829881},
                                                      {5e4, 0.00264612224243238},
                                                      {5e5, 0.00172520396246364},
                                                      {1e7, 0.00120366227488397},
                                                      {1e9, 0.000776398845309008}};
  for (const auto& [reversals, amplitude] : points) {
    CHECK(life.coffin_manson()(reversals) == Approx(amplitude).epsilon(published));
    CHECK(life.reversals({amplitude, 0, 0}) == Approx(reversals).epsilon(published));
    CHECK(life.damage({amplitude, 0, 0}) == Approx(2 / reversals).epsilon(published));
  }
}

TEST_CASE("Morrow and SWT lives of published constants") {
  const StrainLife morrow(lcf_steel, MeanStress::morrow);
  for (const auto& [amplitude, reversals] :
       {std::pair{0.002, 101850.469774385}, {0.004, 8958.30094430476}, {0.01, 1043.11826123657}}) {
    CHECK(morrow.reversals({amplitude, 0, 150}) == Approx(reversals).epsilon(published));
  }
  for (const auto& [amplitude, reversals] :
       {std::pair{0.002, 426386.300194293}, {0.004, 14752.4095232958}, {0.01, 1238.23569872552}}) {
    CHECK(morrow.reversals({amplitude, 0, -150}) == Approx(reversals).epsilon(published));
  }
  const StrainLife swt(lcf_steel, MeanStress::swt);
  for (const auto& [parameter, reversals] :
       {std::pair{0.3, 7296780.92600749}, {1.0, 49895.1213711346}, {3.0, 3368.03902870194}, {10.0, 380.840947408087}}) {
    CHECK(swt.reversals({0.01, parameter / 0.01, 0}) == Approx(reversals).epsilon(published));
  }
}

TEST_CASE("SWT life of a loop whose stress comes from the cyclic curve") {
  // MatthewReid854/reliability (commit 86c93307), example 4: printed 27542.78 reversals; MPa
  const CyclicCurve curve(210000, 1200, 0.2);
  CHECK(curve.stress(0.0049) == Approx(377.970200230703).epsilon(published));
  const StrainLife life(material(210000, 1000, -0.1, 1.1, -0.6), MeanStress::swt);
  CHECK(life.reversals({0.0039, curve.stress(0.0049), 0}) == Approx(27542.7846145343).epsilon(published));
}

TEST_CASE("lives measured on SAE 1137 steel lie near the curve fitted to them") {
  // Williams, Lee and Rilly, Int. J. Fatigue 25 (2003), tables 4 and 5: plastic amplitude, measured reversals.
  constexpr double ductility = 1.104, exponent = -0.6207;
  const double rows[][3] = {{0.006344, 4234, 4071.97306145664},
                            {0.004477, 7398, 7139.7748368305},
                            {0.002779, 14768, 15393.5124096982},
                            {0.001075, 77104, 71101.3578243085}};
  // With a strength term of 1e-12 times the measured one, (8) reduces to its plastic line.
  const StrainLife plastic(material(208e3, 1e-9, exponent / 2, ductility, exponent), MeanStress::none);
  constexpr double scatter_band = 1.6;  // scatter of the tests about their fit
  for (const auto& [amplitude, measured, line] : rows) {
    const double reversals = plastic.reversals({amplitude, 0, 0});
    CHECK(reversals == Approx(line).epsilon(published));
    CHECK(reversals / measured < scatter_band);
    CHECK(measured / reversals < scatter_band);
  }
}

TEST_CASE("life undoes load over the whole range of reversals, for every mean stress") {
  for (const auto& m : {copper(), aluminium()}) {
    for (double reversals = 1.5; reversals < most_reversals; reversals *= 7) {
      const StrainLife none(m, MeanStress::none), swt(m, MeanStress::swt), morrow(m, MeanStress::morrow);
      CHECK(none.reversals({none.coffin_manson()(reversals), 0, 0}) == Approx(reversals).epsilon(round_trip));
      CHECK(swt.reversals({0.5, swt.swt()(reversals) / 0.5, 0}) == Approx(reversals).epsilon(round_trip));
      for (const double mean : {-0.5, 0.0, 0.3, 0.9}) {  // shares of sf'; (F7) written explicitly
        const double amplitude =
            (1 - mean) * m.fatigue_strength / m.youngs_modulus * std::pow(reversals, m.fatigue_strength_exponent) +
            m.fatigue_ductility * std::pow(reversals, m.fatigue_ductility_exponent);
        CHECK(morrow.reversals({amplitude, 0, mean * m.fatigue_strength}) == Approx(reversals).epsilon(round_trip));
      }
    }
  }
}

TEST_CASE("limits: endurance, compression, beyond either end of the curve") {
  const auto cu = copper();
  const StrainLife swt(cu, MeanStress::swt), none(cu, MeanStress::none), morrow(cu, MeanStress::morrow);
  CHECK(StrainLife(cu, MeanStress::none, 0.01).damage({0.01, 1e8, 0}) == 0);
  CHECK(StrainLife(cu, MeanStress::none, 0.01).damage({0.0101, 1e8, 0}) == none.damage({0.0101, 1e8, 0}));
  CHECK(swt.damage({0.01, 0, -1e8}) == 0);
  CHECK(swt.damage({0.01, -1e6, -1e8}) == 0);
  CHECK(none.damage({0, 0, 0}) == 0);
  CHECK(none.reversals({1e-6, 0, 0}) == infinity);  // more than 1e15 reversals
  CHECK(none.damage({1e-6, 0, 0}) == 0);
  // Above sf'/E + ef' = 2.438 the wire breaks in the first reversal.
  CHECK(none.reversals({2.43, 0, 0}) > 1);
  CHECK(none.reversals({2.5, 0, 0}) == 1);
  CHECK(none.damage({1e6, 0, 0}) == 2);
  CHECK(swt.damage({1e6, 1e12, 0}) == 2);
  CHECK(morrow.damage({1e-4, 0, 983e6}) == 2);  // mean stress at sf'
  CHECK(morrow.damage({1e-4, 0, 2e9}) == 2);
}

TEST_CASE("thesis materials: aluminium dies first, and elastic stress cuts copper's life") {
  const auto swt_life = [](const pipeline::Material& m, double amplitude, bool cyclic) {
    const double stress = cyclic ? CyclicCurve(m).stress(amplitude) : m.youngs_modulus * amplitude;
    return StrainLife(m, MeanStress::swt).reversals({amplitude, stress, 0});
  };
  // Elastic copper at 2.5 %: 2.9 GPa; yielded: about 0.4 GPa (physics of fatigue/README.md).
  CHECK(117e9 * 0.025 == Approx(2.925e9));
  CHECK(CyclicCurve(copper()).stress(0.025) > 0.38e9);
  CHECK(CyclicCurve(copper()).stress(0.025) < 0.42e9);
  for (const double amplitude : {0.01, 0.025}) {
    CHECK(swt_life(copper(), amplitude, true) > 1.5 * swt_life(aluminium(), amplitude, true));
    CHECK(swt_life(copper(), amplitude, false) > 1.1 * swt_life(aluminium(), amplitude, false));
    CHECK(swt_life(copper(), amplitude, true) > 3 * swt_life(copper(), amplitude, false));
  }
  // A stable loop about zero lies on the curve, where s = sf' (2N)^b (F5) makes (9) identical to (8).
  for (const double amplitude : {0.0005, 0.001, 0.01, 0.025}) {
    CHECK(swt_life(copper(), amplitude, true) ==
          Approx(StrainLife(copper(), MeanStress::none).reversals({amplitude, 0, 0})).epsilon(published));
  }
}

TEST_CASE("Walker: (8) at zero mean, SWT's amplitude at gamma 1/2, no mean stress effect at gamma 1") {
  auto m = copper();
  const StrainLife half(m, MeanStress::walker), none(m, MeanStress::none);
  CHECK(half.reversals({0.002, 300e6, 0}) == Approx(none.reversals({0.002, 0, 0})).epsilon(round_trip));
  CHECK(half.reversals({0.002, -1, -300e6}) == infinity);
  CHECK(half.reversals({0.002, 0, -300e6}) == infinity);
  m.walker_exponent = 1;
  CHECK(StrainLife(m, MeanStress::walker).reversals({0.002, 300e6, 100e6}) ==
        Approx(none.reversals({0.002, 0, 0})).epsilon(round_trip));
  // While a wire stays elastic, (8) is sf' (2N)^b = stress amplitude. Walker's equivalent amplitude s_max^(1-gamma) s_a^gamma
  // must give the same life in it.
  for (const double gamma : {0.3, 0.5, 0.8}) {
    auto elastic = copper();
    elastic.fatigue_ductility = 1e-9;  // no plastic strain
    elastic.walker_exponent = gamma;
    for (const double mean : {70e6, -40e6}) {
      const double max = 150e6, amplitude = max - mean;
      const double equivalent = std::pow(max, 1 - gamma) * std::pow(amplitude, gamma);
      CHECK(StrainLife(elastic, MeanStress::walker).reversals({amplitude / elastic.youngs_modulus, max, mean}) ==
            Approx(std::pow(equivalent / elastic.fatigue_strength, 1 / -0.112)).epsilon(1e-4));  // 1e-9 of ductility
    }
  }
}

TEST_CASE("strain-life table: through its points, straight in logarithms, on beyond its ends, and bounded") {
  const StrainLifeTable table({{0.1, 1e3}, {0.01, 1e5}, {0.005, 1e8}});
  CHECK(table.cycles(0.1) == Approx(1e3).epsilon(round_trip));
  CHECK(table.cycles(0.01) == Approx(1e5).epsilon(round_trip));
  CHECK(table.cycles(0.005) == Approx(1e8).epsilon(round_trip));
  CHECK(table.cycles(std::sqrt(0.1 * 0.01)) == Approx(1e4).epsilon(round_trip));
  CHECK(table.cycles(0.2) == Approx(1e3 / 4).epsilon(round_trip));  // slope -2 of the first piece
  CHECK(table.cycles(0.0025) == Approx(1e11).epsilon(round_trip));  // slope -3/log10(2) of the last
  CHECK(table.damage(0.01) == Approx(1e-5).epsilon(round_trip));
  CHECK(table.cycles(100) == 0.5);
  CHECK(table.cycles(1e-5) == infinity);
  CHECK(table.damage(0) == 0);
  // Points of a power law reproduce the power law between and beyond them.
  const auto power = [](double strain) { return 2e-3 * std::pow(strain, -4.5); };
  const StrainLifeTable line({{0.08, power(0.08)}, {0.03, power(0.03)}, {0.004, power(0.004)}});
  for (const double strain : {0.1, 0.05, 0.02, 0.004, 0.003})
    CHECK(line.cycles(strain) == Approx(power(strain)).epsilon(round_trip));
}
