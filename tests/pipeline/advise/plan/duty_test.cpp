#include "pipeline/advise/plan/duty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/rounds.h"
#include "pipeline/job/job.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

DutyFile read(const std::string& text) {
  const Scratch scratch;
  scratch.write("duties.yaml", text);
  return read_duties(scratch / "duties.yaml");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string of_programs(const std::string& programs, const std::string& more = "") {
  return "study: s\nduties:\n  - name: d\n" + more + "    programs:\n" + programs;
}

/// Returns a wrapped text in one line.
std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
  return text;
}

}  // namespace

TEST_CASE("ten repeats an hour in every unit") {
  constexpr double seconds = 36;
  for (const char* words :
       {"repeats_per_hour: 10", "repeats_per_shift: 60", "percent_of_time: 10", "percent_of_repeats: 40"}) {
    INFO(words);
    const DutyFile file = read(of_programs(std::string("      - {job: a, ") + words + "}\n",
                                           "    shift_hours: 6\n    repeats_per_hour: 25\n"));
    const Duty& duty = file.duties.front();
    CHECK(duty.programs.front().rate(seconds, duty.shift_hours, duty.repeats_per_hour) == Approx(10).epsilon(1e-12));
  }
}

TEST_CASE("wear and used ratings of a duty's programs add up by their shares of the time") {
  const auto mode = [](const char* name, const char* place, double early, double median) {
    UnvalidatedMode of;
    of.mode = name, of.place = place, of.hours = {early, median, 10 * median};
    return of;
  };
  std::vector<RankingRow> rows(2);
  rows[0].unvalidated = {mode(UnvalidatedMode::abrasion, "link_4", 1000, 9000),
                         mode(UnvalidatedMode::rating, "power cable", 500, 600),
                         mode(UnvalidatedMode::wall, "hose 3", UnvalidatedMode::unknown, 300)};
  rows[1].unvalidated = {mode(UnvalidatedMode::abrasion, "link_3", 4000, 9000),
                         mode(UnvalidatedMode::rating, "bus cable", 800, 900)};
  rows[0].unvalidated[2].bends_at_limit = 17e6;
  std::vector<DutyPart> parts(2);
  parts[0].share_of_time = 0.5, parts[1].share_of_time = 0.25;
  std::vector<DutyMode> modes = other_modes(parts, rows);
  REQUIRE(modes.size() == 4);
  CHECK(modes[0].hours == Approx(1 / (0.5 / 1000 + 0.25 / 4000)));  // on two links: the shorter life
  CHECK(modes[1].hours == Approx(1000));                            // each cable separately
  CHECK(modes[2].hours == Approx(600));                             // of the wall the median
  CHECK(modes[3].hours == Approx(3200));
  rows[0].unvalidated[2].bends_at_limit = 1e6;  // its law contradicts a published hose
  CHECK(other_modes(parts, rows).size() == 3);
  // A gentle program, whose life of the wall is credible, does not predict that of the other.
  rows[1].unvalidated.push_back(mode(UnvalidatedMode::wall, "hose 3", UnvalidatedMode::unknown, 2e5));
  rows[1].unvalidated.back().bends_at_limit = 1e6;
  CHECK(other_modes(parts, rows).size() == 3);
  rows[1].unvalidated.pop_back();
  parts[0].share_of_time = 0;
  CHECK(std::isinf(other_modes(parts, rows)[1].hours));
}

