// The order of candidates (M1) to (M5).
#include "pipeline/advise/improve/merit.h"

#include <limits>
#include <random>

#include "pipeline/files/check_names.h"
#include "pipeline/files/receipt.h"
#include "pipeline/study/build_graph.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double robot = 40000;

Outcome outcome(double hours, std::vector<ModeLife> modes = {}, double beyond = -0.5) {
  Outcome of;
  of.hours = hours, of.modes = std::move(modes), of.robot_life = robot;
  of.beyond.assign(outcome_limits, -1.0);
  of.beyond[0] = beyond;
  return of;
}

TEST_CASE("outcome: slack beyond its limits counts as a share of the hose's length") {
  const auto beyond = [](const char* check, double slack, double limit, std::size_t of) {
    const Scratch scratch;
    const auto file = scratch.folder() / files_of_stage(0).receipt;
    std::filesystem::create_directories(file.parent_path());
    const std::string line = fmt::format("{} {} {}\n", slack, limit, check);
    write_receipt(file, {.recipe = "", .input = "", .output = "", .state = {}, .results = {{"checks", line}}},
                  scratch.write("output", ""));
    return outcome_of(RankingRow{}, scratch.folder()).beyond.at(of);
  };
  const auto place = [](const char* name) {
    const std::vector<std::string>& names = outcome_limit_names();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  constexpr double length = 1.5;  // [m]; the limits are 2 % and a third of it
  for (const double missing : {0.004, -0.004})
    CHECK(beyond(check_name::too_short, 0.02 * length - missing, 0.02 * length, place("too short")) ==
          Approx(missing / length));
  for (const double more : {0.2, -0.2})
    CHECK(beyond(check_name::too_long, length / 3 + more, length / 3, place("too long")) == Approx(more / length));
}

void write_empty_receipt(const Scratch& scratch) {
  const auto file = scratch.folder() / files_of_stage(0).receipt;
  std::filesystem::create_directories(file.parent_path());
  write_receipt(file, {.recipe = "", .input = "", .output = "", .state = {}, .results = {}},
                scratch.write("output", ""));
}

TEST_CASE("outcome: a job whose repeats change the dresspack violates a limit, the more the larger the change") {
  const auto outcome = [](std::optional<double> amount) {
    const Scratch scratch;
    write_empty_receipt(scratch);
    RankingRow row;
    row.warnings = {Warning{WarningKind::periodic, "", "it differs. Likely cause: a. Remedy: b", {}, amount}};
    return outcome_of(row, scratch.folder());
  };
  CHECK(outcome(5).words() == "repeatability violated by 5.0 times the limit (remedy: b)");
  CHECK(outcome(5).violation() == Approx(std::log(5)));
  CHECK(outcome(1.2).words() == "repeatability violated by 20 % (remedy: b)");
  CHECK(outcome({}).feasible());  // an unlikely setting of the job, not a change
}

TEST_CASE("merit: wires that live longer than the robot gain nothing by wearing the hose through") {
  // Lives from a search on a handling robot. In the job as it is, the hose rubs nowhere.
  const Outcome as_it_is = outcome(449000, {{"abrasion", never}, {"jacket wear", 5890}});
  const Outcome rubs = outcome(1940000, {{"abrasion", 25000}, {"jacket wear", 8750}});
  const Outcome gentler = outcome(654000, {{"abrasion", never}, {"jacket wear", 9110}});
  const Merit own = merit_of(as_it_is, as_it_is);
  CHECK(own.kept == Kept::modes);
  CHECK(merit_of(rubs, as_it_is).kept == Kept::limits);
  CHECK(merit_of(rubs, as_it_is) < own);
  CHECK(merit_of(gentler, as_it_is) > own);
  CHECK(clearly_better(merit_of(gentler, as_it_is), own));
  CHECK(search_value(gentler, as_it_is) > search_value(as_it_is, as_it_is));
  CHECK(search_value(as_it_is, as_it_is) > search_value(rubs, as_it_is));
  REQUIRE(worse_modes(rubs, as_it_is).size() == 1);
  CHECK(worse_modes(rubs, as_it_is).front().mode == "abrasion");
  CHECK(mode_words(rubs) == "jacket wear from 8,750 h, abrasion from 25,000 h");
  CHECK(mode_words(outcome(1, {{"abrasion", 50000}})).empty());
  // A longer life of the wires alone is not a clear gain, neither beyond the robot's life nor below it.
  CHECK_FALSE(clearly_better(merit_of(outcome(900000), as_it_is), merit_of(outcome(50000), as_it_is)));
  CHECK(clearly_better(merit_of(outcome(30000), as_it_is), merit_of(outcome(20000), as_it_is)));
  CHECK_FALSE(clearly_better(merit_of(outcome(21000), as_it_is), merit_of(outcome(20000), as_it_is)));
}

TEST_CASE("outcome: the largest share of dresspacks that exceed a limit at other values") {
  const Scratch scratch;
  write_empty_receipt(scratch);
  RankingRow row;
  for (const double share : {0.04, 0.25, 0.02})
    row.warnings = joined(row.warnings.value_or(std::vector<Warning>{}),
                          {Warning{WarningKind::other_values, "", "bent. Likely cause: a. Remedy: b", {}, share}});
  AskedLimits asked;
  asked.other_values = 30;
  const Outcome made = outcome_of(row, scratch.folder(), asked);
  CHECK(made.exceeding == 0.25);
  CHECK(made.asked_exceeding == 0.3);
  CHECK(made.feasible());  // with its own values
  CHECK(worst_of({made, outcome(1)}).exceeding == 0.25);
}

TEST_CASE("merit: a job in which more dresspacks exceed a limit at other values is no gain") {
  // Lives and shares of a search on a spot welding robot: it gained 4,400 h of jacket wear and bent 25 instead of 5 %
  // of the dresspacks too tightly.
  const auto exceeding = [](Outcome of, double share) {
    of.exceeding = share;
    return of;
  };
  const Outcome as_it_is = exceeding(outcome(72400, {{"jacket wear", 13100}}), 0.05);
  const Outcome proposed = exceeding(outcome(59400, {{"jacket wear", 17500}}), 0.25);
  const Merit own = merit_of(as_it_is, as_it_is);
  CHECK(merit_of(proposed, as_it_is).kept == Kept::limits);
  CHECK_FALSE(clearly_better(merit_of(proposed, as_it_is), own));
  CHECK(search_value(proposed, as_it_is) < search_value(as_it_is, as_it_is));
  // The same share is a gain. 5.4 % is shown as 5 %.
  CHECK(clearly_better(merit_of(exceeding(proposed, 0.054), as_it_is), own));
  // A user may allow more.
  Outcome asked = proposed;
  asked.asked_exceeding = 0.3;
  CHECK(clearly_better(merit_of(asked, as_it_is), own));
  // A job that exceeds a limit with its own values is no reference, and one that does not run has no dresspack that exceeds one.
  const Outcome broken = outcome(72400, {{"jacket wear", 13100}}, 0.1);
  CHECK(merit_of(proposed, broken).kept == Kept::modes);
  Outcome fails = as_it_is;
  fails.failure = "too short";
  CHECK(exceeds_more(proposed, fails));
}

TEST_CASE("merit: a mode gets worse only before the wires and the end of the robot's life, and by more than a tenth") {
  const Outcome as_it_is = outcome(1000, {{"jacket wear", 2000}, {"abrasion", 60000}});
  const auto worse = [&](double hours, double jacket, double abrasion) {
    return worse_modes(outcome(hours, {{"jacket wear", jacket}, {"abrasion", abrasion}}), as_it_is).size();
  };
  CHECK(worse(1900, 1900, 60000) == 0);   // after the wires
  CHECK(worse(5000, 1900, 60000) == 0);   // shorter by less than a tenth
  CHECK(worse(5000, 1800, 60000) == 1);   // shorter by more
  CHECK(worse(1500, 1600, 60000) == 0);   // shorter, but the wires fail first
  CHECK(worse(90000, 2000, 41000) == 0);  // after the robot
  CHECK(worse(90000, 2000, 39000) == 1);
  CHECK(worse(90000, 1000, 39000) == 2);
  // The modes of a job that does not run are unknown: each mode that fails first counts.
  Outcome fails = as_it_is;
  fails.failure = "too short";
  CHECK(worse_modes(outcome(5000, {{"jacket wear", 4000}}), fails).size() == 1);
  // A mode that the job as it is does not have.
  CHECK(worse_modes(outcome(5000, {{"corkscrew", 0}}), as_it_is).size() == 1);
  CHECK(merit_of(outcome(5000, {{"corkscrew", 0}}), as_it_is).counted_hours == 0);
}

TEST_CASE("merit: limits, then modes, then wires, then the first mode, then the margin") {
  const Outcome as_it_is = outcome(1000, {{"jacket wear", 2000}});
  Outcome fails = outcome(9e5);
  fails.failure = "too short";
  const std::vector<Outcome> rising{fails,
                                    outcome(90000, {}, 0.01),                  // exceeds a limit
                                    outcome(80000, {{"jacket wear", 1000}}),   // one mode gets worse
                                    outcome(900, {{"jacket wear", 30000}}),    // keeps all limits
                                    outcome(1000, {{"jacket wear", 1900}}),    // longer life
                                    outcome(50000, {{"jacket wear", 3000}}),   // outlives the robot
                                    outcome(45000, {{"jacket wear", 20000}}),  // also, and its jackets last longer
                                    outcome(60000, {{"jacket wear", 70000}}, -0.1),
                                    outcome(50000, {{"jacket wear", 50000}}, -0.2),  // larger distance to the limit
                                    outcome(60000, {{"jacket wear", 50000}}, -0.2)};
  for (std::size_t a = 0; a < rising.size(); ++a)
    for (std::size_t b = 0; b < rising.size(); ++b) {
      INFO(a << " " << b);
      CHECK((merit_of(rising[a], as_it_is) < merit_of(rising[b], as_it_is)) == (a < b));
    }
}

TEST_CASE("merit: a trial that alone keeps all limits is no gain if a mode makes the first failure earlier") {
  const Outcome as_it_is = outcome(9e5, {{"abrasion", 1790}}, 0.02);
  const auto gain = [&](const Outcome& trial) {
    return clearly_better(merit_of(trial, as_it_is), merit_of(as_it_is, as_it_is));
  };
  CHECK(merit_of(outcome(9e5, {{"abrasion", 1100}}), as_it_is) > merit_of(as_it_is, as_it_is));
  CHECK_FALSE(gain(outcome(9e5, {{"abrasion", 1100}})));
  CHECK(gain(outcome(9e5, {{"abrasion", 1640}})));  // earlier by less than a tenth
  CHECK(gain(outcome(500, {{"abrasion", 1100}})));  // no mode gets worse: the price of a limit that is kept
  const Outcome worn = outcome(100, {{"abrasion", 1790}}, 0.02);  // the wires failed first, and live longer now
  CHECK(clearly_better(merit_of(outcome(9e5, {{"abrasion", 1100}}), worn), merit_of(worn, worn)));
}

TEST_CASE("merit: the value of a search follows the order where all limits are kept and no mode gets worse") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decades(1, 7);
  const Outcome as_it_is = outcome(100, {{"abrasion", 1}});
  int compared = 0;
  for (int k = 0; k < 2000; ++k) {
    const Outcome a = outcome(std::pow(10, decades(random)), {{"abrasion", std::pow(10, decades(random))}});
    const Outcome b = outcome(std::pow(10, decades(random)), {{"abrasion", std::pow(10, decades(random))}});
    const Merit one = merit_of(a, as_it_is), other = merit_of(b, as_it_is);
    if (one.counted_hours == other.counted_hours && one.first_hours == other.first_hours) continue;
    ++compared;
    CHECK((search_value(a, as_it_is) < search_value(b, as_it_is)) == (one < other));
  }
  CHECK(compared > 1000);
  // Finite if nothing fails, if no robot moves, or if everything fails at once.
  Outcome endless = outcome(never);
  CHECK(std::isfinite(search_value(endless, endless)));
  endless.robot_life = never;
  CHECK(std::isfinite(search_value(endless, endless)));
  CHECK(merit_of(endless, endless).first_hours == never);
  CHECK(std::isfinite(search_value(outcome(0, {{"kink", 0}}), as_it_is)));
}

}  // namespace
}  // namespace dresslife::pipeline
