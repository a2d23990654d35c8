// Cyclic stress: published curves and paths, and a bundle of friction sliders as an independent model of memory.
#include "fatigue/stress_path.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "fatigue/strain_life.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;

namespace {

constexpr double solved = 1e-10;         // relative, of one root; the curve itself rounds at 1e-15 times 1/n'
constexpr double published_path = 1e-8;  // relative; the strains of the example are given to 1e-9

/// Returns the local stress [Pa] of a notch with elastic concentration factor K_t under nominal stress S >= 0 [Pa] by
/// Neuber's rule (Neuber 1961): stress x curve strain = (K_t S)^2 / E. For these tests only: the pipeline has no notches.
/// With s the local stress, s (s/E + (s/K')^(1/n')) is increasing and convex, and the elastic solution K_t S is above the
/// root.
double neuber_stress(const CyclicCurve& curve, double concentration, double nominal_stress) {
  const double elastic = concentration * nominal_stress;
  const double target = elastic * elastic / curve.youngs_modulus();
  if (target == 0) return 0;
  double s = elastic;
  for (;;) {
    const double e = s / curve.youngs_modulus(), p = curve.strain(s) - e;
    const double next = s - (s * (e + p) - target) / (2 * e + p * (1 + 1 / curve.hardening_exponent()));
    if (!(next < s)) return s;
    s = next;
  }
}

MemoryPath path_of(const CyclicCurve& curve) {
  return MemoryPath([curve](double strain) { return curve.stress(strain); });
}

/// Masing's model: parallel elastic-perfectly-plastic sliders. Their strengths make the bundle's virgin curve the polygon
/// through `curve` at equal strain steps. The memory follows from the sliders alone.
class Sliders {
 public:
  Sliders(const CyclicCurve& curve, double largest, int count) : step_(largest / count), plastic_(count, 0.0) {
    std::vector<double> slope;
    for (int i = 0; i <= count; ++i) slope.push_back((curve.stress((i + 1) * step_) - curve.stress(i * step_)) / step_);
    for (int i = 0; i < count; ++i) stiffness_.push_back(slope[i] - slope[i + 1]);
    rest_ = slope[count];
  }
  double go_to(double strain) {
    double stress = rest_ * strain;
    for (std::size_t i = 0; i < plastic_.size(); ++i) {
      const double limit = (i + 1) * step_;
      plastic_[i] = std::clamp(plastic_[i], strain - limit, strain + limit);
      stress += stiffness_[i] * (strain - plastic_[i]);
    }
    return stress;
  }

 private:
  double step_, rest_ = 0;
  std::vector<double> stiffness_, plastic_;
};

}  // namespace

TEST_CASE("Ramberg-Osgood: published points, and stress undoes strain") {
  const CyclicCurve curve(210.5e9, 1078e6,
                          0.133);  // material of pyLife's tests (test_rambgood.py, commit a32a04a6)
  CHECK(curve.strain(700e6) == Approx(0.0422361805756654).epsilon(solved));
  CHECK(curve.strain(1000e6) == Approx(0.573271132704505).epsilon(solved));
  CHECK(2 * curve.strain(1000e6 / 2) == Approx(0.0109506086590071).epsilon(solved));
  CHECK(2 * curve.strain(1100e6 / 2) == Approx(0.0179201627176778).epsilon(solved));
  // lower end of the loop from 1000 MPa back to 0
  CHECK(curve.strain(1000e6) - 2 * curve.strain(1000e6 / 2) == Approx(0.562320524045498).epsilon(solved));
  for (const double strain : {1e-300, 1e-12, 1e-6, 1e-3, 0.01, 0.3, 2.0, 50.0}) {
    CHECK(curve.strain(curve.stress(strain)) == Approx(strain).epsilon(solved));
    CHECK(curve.stress(-strain) == -curve.stress(strain));
  }
  CHECK(curve.stress(0) == 0);
  const CyclicCurve straight(200e9, 1e9, 1);  // n' = 1: two springs in series
  CHECK(straight.stress(0.01) == Approx(0.01 / (1 / 200e9 + 1 / 1e9)).epsilon(solved));
}