TEST_CASE("a duty names the mode beside the wires that comes first, and all that come before the replacement") {
  DutyResult duty;
  duty.robot_life_hours = 40000, duty.hours_per_week = 80;
  duty.lives.percentiles = {9000, 20000, 30000};
  CHECK_THAT(duty_action(duty), Catch::EndsWith("at 80 h per week)."));
  CHECK(caution_words(duty).empty());
  duty.unconfirmed = {"the doubtful input (least_bend_radius_mm) of one"};
  CHECK_THAT(duty_action(duty),
             Catch::StartsWith("Do not use this result before you have confirmed or corrected the doubtful input "
                               "(least_bend_radius_mm) of one (see the warnings). Plan a replacement after 9,000 h"));
  duty.unconfirmed.clear();
  duty.others = {{UnvalidatedMode::abrasion, "", "", 20000},
                 {UnvalidatedMode::rating, "", "power cable", 6000},
                 {UnvalidatedMode::wall, "upper", "", 7000},
                 {UnvalidatedMode::rating, "", "bus cable", std::numeric_limits<double>::infinity()}};
  CHECK_THAT(
      duty_action(duty),
      Catch::EndsWith(
          " The maker's rating of power cable covers only 6,000 h (not validated): test or replace it by then."));
  const std::string caution = caution_words(duty);
  for (const char* words :
       {"the maker's rating of power cable covers 6,000 h", "1 of 10 hoses of upper has cracked after 7,000 h"})
    CHECK_THAT(in_one_line(caution), Catch::Contains(words));
  CHECK_THAT(caution, !Catch::Contains("bus cable"));
  const std::string worn = "1 of 10 hoses is worn through after 20,000 h";
  CHECK_THAT(in_one_line(caution), !Catch::Contains(worn));  // it is replaced at 9,000 h
  DutyResult doubtful = duty;
  doubtful.doubtful = {"a"};
  CHECK_THAT(in_one_line(caution_words(doubtful)), Catch::Contains(worn));  // 9,000 h are not to be planned with
  DutyResult endless = duty;
  endless.lives.percentiles.fill(std::numeric_limits<double>::infinity());
  CHECK_THAT(duty_action(endless),
             Catch::StartsWith("No replacement is foreseen") && Catch::EndsWith("test or replace it by then."));
  duty.others[1].hours = 8000;
  CHECK_THAT(duty_action(duty),
             Catch::EndsWith(" The hose of upper may crack after 7,000 h (not validated): inspect it."));
  duty.others.erase(duty.others.begin() + 1, duty.others.end());
  CHECK_THAT(duty_action(duty), Catch::EndsWith("at 80 h per week)."));  // after the wires
  duty.lives.percentiles[0] = 50000;
  CHECK_THAT(duty_action(duty),
             Catch::EndsWith(" The hose may wear through after 20,000 h (not validated): inspect it."));
  // The remaining hours of the wires begin now, those of the other modes with the new dresspack.
  DutyResult used = duty;
  used.past_hours = 25000, used.lives.remaining = {50000, 60000, 70000};
  CHECK_THAT(duty_action(used),
             Catch::EndsWith(
                 " The hose may wear through after 20,000 h from new (not validated; 25,000 h are past): inspect it."));
  CHECK_THAT(in_one_line(caution_words(used)), Catch::Contains("at the soonest (from new, by these programs only): 1"));
  duty.others = {{UnvalidatedMode::jacket, "", "", 10000}};
  CHECK_THAT(
      duty_action(duty),
      Catch::EndsWith(" A cable's jacket may wear through in the hose after 10,000 h (not validated): open the hose."));
  CHECK_THAT(in_one_line(caution_words(duty)),
             Catch::Contains("1 of 10 dresspacks has a jacket worn through in the hose after 10,000 h"));
  duty.others = {{UnvalidatedMode::corkscrew, "", "", 10000}};
  CHECK_THAT(duty_action(duty),
             Catch::EndsWith(" Cables may wind into a corkscrew after 10,000 h (not validated): open the hose."));
  CHECK_THAT(in_one_line(caution_words(duty)), Catch::Contains("1 of 10 dresspacks has a corkscrew after 10,000 h"));
}

TEST_CASE("the table of a duty names the unit of each of its lives") {
  DutyResult duty;
  duty.name = "shift", duty.robot_life_hours = 40000;
  duty.modes = {"wires"}, duty.changes = {1}, duty.damage.same_place = {1};
  duty.parts.resize(1), duty.lives.share = {1}, duty.lives.percentiles = {1e4, 2e4, 3e4};
  CHECK_THAT(duty_words({duty}), Catch::Contains("  p10 without it [h]  p10 if twice as often [h]\n"));
  duty.past_hours = 100;
  CHECK_THAT(duty_words({duty}), Catch::Contains("  new: p10 without it [h]  new: p10 if twice as often [h]\n") &&
                                     Catch::Contains("  new: of a new dresspack, which has no history.\n"));
}

