// Laws of kinks, wear and bending against published tests: verdicts, mistakes in the file, and the shipped file.
#include "pipeline/advise/calibrate/law_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "pipeline/cable/kink.h"
#include "pipeline/cable/polymer.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

LawTest of_tube(TubeTest tube) {
  LawTest test;
  test.name = "tube", test.tube = tube;
  return test;
}

}  // namespace

TEST_CASE("law tests: a tube's radii are judged by what they say") {
  TubeTest tube{0.01, 0.008, {}, {}, {}, 0.05};
  const LawPrediction kink = predicted(of_tube(tube));
  CHECK(kink.median == Approx(kink_radius(Tube{0.01, 0.008}).median));
  CHECK(kink.high / kink.median == Approx(std::pow(10, 0.1 * 1.28155)).epsilon(1e-4));
  tube.kinks_at = kink.median * 1.1;
  CHECK(verdict_of(of_tube(tube), kink) == "agrees");
  tube.kinks_at = kink.high * 2;
  CHECK(verdict_of(of_tube(tube), kink) == "MISS: too small by 2.0");
  tube.kinks_at = kink.low / 2;
  CHECK(verdict_of(of_tube(tube), kink) == "MISS: too large by 2.0");
  tube.kinks_at.reset();
  tube.allowed_at = kink.high * 2;  // a maker's limit is only an upper bound of the kink's radius
  CHECK(verdict_of(of_tube(tube), kink) == "agrees");
  tube.allowed_at = kink.median * 0.9;
  CHECK(verdict_of(of_tube(tube), kink) == "open");
  tube.allowed_at = kink.low / 3;
  CHECK(verdict_of(of_tube(tube), kink) == "MISS: too large by 3.0");
  LawTest own = of_tube(tube);
  own.sets_constant = true;
  CHECK_THAT(verdict_of(own, kink), Contains("sets a constant"));
  tube.allowed_at.reset();
  tube.oval_at = 0.05;
  const double z = Tube{0.01, 0.008}.ovality(1 / predicted(of_tube(tube)).median);
  CHECK(z == Approx(0.05));
}

TEST_CASE("law tests: mistakes are refused at their line") {
  const Scratch scratch;
  const auto reading = [&](const std::string& row) {
    const auto file = scratch.write("laws.yaml", "law_tests:\n  - " + row + "\n");
    return [file] { return read_law_tests(file); };
  };
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c}")(),
                    Contains("laws.yaml:2") && Contains("one of tube, wear and bending"));
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 9, kinks_at_mm: 20}}")(),
                    Contains("bore"));
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 6}}")(),
                    Contains("kinks_at_mm"));
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 6, kinks_at_mm: -1}}")(),
                    Contains("kinks_at_mm"));
  const auto pair = reading(
      "{name: a, what: b, source: c, wear: {material: pvc, against: dresspack, force_N: 1, way_m: 1, worn_mm3: 1}}")();
  CHECK_THROWS_WITH(predicted(pair.at(0)), Contains("no wear rate against dresspack"));
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c, bending: {curvature_1_per_m: 1, moment_mNm: 1}}")(),
                    Contains("laws.yaml:2") && Contains("bending has no cable"));
  CHECK_THROWS_WITH(
      reading(
          "{name: a, what: b, source: c, bending: {cable: {name: a, source: b, radius_mm: 3, without_wires: {kind: hose, bore_mm: 2}}, "
          "curvature_1_per_m: 1, moment_mNm: 1}}")(),
      Contains("laws.yaml:2") && Contains("has no wires"));
}

