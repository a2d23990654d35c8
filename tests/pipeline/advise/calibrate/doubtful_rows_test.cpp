// Plausible mistakes in observations: each is refused, or warned of with place, value, limit, cause and remedy.
#include "pipeline/advise/calibrate/doubtful_rows.h"

#include "pipeline/base/errors.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Catch::Contains;

constexpr const char* job =
    "{motion: {rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}}, dresspack: {cable: control_cable}}";

std::string row(const std::string& name, const std::string& keys) {
  return "  - {name: " + name + ", what: twisted, source: a test, job: " + job + ", " + keys + "}\n";
}

struct Answer {
  std::string refusal;
  std::vector<std::string> doubts;
};
Answer answer_to(const std::string& text, const std::string& table = "") {
  const Scratch scratch;
  if (!table.empty()) scratch.write("bend.csv", table);
  try {
    Answer answer;
    for (const Warning& warning : doubtful_rows(read_observed_tests(scratch.write("o.yaml", text))))
      answer.doubts.push_back(warning.line());
    return answer;
  } catch (const InputError& error) {
    return {error.what(), {}};
  }
}

struct Wrong {
  const char *keys, *problem, *remedy;
};

}  // namespace

TEST_CASE("observations: what is wrong in a row is refused with its remedy") {
  const Wrong wrong[] = {
      {"hours: -5", "hours is -5 (must be 0 .. 1000000)", "give the life in hours of motion"},
      {"hours: 1e9", "hours is 1e9 (must be 0 .. 1000000)", "give the life in hours of motion"},
      {"hours: 2026-01-01", "(must be a number", "give the life in hours of motion"},
      {"cycles: 2 million", "(must be a number", "give the life in cycles"},
      {"cycles: '5,000,000'", "(must be a number", "give the life in cycles"},
      {"cycles: '2,5'", "(must be a number", "write 2.5 with a point"},
      {"cycles: 1.000.000", "(must be a number", "give the life in cycles"},
      {"cycles: 1e15", "cycles is 1e15 (its size must be", "give the life in cycles"},
      {"cycle: 5", "unknown key 'cycle'", "did you mean 'cycles'?"},
      {"months: 5", "unknown key 'months'", "keys here: "},
      {"hours: 5, installed: 2026-01-01", "unknown key 'installed'", "keys here: "},
      {"cycles: 500, hours: 5", "must have either cycles or hours", "give one of them"},
      {"cycles: 500, outcome: survived", "outcome is 'survived'", "run_out (it had not failed then)"},
      {"cycles: 500, outcome: failed", "outcome is 'failed'", "broken (it failed then)"},
      {"cycles: 500, criterion: cable", "criterion is 'cable'", "first_wire, or conductor"},
      {"cycles: 500, specimens: 0", "specimens is 0", "give the number of specimens"},
      {"cycles: 500, specimens: 2.5", "specimens is 2.5 (must be a whole number)", "give the number of specimens"},
      {"cycles: 500, unshared_log10: -0.3", "unshared_log10 is -0.3", "give the standard deviation"},
      {"hours: 500, cycles_per_repeat: 2", "cycles_per_repeat has no effect on a row with hours", "leave it out"},
      {"cycles: 500, noise_percent: 20", "noise_percent has no effect on a row with cycles", "leave it out"},
      {"cycles: 500, at_curvature_1_per_m: 2", "at_curvature_1_per_m has no effect on a row with cycles",
       "leave it out"},
      {"cycles: 500, outcome: rating, specimens: 10", "specimens has no effect on a rating", "leave it out"},
      {"stiffness_Nm2: 0.02, outcome: run_out", "outcome has no effect on a row with stiffness_Nm2", "leave it out"},
      {"stiffness_Nm2: 0.02, unshared_log10: 0.2", "unshared_log10 has no effect on a row with stiffness_Nm2",
       "leave it out"},
      {"bending: bend.csv, at_curvature_1_per_m: 2", "at_curvature_1_per_m has no effect on a row with bending",
       "leave it out"},
      {"bending: none.csv", "none.csv: error: cannot be read", "; "},
  };
  for (const Wrong& one : wrong) {
    const Answer answer = answer_to("observations:\n" + row("x", one.keys), "curvature_1_per_m,moment_Nm\n1,0.02\n");
    CAPTURE(one.keys, answer.refusal);
    CHECK_THAT(answer.refusal, Contains(one.problem) && Contains(one.remedy));
  }
  CHECK_THAT(answer_to("observations:\n" + row("line-1", "cycles: 500")).refusal, Contains("write name: line_1"));
  CHECK_THAT(answer_to("base: irb6640_spot_welding\n").refusal,
             Contains("is a study (it has the key 'base'), no list of observations"));
  CHECK_THAT(answer_to("name;hours\nx;5\n").refusal,
             Contains("holds no observations; write 'observations:' and a list of rows"));
  CHECK_THAT(answer_to("cables: typcal\nobservations:\n" + row("x", "cycles: 500")).refusal,
             Contains("cables must be own or typical"));
}