TEST_CASE("a duty states how much the damages of a cycle's recordings differ") {
  DutyResult duty;
  duty.modes = {"wires"}, duty.changes = {1}, duty.damage.same_place = {1}, duty.has_order = true;
  for (const auto& [repeats, cycle] : {std::pair(2, "cycle"), {1, "cycle"}, {1, "cycle"}, {1, ""}, {0, "cycle"}})
    duty.parts.push_back({.job = "", .repeats_per_hour = double(repeats), .recording_of = cycle});
  duty.lives.share = {0.2, 0.2, 0.2, 0.4, 0};
  // The repeats do damage of 0.1, 0.2 and 0.2; the mean is 0.15. Differences of neighbours 2/3 and 0: sqrt((2/3)^2 / 2 / 2 / 3) = 0.192.
  CHECK_THAT(
      in_one_line(mixture_words(duty)),
      Catch::Contains(
          "The 3 recordings of cycle do 0.67 to 1.33 times its mean damage: the standard error of the mean is 19 %."));
  // Damage of 0.1 and 0.3: 0.6 and 1.8 times the mean, sqrt(1.2^2 / 2 / 2) = 0.6.
  duty.parts.erase(duty.parts.begin() + 2), duty.lives.share = {0.2, 0.3, 0.4, 0};
  CHECK_THAT(
      in_one_line(mixture_words(duty)),
      Catch::Contains(
          "The 2 recordings of cycle do 0.60 to 1.80 times its mean damage: the standard error of the mean is 60 %."));
  // The places of rest are not known: the words name what the error leaves out. Held cables have one place of rest.
  CHECK_THAT(in_one_line(mixture_words(duty)), Catch::Contains("the standard error leaves that out"));
  for (DutyPart& part : duty.parts) part.at_other_rests = {1, 1};
  CHECK_THAT(in_one_line(mixture_words(duty)), !Catch::Contains("rest"));
  // Shares of 0.4 and 0.6: 0.4 x 2 + 0.6 x 4 = 3.2 and 0.4 x 0.5 + 0.6 x 0.25 = 0.35 times; exp(hypot(ln 3.2, ln 1.6)) = 3.5.
  duty.parts[0].at_other_rests = {2, 0.5}, duty.parts[1].at_other_rests = {4, 0.25};
  CHECK_THAT(in_one_line(mixture_words(duty)),
             Catch::Contains("it is 0.35 to 3.2 times as large. Together the mean is known within a factor of 3.5."));
  CHECK_THAT(in_one_line(mixture_words(duty)), !Catch::Contains("numerical error"));
  duty.errors = {2.14, 1.02, 3};
  CHECK_THAT(
      in_one_line(mixture_words(duty)),
      Catch::Contains(
          "numerical error of the programs' lives: the 10 % value by a factor of 2.1, the 90 % value by a factor of 3.0. With loose"));
}

TEST_CASE(
    "a duty states by how much its programs damage different places, from 5 % on, and what changes add, from 1 % on") {
  DutyResult duty;
  duty.has_order = true, duty.rounds_per_hour = 1;
  duty.modes = {"a", "b", "c", "d"};
  duty.changes = {1.009, 1.012, 0.99, 1};
  duty.damage.same_place = {1.009 / 1.049, 1.012 / 1.052, 0.99 / 1.5, 1};  // over the damage if all damaged one place
  const std::string words = in_one_line(mixture_words(duty));
  CHECK_THAT(words, Catch::Contains("the damage would be larger: b by 5 %, c by 50 %."));
  CHECK_THAT(words, Catch::Contains("make the damage of b 1.01 times as large") &&
                        !Catch::Contains("the damage of a 1.01") && !Catch::Contains("the damage of d"));
}

TEST_CASE("a duty of several programs without an order names the cycles that it leaves out") {
  DutyResult duty;
  duty.modes = {"wires"}, duty.changes = {1}, duty.damage.same_place = {1};
  duty.parts.resize(1);
  CHECK(mixture_words(duty).empty());
  duty.parts.resize(2);
  duty.parts[0].repeats_per_hour = 5;
  CHECK(mixture_words(duty).empty());  // the other program never runs
  duty.parts[1].repeats_per_hour = 5;
  CHECK_THAT(in_one_line(mixture_words(duty)),
             Catch::StartsWith(" Cycles that begin in one program and end in another are not counted. ") &&
                 Catch::Contains("With `order` or `batch_size` they are. "));
  duty.has_order = true, duty.rounds_per_hour = 0.3;
  CHECK_THAT(in_one_line(mixture_words(duty)),
             Catch::StartsWith(" The order runs 0.300 times per hour.") && !Catch::Contains("without changes"));
  duty.outside = {"b (33 %)"};
  CHECK_THAT(in_one_line(mixture_words(duty)),
             Catch::EndsWith("these shares of them count without changes to another program: b (33 %). "));
}