TEST_CASE("cyclic constants follow by compatibility, and a contradiction is reported") {
  auto cu = copper();
  const CyclicCurve curve(cu);
  CHECK(curve.hardening_exponent() == Approx(0.112 / 0.6).epsilon(solved));
  CHECK(curve.strength() == Approx(983e6 / std::pow(2.43, 0.112 / 0.6)).epsilon(solved));
  CHECK_FALSE(compatibility_warning(cu));
  cu.cyclic_hardening_exponent = 0.185;  // within a tenth of 0.1867
  CHECK_FALSE(compatibility_warning(cu));
  cu.cyclic_hardening_exponent = 0.3;
  CHECK_THAT(compatibility_warning(cu)->words, Catch::Contains("n' 0.3 disagree with its strain-life curve"));
  cu.cyclic_hardening_exponent.reset();
  cu.cyclic_strength = 400e6;
  CHECK_THAT(compatibility_warning(cu)->words, Catch::Contains("K' 400 MPa"));
  CHECK(CyclicCurve(cu).strength() == 400e6);
}

TEST_CASE("one loop in tension first: virgin curve, then the doubled branch") {
  // MatthewReid854/reliability (commit 86c93307), stress-strain documentation, example 3; MPa
  MemoryPath path = path_of(CyclicCurve(210000, 1200, 0.2));
  CHECK(path.go_to(0) == 0);
  CHECK(path.go_to(0.004901364196875) == Approx(378.0).epsilon(solved));
  CHECK(path.go_to(-0.00289825085308315) == Approx(-328.893112180035).epsilon(solved));
}

TEST_CASE("FKM guideline nonlinear, example 2.7.1: all three memory rules") {
  // Local strains of the example (table 2.24) and their stresses in MPa, recomputed in 40 digits.
  const double a = 0.0007036470410748222, b = -0.0015512506334457359, c = 0.0006321155636208129,
               d = -0.0020992089445538275, e = 0.0015286438873120603, f = 0.00012134980516241589,
               g = -0.0015738573795794114, h = 0.0006095088174871374;
  const std::vector<double> strains{a, b, c, d, e, f, e, g, h, g, h, d, e, f, e, g};
  const std::vector<double> stresses{142.462718300587, -258.875485017123, 154.491647247346, -299.686083434657,
                                     261.296797817144, -23.6286387840294, 261.296797817144, -256.454172217102,
                                     156.912960047367, -256.454172217102, 156.912960047367, -299.686083434657,
                                     261.296797817144, -23.6286387840294, 261.296797817144, -256.454172217102};
  MemoryPath path = path_of(CyclicCurve(206000, 1184, 0.187));
  for (std::size_t i = 0; i < strains.size(); ++i) {
    INFO(i);
    CHECK(path.go_to(strains[i]) == Approx(stresses[i]).epsilon(published_path));
  }
  const auto amplitude_mean = [&](int i, int j) {
    return std::pair{std::fabs(stresses[i] - stresses[j]) / 2, (stresses[i] + stresses[j]) / 2};
  };
  CHECK(amplitude_mean(7, 8).first == Approx(206.6835661322347).epsilon(published_path));  // loops of the second run
  CHECK(amplitude_mean(7, 8).second == Approx(-49.77060608486758).epsilon(published_path));
  CHECK(amplitude_mean(12, 13).first == Approx(142.46271830058677).epsilon(published_path));
  CHECK(amplitude_mean(3, 12).first == Approx(280.49144062590045).epsilon(published_path));
}

