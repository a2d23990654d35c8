// One hour of a program beside the rating of a cable: which conductors are that cable's, and the quotient of the lives.
#include "pipeline/study/relative_life.h"

#include <regex>

#include "pipeline/base/lists.h"
#include "pipeline/study/rate.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {

TEST_CASE("relative life: the conductors of a cable are those of its path, whatever begins or numbers its name") {
  const Scratch scratch;
  const auto row_of = [&](const std::string& job, const std::vector<std::pair<std::string, double>>& conductors) {
    SampleLife life;
    life.segments = 4, life.lines = 1, life.samples = 3;
    life.conductors = conductors;
    RankingRow row;
    row.job = job, row.life_file = scratch / (job + ".h5"), row.repeat_seconds = 36;
    write_sample_life(row.life_file, life);
    return row;
  };
  constexpr double cycles = 7000, other = 50, sought = 20;  // of the rig; repeats of the program
  const RankingRow rig = row_of("rig", {{"core", 2 * cycles}, {"shield", cycles}});
  const std::vector<std::string> ends{"",        "/core",   " 1",     " 12/core 3", "/core/wire 2", "er",
                                      "er/core", " x/core", " /core", "1/core",     " 1x/core",     "/1"};
  for (const std::string begin : {"lead", "upper/lead", "upper lead", "uppermost/lead", "upper 2/lead", "bus/lead"})
    for (const std::string& end : ends) {
      const RankingRow row =
          row_of("job", {{begin + end, sought}, {"lead 7/core", other}, {"upper/lead 7/core", other}});
      for (const std::string dresspack : {"", "upper"}) {
        INFO(dresspack << ": " << begin << end);
        std::vector<RankingRow> rows{row};
        const RatedCable cable{"job", dresspack, "lead", "the lead", "rig", "torsion", 2e6};
        CHECK(relate({{}, {cable}}, {rig}, rows).empty());
        const bool is_in = std::regex_match(
            begin + end, std::regex((dresspack.empty() ? "" : dresspack + "/") + "lead( [0-9]+)?(/.*)?"));
        REQUIRE(rows[0].relative);
        CHECK(rows[0].relative->cycles_per_hour == Approx(100 * cycles / (is_in ? sought : other)).epsilon(1e-12));
        CHECK(rows[0].relative->hours() == Approx(2e6 / rows[0].relative->cycles_per_hour).epsilon(1e-12));
      }
    }
  // A cable whose wires the program leaves whole does nothing beside its rig. A rig without damage, and one without a result, relate to nothing.
  std::vector<RankingRow> rows{row_of("job", {{"bus/core", 5}})};
  const RatedCable cable{"job", "", "lead", "the lead", "rig", "torsion", 2e6};
  CHECK(relate({{}, {cable}}, {rig}, rows).empty());
  CHECK(rows[0].relative->cycles_per_hour == 0);
  const std::string begin = "job: no relative life of the lead (torsion): ";
  CHECK(relate({{}, {cable}}, {}, rows) == std::vector<std::string>{begin + "its rig has not run"});
  RankingRow endless = row_of("endless", {{"core", infinity}}), old = row_of("old", {});
  endless.job = old.job = "rig";
  CHECK(relate({{}, {cable}}, {endless}, rows) ==
        std::vector<std::string>{begin + "the model sees no damage in its rig, to which a program could be related"});
  CHECK(relate({{}, {cable}}, {old}, rows) ==
        std::vector<std::string>{begin + "life.h5 does not say when conductors fail at one place"});
  // Of two ratings the one that is reached sooner.
  RatedCable soon = cable;
  soon.rated_cycles = 1e6, soon.rig = "flex";
  for (const auto& order : {std::vector{cable, soon}, std::vector{soon, cable}}) {
    rows = {row_of("job", {{"lead/core", 10}})};
    CHECK(relate({{}, order}, {rig}, rows).empty());
    CHECK(rows[0].relative->rig == "flex");
  }
}

TEST_CASE("rate: cables whose names differ only in letters that no folder's name has get jobs of different names") {
  const Scratch scratch;
  const std::string lead =
      "helix_radius_mm: 8, slack_percent: 1, data_sheet: 4 x 0.25 mm2, "
      "ratings: [{rig: {kind: torsion, twist_deg_per_m: 270}, cycles: 1e6, source: test}]";
  const RateStudy rated =
      rate_study(scratch.write("hose.yaml",
                               "name: hose\nsource: test\ninner_diameter_mm: 30\ndiameter_mm: 40\nmass_kg_per_m: 1\n"
                               "bending_stiffness_Nm2: 1\ncomponents:\n  - {name: motor ü, " +
                                   lead + "}\n  - {name: motor ö, phase_deg: 180, " + lead + "}\n"),
                 scratch / "no rigs", {});
  CHECK(mapped(rated.tests, &RatedTest::job) == std::vector<std::string>{"motor___-rating_1", "motor___-rating_1_2"});
  CHECK(mapped(rated.study.jobs, &StudyJob::name) == mapped(rated.tests, &RatedTest::job));
}

}  // namespace dresslife::pipeline