TEST_CASE("a history by dates has the hours of its days, each at the week of its duty") {
  const auto with = [](const std::string& entries) {
    return "study: s\nduties:\n  - {name: a, hours_per_week: 84, programs: [{job: j, percent_of_time: 5}]}\n"
           "  - name: b\n    hours_per_week: 168\n    programs: [{job: j, percent_of_time: 5}]\n    history:\n" +
           entries;
  };
  const Day today = day_from("2026-07-01").value();
  const auto refused = [&](const std::string& entries) {
    const Scratch scratch;
    scratch.write("duties.yaml", with(entries));
    try {
      read_duties(scratch / "duties.yaml", today);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Scratch scratch;
  scratch.write(
      "duties.yaml",
      with("      - {duty: a, from: 2026-01-05, to: 11.01.2026}\n      - {duty: b, from: 2026-01-12, to: 2026-01-12}\n"
           "      - {duty: a, hours: 5}\n"));
  const std::vector<PastDuty> history = read_duties(scratch / "duties.yaml", today).duties[1].history;
  REQUIRE(history.size() == 3);
  CHECK(history[0].hours.value() == Approx(84));  // seven days
  CHECK(history[1].hours.value() == Approx(24));  // one day
  CHECK(history[2].hours.value() == 5);
  CHECK_THAT(refused("      - {duty: a, hours: 5, from: 2026-01-05, to: 2026-01-11}\n"),
             Catch::Contains("duties.yaml:8:9: error: the history has both"));
  CHECK_THAT(refused("      - {duty: a}\n"), Catch::Contains("neither hours nor dates"));
  CHECK_THAT(refused("      - {duty: a, from: 2026-01-05}\n"), Catch::Contains("has no 'to'"));
  CHECK_THAT(refused("      - {duty: a, from: 1/5/2026, to: 2026-01-11}\n"),
             Catch::Contains("2026-05-01 if the day comes first"));
  CHECK_THAT(refused("      - {duty: a, from: 2026-02-30, to: 2026-03-11}\n"),
             Catch::Contains("'2026-02-30' is no date"));
  CHECK_THAT(refused("      - {duty: a, from: 2026-01-11, to: 2026-01-05}\n"),
             Catch::Contains("before it begins; exchange"));
  CHECK_THAT(refused("      - {duty: a, from: 2026-06-01, to: 2026-07-02}\n"),
             Catch::Contains("ends on 2026-07-02, after today, 2026-07-01; to: 2026-07-01"));
  CHECK_THAT(refused("      - {duty: a, from: 2026-08-01, to: 2026-08-02}\n"),
             Catch::Contains("begins on 2026-08-01, after today, 2026-07-01; give days"));
  CHECK_THAT(
      refused(
          "      - {duty: a, from: 2026-01-05, to: 2026-01-11}\n      - {duty: b, from: 2026-01-11, to: 2026-02-01}\n"),
      Catch::Contains("duties.yaml:9:9: error: the days 2026-01-11 .. 2026-02-01 overlap those of line 8"));
}

TEST_CASE("duties of a study that keeps no lives are refused before it runs") {
  CHECK_NOTHROW(check_programs({}, Study{"s", {}, Keep::histories}));
  CHECK_THROWS_WITH(check_programs({}, Study{"s", {}, Keep::lives}),
                    Catch::Contains("study 's' keeps no life.h5 (keep: lives)"));
}

TEST_CASE("duties of a job without samples of uncertain parameters are refused before it runs") {
  const DutyFile file =
      read("study: s\nduties:\n  - {name: a, programs: [{job: p, percent_of_time: 90}], hours_per_week: 100}\n");
  const auto check = [&](bool enabled) {
    Job job;
    job.uncertainty.enabled = enabled;
    check_programs(file, Study{"s", {{"p", std::make_shared<const Job>(job), ""}}, Keep::histories});
  };
  CHECK_NOTHROW(check(true));
  CHECK_THROWS_WITH(check(false), Catch::Contains("duties.yaml:3:") &&
                                      Catch::Contains("job 'p' has no samples of uncertain parameters"));
}

TEST_CASE("batch sizes are an order in which each program runs once in a round") {
  const Scratch scratch;
  const auto order_of = [&](const std::string& programs, const std::string& more = "") {
    return read_duties(scratch.write("duties.yaml", of_programs(programs, more))).duties[0];
  };
  const Duty batches = order_of(
      "      - {job: a, repeats_per_hour: 60, batch_size: 20}\n      - {job: c, repeats_per_hour: 5}\n"
      "      - {job: b, repeats_per_hour: 45, batch_size: 10}\n");
  const Duty order = order_of(
      "      - {job: a, repeats_per_hour: 60}\n      - {job: c, repeats_per_hour: 5}\n      - {job: b, repeats_per_hour: 45}\n",
      "    order: [{job: a, repeats: 20}, {job: b, repeats: 10}]\n");
  CHECK(round_name(batches) == round_name(order));
  // Three rounds per hour contain all of a, each with one change to b and one back. 15 of b are outside the rounds.
  const std::vector<double> expected{60 - 3, 5, 45 - 3, 3};
  CHECK(repeats_in_rounds(batches, {60, 5, 45}) == expected);
  CHECK(repeats_in_rounds(order, {60, 5, 45}) == expected);
  const std::string two =
      "      - {job: a, repeats_per_hour: 1, batch_size: 2}\n      - {job: b, repeats_per_hour: 1, batch_size: 2}\n";
  CHECK(refusal(of_programs(two, "    order: [{job: a}, {job: b}]\n"))
            .find("duties.yaml:6:9: error: 'a' has a batch_size, and duty 'd' an order") != std::string::npos);
  CHECK(refusal(of_programs(
                    "      - {job: b, repeats_per_hour: 1}\n      - {job: a, repeats_per_hour: 1, batch_size: 2}\n"))
            .find("duties.yaml:6:9: error: 'a' alone has a batch_size") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1, batch_size: 1.5}\n")).find("batch_size") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1, batch_size: -1}\n")).find("batch_size") !=
        std::string::npos);
}

