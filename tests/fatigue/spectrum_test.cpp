// Stress spectra, residue rules and classes against published numbers.
#include "fatigue/spectrum.h"

#include <cmath>
#include <limits>

#include "tests/catch.h"

using namespace dresslife::fatigue;

TEST_CASE("elementary Miner: Haibach's example") {
  // E. Haibach, Betriebsfestigkeit (2006), p. 271: 2,167,330 cycles to failure; MPa
  const std::vector<SpectrumStep> spectrum{{100, 900000}, {150, 90000}, {200, 9000},
                                           {250, 900},    {300, 90},    {350, 10}};
  constexpr double rounding = 1e-12;  // relative: a sum of six powers
  const StressLife line{125, 2e6, 7};
  CHECK(line.damage(spectrum) == Approx(0.4613965168640001).epsilon(rounding));
  CHECK(1000000 / line.damage(spectrum) == Approx(2167333.223052393).epsilon(rounding));
}

TEST_CASE("consistent Miner: life multiples of FVA/FKM table 3.2-6") {
  // As printed in a-ma72/rainflow (commit 688ffffb), test of consistent Miner: cycles to failure of the
  // spectrum over those of its largest amplitude alone, for largest amplitudes from S_D to 8 S_D.
  const std::vector<double> share{0.125, 0.275, 0.425, 0.575, 0.725, 0.85, 0.95, 1},
      counts{605000, 280000, 92000, 20000, 2720, 280, 16, 2},
      largest{100, 105, 110, 115, 125, 150, 175, 200, 250, 300, 350, 400, 500, 600, 700, 800},
      multiple{89199.59, 24445.83, 14414.85, 6980.954, 2089.658, 556.181, 253.551, 219.482,
               152.775,  144.658,  133.296,  129.536,  129.245,  128.81,  128.205, 127.398};
  const StressLife line{100, 1e6, 4};
  constexpr double printed = 0.1;  // absolute, the vector's own tolerance: the table has 6 to 7 digits
  for (std::size_t i = 0; i < largest.size(); ++i) {
    std::vector<SpectrumStep> spectrum;
    double total = 0;
    for (std::size_t k = 0; k < share.size(); ++k) {
      spectrum.push_back({share[k] * largest[i], counts[k]});
      total += counts[k];
    }
    const double found = line.spectra_to_failure(spectrum) * total / line.cycles(largest[i]);
    CHECK(found == Approx(multiple[i]).margin(printed).epsilon(0));
  }
  const std::vector<SpectrumStep> harmless{{99, 1e9}};
  CHECK(line.spectra_to_failure(harmless) == std::numeric_limits<double>::infinity());
  // One amplitude above the limit: Miner's plain answer.
  const std::vector<SpectrumStep> single{{200, 1000}};
  CHECK(line.spectra_to_failure(single) == Approx(1 / line.damage(single)));
}

TEST_CASE("equivalent ranges of Walker, SWT and Morrow") {
  // Gunnstein/fatpack (commit 951929f9), after Dowling, Calhoun and Arcari, FFEMS 32 (2009)
  const std::vector<double> range{10, 30, 24, 90}, mean{20, 40, 32, 0};
  constexpr double printed = 1e-6;  // relative, the vector's own tolerance
  const auto check = [&](const auto& equivalent, const std::vector<double>& expected) {
    for (std::size_t i = 0; i < range.size(); ++i) {
      CHECK(equivalent(range[i], mean[i]) == Approx(expected[i]).epsilon(printed));
    }
  };
  const std::vector<std::pair<double, std::vector<double>>> walker{
      {0.1, {42.566996, 96.597423, 77.277939, 90}}, {0.3, {30.851693, 74.492278, 59.593822, 90}},
      {0.5, {22.36068, 57.445626, 45.956501, 90}},  {0.7, {16.206566, 44.299894, 35.439915, 90}},
      {0.9, {11.746189, 34.162402, 27.329922, 90}}, {1.0, {10, 30, 24, 90}}};
  for (const auto& [gamma, expected] : walker) {
    check([g = gamma](double r, double m) { return walker_range(r, m, g); }, expected);
  }
  check(swt_range, {22.36068, 57.445626, 45.956501, 90});
  check([](double r, double m) { return morrow_range(r, m, 510); }, {10.408163, 32.553191, 25.606695, 90});
  check([](double r, double m) { return morrow_range(r, m, 720); }, {10.285714, 31.764706, 25.116279, 90});
}

TEST_CASE("classed reversals of the ISO 12110-2 history") {
  // Gunnstein/fatpack (commit 951929f9), test data after ISO 12110-2
  const std::vector<double> history{4.2, 7.3,  2.0, 9.8, 9.6, 10.3, 5.2, 8.5,  3.0, 4.4, 2.2, 2.4, 2.2, 12.0,
                                    5.5, 11.1, 1.0, 4.3, 3.5, 9.5,  6.0, 12.0, 3.9, 8.3, 1.2, 8.6, 3.9, 6.2};
  std::vector<double> found;
  for (const Reversal& r : classed_reversals(history, 11)) found.push_back(r.strain);
  CHECK(found ==
        std::vector<double>{4, 7, 2, 10, 5, 9, 3, 4, 2, 12, 5, 11, 1, 4, 3, 10, 6, 12, 4, 8, 1, 9, 4, 6});
  CHECK(classed_reversals(history, 11)[3] == Reversal{10, 3});  // where the class is first reached
}

TEST_CASE("residue by DIN 45667: rises and falls paired by size") {
  // a-ma72/rainflow (commit 688ffffb), test of the DIN 45667 residue
  const auto residue = find_reversals(std::vector<double>{5, 6, 4, 7, 3, 9, 5, 8, 7});
  CHECK(paired_ranges(residue) == std::vector<double>{4, 3, 2, 1});
}