TEST_CASE("observations: what another unit, a copy or an exchange explains is warned of") {
  const Wrong doubtful[] = {
      {"cycles: 5", "cycles of 'x' is 5 (limit 100 or more). Likely cause: millions",
       "cycles: 5e+06 if that was millions"},
      {"hours: 0.5", "hours of 'x' is 0.5 (limits 1 .. 175000", "hours: 500 if that was thousands of hours"},
      {"hours: 300000, outcome: run_out", "hours of 'x' is 300000 (limits 1 .. 175000: 20 years",
       "hours: 5000 if that was minutes, or cycles: 300000"},
      {"cycles: 50000, specimens: 50000", "specimens of 'x' is 50000 (limit 200 or less)", "the number of pieces"},
      {"cycles: 50000, cycles_per_repeat: 30", "cycles_per_repeat of 'x' is 30 (limits 0.1 .. 10)",
       "cycles_per_repeat: 1, or 2"},
      {"cycles: 50000, unshared_log10: 2", "unshared_log10 of 'x' is 2 (limits 0.005 .. 1: 1 %",
       "unshared_log10: 0.301 if that was a factor"},
      {"cycles: 50000, unshared_log10: 0.001", "unshared_log10 of 'x' is 0.001 (limits 0.005 .. 1",
       "unshared_log10: 0.1"},
      {"stiffness_Nm2: 20000", "stiffness_Nm2 of 'x' is 20000 (limits 1e-05 .. 10). Likely cause: N mm2",
       "stiffness_Nm2: 0.02 if that was N mm2"},
      {"stiffness_Nm2: 2e-8", "stiffness_Nm2 of 'x' is 2e-08", "the moment in N m times the bend radius in m"},
      {"stiffness_Nm2: 0.02, noise_percent: 0.1", "noise_percent of 'x' is 0.1 (limit 1 or more)",
       "noise_percent: 10 if that was a share"},
      {"stiffness_Nm2: 0.02, at_curvature_1_per_m: 100", "at_curvature_1_per_m of 'x' is 100 (limits 0.05 .. 50)",
       "at_curvature_1_per_m: 10 if that was a radius in mm"},
      {"stiffness_Nm2: 0.02, at_curvature_1_per_m: 0.001", "at_curvature_1_per_m of 'x' is 0.001",
       "at_curvature_1_per_m: 1 if that was 1/mm"},
      {"decrement: 4", "decrement of 'x' is 4 (limit 2 or less)", "decrement: 1.386 if that was the ratio"},
  };
  for (const Wrong& one : doubtful) {
    const Answer answer = answer_to("observations:\n" + row("x", one.keys));
    CAPTURE(one.keys, answer.refusal);
    REQUIRE(answer.doubts.size() == 1);
    CHECK_THAT(answer.doubts[0], Contains("o.yaml:2:5: warning: ") && Contains(one.problem) && Contains("Remedy: ") &&
                                     Contains(one.remedy));
  }
  const auto both = [](const std::string& first, const std::string& second) {
    return answer_to("observations:\n" + row("x", first) + row("y", second)).doubts;
  };
  REQUIRE(both("cycles: 50000", "cycles: 50000").size() == 1);
  CHECK_THAT(both("cycles: 50000", "cycles: 50000")[0],
             Contains("o.yaml:3:5") && Contains("'y' are those of 'x'") && Contains("specimens: 2"));
  REQUIRE(both("cycles: 90000, outcome: run_out", "cycles: 50000, outcome: broken_by").size() == 1);
  CHECK_THAT(both("cycles: 50000, outcome: broken_by", "cycles: 90000, outcome: run_out")[0],
             Contains("'y' lived at least 90,000") && Contains("no specimen lived longer than at most 50,000") &&
                 Contains("outcome: broken"));
  CHECK(both("cycles: 50000, outcome: run_out", "cycles: 90000, outcome: broken_by").empty());
  CHECK(both("cycles: 50000", "cycles: 60000").empty());
  CHECK(both("cycles: 50000", "hours: 50000").empty());

  struct Table {
    const char *lines, *problem, *remedy;
  };
  for (const Table& one :
       {Table{"0.5,20\n1,30\n", "the largest moment over its curvature, in N m2, of 'x' is 30",
              "moment_Nm: 0.03 instead of 30"},
        Table{"0.0005,0.02\n0.001,0.03\n", "the largest curvature_1_per_m of 'x' is 0.001 (limits 0.05 .. 50)",
              "1000 over the bend radius"},
        Table{"2000,0.02\n1000,0.03\n", "the largest curvature_1_per_m of 'x' is 2000",
              "1000 over the bend radius in mm"},
        Table{"0.01,0.5\n0.02,1\n", "exchanged columns", "curvature_1_per_m"},
        Table{"5,0.07\n2.5,0.02\n0,-0.03\n-2.5,-0.05\n-5,-0.07\n",
              "the first curvature_1_per_m over the largest one of 'x' is 1",
              "in the order of the test, from straight"},
        Table{"0,0.02\n1,0.04\n5,0.09\n", "the moment of the straight cable over the largest one of 'x' is 0.222",
              "each moment_Nm less 0.02"}}) {
    const std::vector<std::string> doubts = answer_to("observations:\n" + row("x", "bending: bend.csv"),
                                                      std::string("curvature_1_per_m,moment_Nm\n") + one.lines)
                                                .doubts;
    CAPTURE(one.lines);
    REQUIRE(doubts.size() == 1);
    CHECK_THAT(doubts[0], Contains(one.problem) && Contains(one.remedy));
  }
  const auto doubts_of_points = [](int count) {
    std::string points = "curvature_1_per_m,moment_Nm\n";
    for (int k = 1; k <= count; ++k) points += fmt::format("{},{}\n", 0.01 * k, 0.0002 * k);
    return answer_to("observations:\n" + row("x", "bending: bend.csv"), points).doubts;
  };
  REQUIRE(doubts_of_points(301).size() == 1);
  CHECK_THAT(doubts_of_points(301)[0],
             Contains("the number of points of the curve of 'x' is 301 (limit 300 or less)") &&
                 Contains("means of neighbouring readings"));
  CHECK(doubts_of_points(300).empty());
}

TEST_CASE("observations: the shipped tables and usual rows have no doubts, and all variants are valid jobs") {
  const std::filesystem::path shipped = std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config" / "observations";
  for (const char* name : {"your_cable.yaml", "ratings.yaml", "published.yaml"}) {
    const std::vector<ObservedTest> tests = read_observed_tests(shipped / name);
    CHECK(doubtful_rows(tests).empty());
    for (const ObservedTest& test : tests)
      for (const ObservedTest::Variant& variant : test.variants) CHECK(variant.failure == "");
  }
  for (const char* usual :
       {"hours: 1, outcome: run_out", "hours: 4900, outcome: run_out, specimens: 5, unshared_log10: 0.3",
        "cycles: 1e7, cycles_per_repeat: 2, outcome: rating", "stiffness_Nm2: 0.02, noise_percent: 15",
        "decrement: 0.3, decrement_without_slip: 0.05", "bending: bend.csv"})
    CHECK(answer_to("observations:\n" + row("x", usual), "curvature_1_per_m,moment_Nm\n0,0\n1,0.02\n-1,-0.02\n")
              .doubts.empty());
}

}  // namespace dresslife::pipeline