TEST_CASE("law tests: a bent cable, whose friction alone is uncertain") {
  const Scratch scratch;
  const auto test_of = [&](const std::string& friction, const std::string& moment) {
    const std::string wire = "{name: wire, count: 1, radius_mm: 0.5, helix_radius_mm: 0, material: copper_halved}";
    const std::string strand =
        "{name: wire, count: 6, radius_mm: 0.5, helix_radius_mm: 1, lay_angle_deg: 5, material: copper_halved, "
        "radial_line_load_N_per_m: 100, friction_coefficient: " +
        friction + "}";
    return read_law_tests(
               scratch.write(
                   "laws.yaml",
                   "law_tests:\n  - {name: a, what: b, source: c, bending: {cable: {name: strand, source: d, radius_mm: 2, components: [" +
                       wire + (friction == "none" ? "" : ", " + strand) +
                       "]}, curvature_1_per_m: 3, moment_mNm: " + moment + "}}\n"))
        .front();
  };
  // One wire on the axis in polymer has only E I.
  const auto second_moment = [](double radius) { return std::acos(-1.0) / 4 * std::pow(radius, 4); };
  const LawTest straight = test_of("none", "1");
  const double E = straight.bending->cable.materials.at(0).youngs_modulus;
  const double moment = 3 * (E * second_moment(0.5e-3) + jacketed_modulus * second_moment(2e-3));
  CHECK(predicted(straight).low == Approx(moment).epsilon(1e-6));
  CHECK(predicted(straight).high == Approx(moment).epsilon(1e-6));
  CHECK(verdict_of(straight, {1e-3, 1e-3, 1e-3}) == "agrees");
  CHECK(verdict_of(straight, {2e-3, 2e-3, 2e-3}) == "MISS: too large by 2.0");
  // Sliding wires hold a moment in proportion to the friction, so its quantiles are those of the friction.
  const double none = predicted(test_of("0", "1")).median;
  const LawPrediction rubs = predicted(test_of("0.003", "1"));
  CHECK((rubs.high - none) / (rubs.median - none) == Approx(std::pow(2.2, 1.28155)).epsilon(1e-3));
  CHECK((rubs.median - none) / (rubs.low - none) == Approx(std::pow(2.2, 1.28155)).epsilon(1e-3));
}

TEST_CASE("law tests: the shipped file, with its misses") {
  const auto tests = read_law_tests(std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/observations/laws.yaml");
  int misses = 0, independent = 0;
  for (const LawTest& test : tests) {
    const std::string verdict = verdict_of(test, predicted(test));
    if (test.sets_constant) continue;
    ++independent;
    if (!verdict.starts_with("MISS")) continue;
    ++misses;
    // Known exceptions: PTFE yields before it is oval, the widest tube becomes oval later than predicted, a lubricated pair wears
    // less, and bent cables are stiffer than predicted at 5 1/m and more.
    const bool soft = test.bending && test.bending->curvature >= 5 && verdict.find("too small") != std::string::npos;
    CHECK((soft || test.name.starts_with("zeus_") || test.name == "smc_16x13_oval" || test.name == "pa66_on_pom_ptfe"));
  }
  CHECK(independent == 49);
  CHECK(misses == 23);
}

TEST_CASE("law tests: the page's table has the verdicts of the shipped file") {
  const std::filesystem::path folder = std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/observations";
  struct Law {
    const char *row, *prefix, *suffix;  ///< of the table; of the names of its tests, which are in no later law
  };
  const std::vector<Law> laws{{"tube of polyamide 12 becomes oval (SMC)", "smc_", "_oval"},
                              {"tube of polyamide 12 collapses (SMC)", "smc_", "_kink"},
                              {"maker's least bend radius, polyamide and polyurethane (CKD)", "ckd_", ""},
                              {"tube of PTFE kinks (Zeus)", "zeus_", ""},
                              {"wear of polyamide (ASTM D3702, RTP)", "pa66_", ""},
                              {"wear of polyurethane below that on abrasive cloth and wheels", "pur_", ""},
                              {"moment of a bent cable, by its data sheet (heart pump leads)", "", ""}};
  struct Count {
    int all = 0, set = 0, agree = 0, miss = 0;
  };
  std::vector<Count> counts(laws.size());
  for (const LawTest& test : read_law_tests(folder / "laws.yaml")) {
    const auto law = std::ranges::find_if(
        laws, [&](const Law& one) { return test.name.starts_with(one.prefix) && test.name.ends_with(one.suffix); });
    Count& count = counts.at(static_cast<std::size_t>(law - laws.begin()));
    ++count.all;
    if (test.sets_constant) {
      ++count.set;
      continue;
    }
    const std::string verdict = verdict_of(test, predicted(test));
    count.agree += verdict == "agrees", count.miss += verdict.starts_with("MISS");
  }
  std::ifstream in(folder / "README.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const Count& of = counts[k];
    INFO(laws[k].row);
    const std::string verdicts = of.set == of.all ? "| | |" : fmt::format("| {} | {} |", of.agree, of.miss);
    CHECK(page.find(fmt::format("| {} | {} | {} {}\n", laws[k].row, of.all, of.set, verdicts)) != std::string::npos);
  }
}