TEST_CASE("a file of duties that contradicts itself is refused at its place") {
  CHECK(refusal(of_programs("      - {job: a}\n")).find("duties.yaml:5:9: error: 'a' has 0 numbers") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1, percent_of_time: 2}\n")).find("'a' has 2 numbers") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: -1}\n")).find("repeats_per_hour") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, percent_of_repeats: 10}\n")).find("give repeats_per_hour of the duty") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n      - {job: a, repeats_per_hour: 2}\n"))
            .find("occurs twice") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, percent_of_repeats: 60}\n      - {job: b, percent_of_repeats: 60}\n",
                            "    repeats_per_hour: 5\n"))
            .find("adds up to 120 %") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, percent_of_time: 60}\n      - {job: b, percent_of_time: 60}\n"))
            .find("percent_of_time adds up to 120 %") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    history: [{duty: dd, hours: 5}]\n"))
            .find("did you mean 'd'?") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    order: [{job: a}, {job: b}]\n"))
            .find("'b' in the order is no program of duty 'd'") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    order: [{job: a}]\n"))
            .find("has no change to another") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    order: [{job: a, repeats: 0}]\n"))
            .find("repeats") != std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeat_per_hour: 1}\n")).find("did you mean 'repeats_per_hour'") !=
        std::string::npos);
  CHECK(refusal(of_programs("      - {job: a, repeats_per_hour: 1}\n", "    batch_size: 5\n"))
            .find("'batch_size' is a key of each program, not of the duty; write it in the entries of programs: {job: "
                  "NAME, batch_size: 5}") != std::string::npos);
  CHECK(refusal("study: s\nduties: [{name: T\xfcr}]\n").find("duties.yaml:2: error: is no text in UTF-8") !=
        std::string::npos);
  CHECK(refusal("study: s\nduties: []\n").find("duties") != std::string::npos);
  CHECK(refusal("duties: [{name: d, programs: [{job: a, percent_of_time: 5}]}]\n").find("study") != std::string::npos);
}
