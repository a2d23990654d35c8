// Laws of kinks and wear beside published tests: verdicts, mistakes in the file, and the shipped file.
#include "pipeline/advise/calibrate/law_tests.h"

#include <cmath>

#include "pipeline/cable/kink.h"
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
  tube.allowed_at = kink.high * 2;  // a maker's limit only bounds from above
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
                    Contains("laws.yaml:2") && Contains("either tube or wear"));
  CHECK_THROWS_WITH(
      reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 9, kinks_at_mm: 20}}")(),
      Contains("bore"));
  CHECK_THROWS_WITH(reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 6}}")(),
                    Contains("kinks_at_mm"));
  CHECK_THROWS_WITH(
      reading("{name: a, what: b, source: c, tube: {outer_mm: 8, bore_mm: 6, kinks_at_mm: -1}}")(),
      Contains("kinks_at_mm"));
  const auto pair = reading(
      "{name: a, what: b, source: c, wear: {material: pvc, against: dresspack, force_N: 1, way_m: 1, worn_mm3: 1}}")();
  CHECK_THROWS_WITH(predicted(pair.at(0)), Contains("no wear rate against dresspack"));
}

TEST_CASE("law tests: the shipped file, with its misses") {
  const auto tests =
      read_law_tests(std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/observations/laws.yaml");
  int misses = 0, independent = 0;
  for (const LawTest& test : tests) {
    const std::string verdict = verdict_of(test, predicted(test));
    if (test.sets_constant) continue;
    ++independent;
    if (!verdict.starts_with("MISS")) continue;
    ++misses;
    // PTFE yields before it is oval, the widest tube is oval later than predicted, a lubricated pair wears less.
    CHECK(
        (test.name.starts_with("zeus_") || test.name == "smc_16x13_oval" || test.name == "pa66_on_pom_ptfe"));
  }
  CHECK(independent == 33);
  CHECK(misses == 8);
}
