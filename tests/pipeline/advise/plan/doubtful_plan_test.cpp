// Plausible mistakes in fleets and duties: a value that another unit explains is warned of with a remedy.
#include "pipeline/advise/plan/doubtful_plan.h"

#include "pipeline/job/job.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Catch::Contains;

const Day today_of_test = *day_from("2026-11-23");

std::vector<std::string> lines_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> lines;
  for (const Warning& warning : warnings) lines.push_back(warning.line());
  return lines;
}
std::vector<std::string> doubts_of_duty(const std::string& keys) {
  const Scratch scratch;
  return lines_of(
      doubtful_duties(read_duties(scratch.write("d.yaml", "study: s.yaml\nduties:\n  - {name: d, " + keys + "}\n"))));
}
std::vector<std::string> doubts_of_fleet(const std::string& text) {
  const Scratch scratch;
  return lines_of(doubtful_fleet(read_fleet(scratch.write("fleet.csv", text), today_of_test), today_of_test));
}

struct Doubtful {
  const char *text, *problem, *remedy;
};

void check_one(const std::vector<std::string>& doubts, const Doubtful& one, const char* place) {
  CAPTURE(one.text, doubts);
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Contains(place) && Contains(": warning: ") && Contains(one.problem) && Contains("Remedy: ") &&
                            Contains(one.remedy));
}

}  // namespace

TEST_CASE("duties: numbers that another unit explains are warned of, usual ones are not") {
  for (const Doubtful& one :
       {Doubtful{"programs: [{job: a, percent_of_time: 0.5}]", "percent_of_time of 'a' is 0.5 (limit 1 or more)",
                 "percent_of_time: 50 if that was a share"},
        {"programs: [{job: a, percent_of_time: 5, deviation_percent: 0.1}]", "deviation_percent of 'a' is 0.1",
         "deviation_percent: 10"},
        {"programs: [{job: a, repeats_per_hour: 0}]", "'a' never runs in its duty", "no entry of this program"},
        {"repeats_per_hour: 5, programs: [{job: a, percent_of_repeats: 0.6}, {job: b, percent_of_repeats: 0.4}]",
         "add up to 1 %", "percent_of_repeats: 60 instead of 0.6"},
        {"repeats_per_hour: 5, programs: [{job: a, percent_of_time: 5}]",
         "repeats_per_hour of duty 'd' is 5 and has no effect", "repeats_per_hour: 5 in an entry"},
        {"hours_per_week: 0.5, programs: [{job: a, percent_of_time: 5}]",
         "hours_per_week of duty 'd' is 0.5 (limit more than 24)", "hours_per_week: 84 if that was a share"},
        {"hours_per_week: 3, programs: [{job: a, percent_of_time: 5}]", "hours_per_week of duty 'd' is 3",
         "hours_per_week: 80, or the hours of a week"},
        {"hours_per_week: 16, programs: [{job: a, percent_of_time: 5}]",
         "hours_per_week of duty 'd' is 16 (limit more than 24)", "hours_per_week: 80 if that was per working day"},
        {"shift_hours: 40, programs: [{job: a, repeats_per_shift: 5}]",
         "shift_hours of duty 'd' is 40 (limits 2 .. 24)", "shift_hours: 8"},
        {"shift_hours: 0.5, programs: [{job: a, repeats_per_shift: 5}]", "shift_hours of duty 'd' is 0.5",
         "shift_hours: 8"},
        {"programs: [{job: a, percent_of_time: 5}], history: [{duty: d, hours: 300000}]",
         "hours of the history are 300000", "hours: 5000 if that was minutes"}})
    check_one(doubts_of_duty(one.text), one, "d.yaml:3:");
  for (const char* usual :
       {"programs: [{job: a, percent_of_time: 5, deviation_percent: 10}], history: [{duty: d, hours: 4000}]",
        "repeats_per_hour: 5, programs: [{job: a, percent_of_repeats: 60}, {job: b, percent_of_repeats: 40}]",
        "shift_hours: 7.5, hours_per_week: 168, programs: [{job: a, repeats_per_shift: 5}]"})
    CHECK(doubts_of_duty(usual).empty());
  const std::filesystem::path shipped = std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config" / "duties";
  CHECK(doubtful_duties(read_duties(shipped / "two_robots.yaml")).empty());
  CHECK(doubtful_fleet(read_fleet(shipped / "fleet.csv", today_of_test), today_of_test).empty());
}

