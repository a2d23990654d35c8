// Observations: entries of a table, variants of unknown settings, and verdicts on a prediction.
#include "pipeline/advise/calibrate/observations.h"

#include <unistd.h>

#include <fstream>
#include <limits>

#include "pipeline/base/errors.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

struct File {
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::filesystem::remove(path); }
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("dresslife-observations-{}.yaml", ::getpid());
};

std::vector<ObservedTest> tests_of(const std::string& text) { return read_observed_tests(File(text).path); }

const std::string one =
    "observations:\n  - name: bench\n    what: bent\n    source: a book\n    job: {dresspack: {}, motion: {}}\n";

std::string refusal(const std::string& text) {
  try {
    tests_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

constexpr double endless = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("observations: exactly one thing is observed, and what cannot be is refused with its remedy") {
  const std::vector<std::string> observed{"    cycles: 100\n", "    hours: 3\n", "    stiffness_Nm2: 0.2\n",
                                          "    decrement: 0.3\n", "    bending: table.csv\n"};
  for (const std::string& first : observed) {
    CHECK(refusal(one + first) == "read");
    for (const std::string& second : observed)
      if (first != second) CHECK_THAT(refusal(one + first + second), Contains("must have either cycles or hours"));
  }
  CHECK_THAT(refusal(one), Contains("must have either cycles or hours"));
  CHECK(refusal(one + "    decrement: 0.3\n    decrement_without_slip: 0.29\n") == "read");
  CHECK_THAT(refusal(one + "    decrement: 0.3\n    decrement_without_slip: 0.3\n"),
             Contains("nothing of decrement is left"));
  CHECK_THAT(refusal(one + "    cycles: 3\n    decrement_without_slip: 0.1\n"),
             Contains("decrement_without_slip has no effect on a row with cycles"));
  CHECK_THAT(refusal("observations:\n  - name: a/b\n    what: x\n    source: y\n    cycles: 3\n    job: {}\n"),
             Contains("letters, digits and _"));
  CHECK_THAT(refusal("observations:\n  - name: b\n    what: x\n    source: y\n    cycles: 3\n"),
             Contains("has no job"));
  CHECK_THAT(refusal(one + "    cycles: 3\n" + one.substr(one.find("  -")) + "    hours: 3\n"),
             Contains("two observations are named 'bench'"));
  CHECK_THAT(refusal("observations: []\n"), Contains("holds no observations"));
  CHECK_THAT(refusal(one + "    cycles: 3\nmore: 1\n"), Contains("unknown key 'more'"));
}

TEST_CASE("observations: every combination of what is not known is a variant") {
  const std::vector<ObservedTest> tests =
      tests_of(one + "    stiffness_Nm2: 2\n    vary: {strain.friction_factor: [1, 2, 3], fatigue.material: [a, b]}\n");
  REQUIRE(tests.size() == 1);
  REQUIRE(tests[0].variants.size() == 6);
  for (std::size_t k = 0; k < 6; ++k) {
    const ObservedTest::Variant& variant = tests[0].variants[k];
    CHECK(variant.name == fmt::format("bench-{}-{}", k / 2 + 1, k % 2 + 1));
    CHECK(variant.failure.empty());
    const Node* strain = variant.job.find("strain");
    REQUIRE(strain);
    CHECK(strain->find("friction_factor")->text == std::to_string(k / 2 + 1));
    CHECK(variant.job.find("fatigue")->find("material")->text == (k % 2 ? "b" : "a"));
  }
  CHECK_THAT(refusal(one + "    cycles: 3\n    vary: {strain.slip: free}\n"), Contains("must be a list of values"));
  CHECK_THAT(refusal(one + "    cycles: 3\n    vary: [1]\n"), Contains("must be a map"));
}

TEST_CASE("observations: lives in the observer's unit, over all variants that ran") {
  Study study;
  for (const char* name : {"a", "b", "c", "d", "lost"}) study.jobs.push_back({name, nullptr, ""});
  std::vector<RankingRow> rows(4);
  for (std::size_t k = 0; k < 4; ++k) {
    RankingRow& row = rows[k];
    row.job = study.jobs[3 - k].name;  // in another order
    row.repeat_seconds = 1800, row.worst_segment_from_tool = 1;
    const double hours = 10.0 * double(4 - k);
    row.conductor_hours = {hours, 2 * hours, 3 * hours}, row.first_wire_hours = {hours / 2, hours, 1.5 * hours};
    row.life_repeats_all_stick = 4 + double(k), row.life_repeats_all_free = 400 - double(k);
  }
  rows[1].failure = "it burst";
  Observation observation;
  observation.cycles = 100, observation.cycles_per_repeat = 3;
  observation.jobs = {0, 1, 2, 3};
  // Two repeats per hour, three cycles per repeat.
  CHECK(lives_of(observation, rows[0]) == std::array<double, 3>{240, 480, 720});
  observation.criterion = FailureCriterion::first_wire;
  CHECK(lives_of(observation, rows[0]) == std::array<double, 3>{120, 240, 360});
  observation.criterion = FailureCriterion::conductor;
  Prediction of = predicted(observation, study, rows);
  CHECK(of.variants == 4);
  CHECK(of.failed == 1);
  CHECK(of.failure == "it burst");
  CHECK(of.low == Approx(10 * 6));
  CHECK(of.high == Approx(120 * 6));
  CHECK(of.shortest == Approx(20 * 6));
  CHECK(of.median == Approx(40 * 6));
  CHECK(of.longest == Approx(80 * 6));
  CHECK(of.stuck == Approx(4 * 3));
  CHECK(of.free == Approx(400 * 3));
  observation.cycles.reset(), observation.hours = 9;
  observation.jobs.push_back(4);
  of = predicted(observation, study, rows);
  CHECK(of.failed == 2);
  CHECK(of.low == Approx(10));
  CHECK(of.free == Approx(200));
  // Where a row has a conductor's life glued and free, the bounds are of that: hours, or two repeats of three cycles in each.
  for (RankingRow& row : rows) row.glued_hours = {1, 7, 9}, row.free_hours = {100, 900, 999};
  rows[0].glued_hours[1] = 5, rows[3].free_hours[1] = 1100;
  of = predicted(observation, study, rows);
  CHECK(of.stuck == Approx(5));
  CHECK(of.free == Approx(1100));
  Observation counted = observation;
  counted.hours.reset(), counted.cycles = 100;
  of = predicted(counted, study, rows);
  CHECK(of.stuck == Approx(5 * 6));
  CHECK(of.free == Approx(1100 * 6));
  rows[0].planned_hours = {1, 2, 3}, rows[0].scatter_hours = {4, 5, 6};
  CHECK(lives_of(observation, rows[0])[0] == 4);
  rows[0].scatter_hours[0] = RankingRow::unknown;
  CHECK(lives_of(observation, rows[0])[0] == 1);
  rows[2].conductor_hours.fill(RankingRow::unknown);
  CHECK(std::isinf(lives_of(observation, rows[2])[1]));
}

TEST_CASE("observations: a prediction misses where its whole range is on the wrong side") {
  Prediction prediction;
  prediction.low = 10, prediction.shortest = 20, prediction.longest = 50, prediction.high = 100;
  const auto judged_at = [&](double life, ObservedEnd outcome) {
    Observation observation;
    observation.cycles = life, observation.outcome = outcome;
    return judged(observation, prediction);
  };
  using enum Agreement;
  const struct {
    double life;
    Agreement broken, broken_by, lower;  // lower bounds: run_out and rating
  } cases[]{{5, too_long, too_long, agrees},    {15, agrees, open, agrees}, {20, agrees, open, agrees},
            {30, agrees, open, open},           {50, agrees, agrees, open}, {80, agrees, agrees, open},
            {200, too_short, agrees, too_short}};
  for (const auto& [life, broken, broken_by, lower] : cases) {
    CAPTURE(life);
    CHECK(judged_at(life, ObservedEnd::broken).agreement == broken);
    CHECK(judged_at(life, ObservedEnd::broken_by).agreement == broken_by);
    CHECK(judged_at(life, ObservedEnd::run_out).agreement == lower);
    CHECK(judged_at(life, ObservedEnd::rating).agreement == lower);
  }
  CHECK(judged_at(5, ObservedEnd::broken).factor == 2);
  CHECK(judged_at(200, ObservedEnd::rating).factor == 2);
  CHECK(words_of(judged_at(200, ObservedEnd::rating)) == "MISS: too short by 2.0");
  CHECK(words_of({Agreement::too_long, endless}) == "MISS: too long, no failure predicted");
  Observation observation;
  observation.hours = 460;
  CHECK(observed_text(observation) == "460 h");
  observation.outcome = ObservedEnd::broken_by;
  CHECK(observed_text(observation) == "at most 460 h");
  observation.outcome = ObservedEnd::rating;
  CHECK(observed_text(observation) == "at least 460 h");
  observation.stiffness = 0.21;
  CHECK(observed_text(observation) == "0.210 N m2 at 1.0 1/m");
}