TEST_CASE("notch of Dowling's 7075-T6 example by Neuber's rule") {
  // N. E. Dowling, Mechanical Behavior of Materials, table 14.1 and the notched-member history; MPa, recomputed.
  const CyclicCurve curve(71000, 977, 0.106);
  const auto stress = [&](double nominal) { return neuber_stress(curve, 4, nominal); };
  MemoryPath stress_path(stress), strain_path([&](double nominal) { return curve.strain(stress(nominal)); });
  const std::vector<double> nominal{0,   336,  48.3, 336,  48.3, 292,  48.3, 255,   48.3, 219,   48.3, 181,   48.3,
                                    143, 48.3, 105,  48.3, 67.6, 48.3, 67.6, -19.3, 48.3, -67.6, 48.3, -67.6, 336};
  const double low = -343.986749493528, low_strain = 0.0195721902137123;
  const std::vector<double> stresses{0,
                                     670.118981741784,
                                     low,
                                     670.118981741784,
                                     low,
                                     574.934387724122,
                                     low,
                                     465.574073578862,
                                     low,
                                     335.484122629028,
                                     low,
                                     186.490348798986,
                                     low,
                                     34.7997835572959,
                                     low,
                                     -117.186856115291,
                                     low,
                                     -266.786749497626,
                                     low,
                                     -266.786749497626,
                                     -442.848564759689,
                                     -172.449124840404,
                                     -494.205483000857,
                                     -30.6959010661219,
                                     -494.205483000857,
                                     670.118981741784};
  const std::vector<double> strains{0,
                                    0.0379654252541071,
                                    low_strain,
                                    0.0379654252541071,
                                    low_strain,
                                    0.0341366523537383,
                                    low_strain,
                                    0.0314652363579316,
                                    low_strain,
                                    0.0292362104846295,
                                    low_strain,
                                    0.0270527972314297,
                                    low_strain,
                                    0.0249075911634019,
                                    low_strain,
                                    0.0227665579126111,
                                    low_strain,
                                    0.020659514157432,
                                    low_strain,
                                    0.020659514157432,
                                    0.0124049132956818,
                                    0.0162133718883843,
                                    0.00643789681368202,
                                    0.0129687480207716,
                                    0.00643789681368202,
                                    0.0379654252541071};
  constexpr double published = 1e-9;  // relative; the vector's own tolerance
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    INFO(i);
    CHECK(stress_path.go_to(nominal[i]) == Approx(stresses[i]).epsilon(published).margin(published));
    CHECK(strain_path.go_to(nominal[i]) == Approx(strains[i]).epsilon(published).margin(published));
  }

  // Cycles of each level's outer loop by SWT, and blocks of the whole programme to failure.
  const StrainLife life(material(71000, 1466, -0.143, 0.262, -0.619), pipeline::MeanStress::swt);
  const std::vector<std::pair<double, double>> amplitude_max{
      {0.0157637642202125, 670.118981741784},  {0.0091966175201974, 670.118981741784},
      {0.00728223107001298, 574.934387724122}, {0.00594652307210966, 465.574073578862},
      {0.00483201013545857, 335.484122629028}, {0.0037403035088587, 186.490348798986},
      {0.00266770047484482, 34.7997835572959}, {0.00159718384944938, -117.186856115291}};
  const std::vector<double> count{1,   11,  35,  88,
                                  180, 300, 510, 780};  // the last level is in compression and has no effect
  const std::vector<double> cycles{159.645925615254, 504.251997395751, 1274.33498206718, 3821.09445509244,
                                   18512.92202959,   287632.055780832, 307595727.596641};
  double damage = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const double one = life.damage({amplitude_max[i].first, amplitude_max[i].second, 0});
    if (i < cycles.size()) CHECK(1 / one == Approx(cycles[i]).epsilon(published));
    damage += count[i] * one;
  }
  CHECK(1 / damage == Approx(11.1930311960313).epsilon(published));
}

TEST_CASE("memory agrees with a bundle of friction sliders on random paths") {
  const CyclicCurve curve(copper());
  constexpr double largest = 0.02;
  constexpr int sliders = 4000, steps_per_strain = sliders / 2;
  std::mt19937 random(21);
  std::uniform_int_distribution<int> level(-steps_per_strain, steps_per_strain);
  for (int trial = 0; trial < 20; ++trial) {
    MemoryPath path = path_of(curve);
    Sliders bundle(curve, largest, sliders);
    for (int i = 0; i < 60; ++i) {
      // Even multiples of the polygon's step: half ranges end on its corners, and both models agree to rounding.
      const double strain = 2 * level(random) * (largest / sliders);
      constexpr double bundle_rounding = 1e-9;  // relative to 300 MPa: 4000 additions
      CHECK(path.go_to(strain) == Approx(bundle.go_to(strain)).margin(300e6 * bundle_rounding));
    }
  }
}

TEST_CASE("samples between reversals change nothing") {
  const CyclicCurve curve(aluminium());
  std::mt19937 random(22);
  std::uniform_real_distribution<double> strain(-0.02, 0.02);
  MemoryPath direct = path_of(curve), fine = path_of(curve);
  double at = 0;
  for (int i = 0; i < 200; ++i) {
    const double to = strain(random);
    for (int k = 1; k < 7; ++k) fine.go_to(at + (to - at) * k / 7);
    CHECK(fine.go_to(to) == Approx(direct.go_to(to)).epsilon(solved).margin(1e-2));
    at = to;
  }
}