TEST_CASE("duties: a number that is refused is one problem, and a file of another kind is named") {
  const Scratch scratch;
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      read_duties(scratch.write("d.yaml", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string head = "study: s.yaml\nduties:\n  - {name: d, programs: [{job: a, ";
  for (const char* number :
       {"percent_of_time: 150", "repeats_per_hour: -1", "percent_of_time: '0,5'", "repeats_per_minute: 5",
        "repeats_per_hour: 5, batch_size: 3}, {job: b, repeats_per_hour: 5, batch_size: -1"}) {
    const std::string words = refusal(head + number + "}]}\n");
    INFO(words);
    CHECK(!words.empty());
    CHECK(words.find('\n') == std::string::npos);
  }
  CHECK_THAT(refusal("base: job.yaml\n"), Contains("is a study (it has the key 'base'), no file of duties"));
}

TEST_CASE("fleets: numbers that another unit or a slip explains are warned of") {
  const std::string costs = "name,duty,installed,planned_cost,unplanned_cost\n";
  for (const Doubtful& one :
       {Doubtful{"name,duty,installed\na,d,2006-11-20\n", "'a' was installed 7308 days ago (limit 7300: 20 years)",
                 "the date of the dresspack"},
        {"name,duty,installed\na,d,1926-11-20\n", "'a' was installed", "the date of the dresspack"},
        {"name,duty,installed\nb,d,2026-01-05\na,d,2026-01-05\nA ,d,2026-01-05\n",
         "'A' and 'a' differ only in blanks, signs or capitals", "names that differ more"},
        {"name,duty,installed\nc,d,2026-11-23\na,d,\nb,d,\n", "'a' counts as installed today (and 1 more)",
         "the date on which it was installed"},
        {"name,duty,installed,hours_per_week\na,d,2026-01-05,0.5\n", "hours_per_week of 'a' is 0.5",
         "hours_per_week: 84"},
        {"name,duty,installed,hours_per_week\na,d,2026-01-05,8\nb,d,2026-01-05,24\nc,d,2026-01-05,40\n",
         "hours_per_week of 'a' (and 1 more) is 8 (limit more than 24)",
         "hours_per_week: 40 if that was per working day"},
        {"name,duty,installed,planned_cost,unplanned_cost\na,d,2026-01-05,0,9500\n", "planned_cost of 'a' is 0",
         "with parts, labour and standstill"},
        {"name,duty,installed,planned_cost,unplanned_cost\na,d,2026-01-05,1.2,9500\n",
         "unplanned_cost of 'a' is 7917 times its planned_cost (limit 100)", "planned_cost: 1200"},
        {"name,duty,installed,planned_cost,unplanned_cost\na,d,2026-01-05,1.2,9.5\nb,d,2026-01-05,1200,9500\n",
         "planned_cost of 'a' is 1.2, and of 'b' 1200", "planned_cost: 1200"}})
    check_one(doubts_of_fleet(one.text), one, "fleet.csv:");
}

TEST_CASE("plans: hours without a failure in a calibration are doubtful, other observations are not") {
  const auto doubts = [](const std::string& observed) {
    Job job;
    job.calibration.emplace().observations = {{"R17", observed, "", "", ""}};
    return lines_of(doubtful_evidence({"s", {{"a", std::make_shared<const Job>(job), ""}}, Keep::all}, "fleet.csv"));
  };
  for (const char* other : {"3,000 h", "at most 3,000 h", "at least 3,000", "2 of 9 failed"})
    CHECK(doubts(other).empty());
  check_one(doubts("at least 3,000 h"),
            {"", "the calibration contains 'R17' with at least 3,000 h", "calibrate without this row"}, "fleet.csv");
}

}  // namespace dresslife::pipeline
