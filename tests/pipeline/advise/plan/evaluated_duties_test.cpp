// Duties from life files, every number against (D1) and (D2) at the medians: with one common scatter a percentile of the life under
// several programs is that of the damage per hour of the medians.
#include "pipeline/advise/plan/evaluated_duties.h"

#include <algorithm>
#include <cmath>

#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/rounds.h"
#include "pipeline/job/job.h"
#include "tests/catch.h"
#include "tests/pipeline/life/straight_response.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double decade = 0.1;  // of lives between 10 and 50 %, and 50 and 90 %

/// Two conductors of the cable lead, one of bus, each of one wire; damages of their wires per repeat.
using Damages = std::array<double, 3>;
struct Program {
  std::string job;
  double repeat_seconds;
  Damages damage;

  double worst_of_lead() const { return std::max(damage[0], damage[1]); }
};

LifeResponse response_of(const std::string& cable, double life) {
  LifeResponse response = straight_response(0, 0, 0, std::log10(life));
  response.mode = "wires of " + cable;
  response.knowledge.mean.setZero(), response.knowledge.covariance.setZero();
  return response;
}

RankingRow row_of(const Scratch& scratch, const Program& program, FailureModes modes = {}) {
  SampleLife life;
  life.segments = 4, life.lines = 1, life.samples = 3;
  life.repeats = 1 / program.damage[0];
  life.worst_component = "lead 1/wire 1";
  life.more_sites = {{"lead 2/wire 1", program.damage[1]}, {"bus/wire 1", program.damage[2]}};
  life.conductors = {{"lead 1", 1}, {"lead 2", 1}, {"bus", 1}};
  RankingRow row;
  row.job = program.job, row.repeat_seconds = program.repeat_seconds, row.life_file = scratch / (program.job + ".h5");
  row.robot_life_hours = 40000, row.worst_segment_from_tool = 1;
  if (modes.empty())
    modes = {response_of("lead", 1 / program.worst_of_lead()), response_of("bus", 1 / program.damage[2])};
  row.life_response = modes_text(modes);
  write_sample_life(row.life_file, life);
  return row;
}

struct Case {
  Scratch scratch;
  std::vector<Program> programs{
      {"a", 30, {4e-6, 1e-6, 2e-7}}, {"b", 60, {1e-6, 3e-6, 1e-7}}, {"c", 10, {1e-9, 2e-9, 9e-6}}};
  Study study{"s", {}, Keep::all};
  std::vector<RankingRow> rows;
  Case() {
    for (const Program& program : programs)
      rows.push_back(row_of(scratch, program)), study.jobs.push_back({program.job, std::make_shared<const Job>(), ""});
  }
  DutyFile file(const std::string& text) const {
    return read_duties(scratch.write("duties.yaml", "study: s\nduties:\n" + text));
  }
};

/// Damage per hour under repeats (program) at one place of the cable; round: damages of its repeats beside the programs.
struct ByHand {
  std::array<double, 2> rate{}, share{};  ///< (lead, bus) R of (D1), c of (D2)

  ByHand(const std::vector<Program>& programs, const std::vector<double>& repeats)
      : ByHand(programs, repeats, repeats, {}) {}
  ByHand(const std::vector<Program>& programs, const std::vector<double>& repeats, const std::vector<double>& in_rounds,
         const Damages& round) {
    Damages at{};
    for (std::size_t place = 0; place < 3; ++place) {
      for (std::size_t k = 0; k < programs.size(); ++k) at[place] += in_rounds[k] * programs[k].damage[place];
      if (in_rounds.size() > programs.size()) at[place] += in_rounds.back() * round[place];
    }
    for (std::size_t m = 0; m < 2; ++m) {
      double apart = 0, alone = 0;
      for (std::size_t k = 0; k < programs.size(); ++k) {
        const double of = repeats[k] * (m == 0 ? programs[k].worst_of_lead() : programs[k].damage[2]);
        apart += of, alone = std::max(alone, of);
      }
      const double together = m == 0 ? std::max(at[0], at[1]) : at[2];
      share[m] = together / apart, rate[m] = std::max(together, alone);
    }
  }
  double hours() const { return 1 / std::max(rate[0], rate[1]); }
};

/// 10, 50 and 90 % of a life of this median. Of 10,000 samples and more, in equal shares of the scatter.
void check_lives(const LifePercentiles& lives, double median) {
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(lives[k] == Approx(median * std::pow(10, decade * (double(k) - 1))).epsilon(1e-3));
}

}  // namespace

TEST_CASE("duties: every number of an evaluation follows from the damage at each place") {
  Case of;
  for (std::size_t k = 0; k < 3; ++k)
    of.rows[k].planned_errors = {std::pow(10, 0.1 * double(k)), 1.01, k == 1 ? NAN : 2};
  const auto [files, rates] = std::pair(
      of.file(
          "  - name: d\n    hours_per_week: 100\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 30}, {job: c, "
          "percent_of_time: 5}]\n    history: [{duty: e, hours: 300}, {duty: d, hours: 400}]\n"
          "  - {name: e, programs: [{job: c, repeats_per_hour: 100}]}\n"),
      std::vector<double>{20, 30, 18});
  const std::vector<DutyResult> results = evaluated(files, of.study, of.rows);
  REQUIRE(results.size() == 2);
  const DutyResult& duty = results[0];
  const ByHand by_hand(of.programs, rates);
  CHECK(duty.name == "d");
  CHECK(duty.hours_per_week == 100);
  CHECK(duty.robot_life_hours == 40000);
  CHECK(duty.modes == std::vector<std::string>{"wires of lead", "wires of bus"});
  CHECK(duty.changes == std::vector<double>{1, 1});
  CHECK(duty.past_hours == 700);
  CHECK(results[1].past_hours == 0);
  for (std::size_t m = 0; m < 2; ++m) CHECK(duty.damage.same_place[m] == Approx(by_hand.share[m]).epsilon(1e-12));
  REQUIRE(by_hand.rate[1] > 1.3 * by_hand.rate[0]);  // bus fails first, in every sample of the one scatter
  check_lives(duty.lives.percentiles, by_hand.hours());
  check_lives(results[1].lives.percentiles, 1 / (100 * 9e-6));
  double idle = 1;
  for (std::size_t k = 0; k < 3; ++k) idle -= rates[k] * of.programs[k].repeat_seconds / 3600;
  for (std::size_t k = 0; k < 3; ++k) {
    const DutyPart& part = duty.parts[k];
    INFO(part.job);
    const auto hours_at = [&, now = rates](double factor) {
      std::vector<double> changed = now;
      changed[k] *= factor;
      return ByHand(of.programs, changed).hours();
    };
    CHECK(part.job == of.programs[k].job);
    CHECK(part.repeats_per_hour == Approx(rates[k]).epsilon(1e-12));
    const double share = rates[k] * of.programs[k].repeat_seconds / 3600;
    CHECK(part.share_of_time == Approx(share).epsilon(1e-12));
    // The response in the row has the life's log10 with six digits.
    CHECK(duty.lives.share[k] == Approx(rates[k] * of.programs[k].damage[2] / by_hand.rate[1]).epsilon(1e-5));
    check_lives(part.without, hours_at(0));
    if (share <= idle)
      check_lives(part.as_twice, hours_at(2));
    else
      CHECK(std::isnan(part.as_twice[0]));  // more than an hour per hour
    REQUIRE(part.over_share.size() == 11);
    for (std::size_t i = 0; i < 11; ++i) {
      CHECK(part.over_share[i].share_of_time == Approx((share + idle) * double(i) / 10).margin(1e-12));
      check_lives(part.over_share[i].hours, hours_at((share + idle) * double(i) / 10 / share));
    }
  }
  CHECK(duty.errors[0] == Approx(std::pow(10, 0.1 * duty.lives.share[1] + 0.2 * duty.lives.share[2])));
  CHECK(std::isnan(duty.errors[2]));
  CHECK(results[1].errors[0] == Approx(std::pow(10, 0.2)));
  CHECK(results[1].errors[2] == Approx(2));  // the program without a number does not run there
  // Before, bus had 300 h under e and 400 h under d. All survive; the rest of each life is that of its sample.
  CHECK(duty.lives.survived == 1);
  for (std::size_t p = 0; p < 3; ++p) {
    const double scatter = std::pow(10, decade * (double(p) - 1)),
                 left = scatter - 300 * 100 * 9e-6 - 400 * by_hand.rate[1];
    CHECK(duty.lives.remaining[p] == Approx(left / by_hand.rate[1]).epsilon(3e-3));
  }
}

TEST_CASE("duties: damage at other rests is compared with that at the median of all rests") {
  constexpr std::size_t rest = index_of(Uncertain::rest);
  Case of;
  LifeResponse lead = response_of("lead", 1e5);
  // 5.5 and 6.5 decades at the mean and one deviation above it; 4.75 at one below
  for (const auto& [z, decades] : {std::pair(-1.0, -0.5), {2.0, 2.0}}) {
    lead.points.emplace_back()[rest] = z, lead.inside.push_back(Inside::as_is);
    for (std::size_t k = 0; k < lead.strength.size(); ++k) lead.worst_life.push_back(lead.worst_life[k] + decades);
  }
  lead.knowledge.mean[rest] = 0.5, lead.knowledge.covariance(rest, rest) = 1;
  of.rows[0] = row_of(of.scratch, of.programs[0], {lead, response_of("bus", 1e9)});
  const DutyFile file = of.file("  - {name: d, programs: [{job: a, repeats_per_hour: 20, recording_of: cycle}]}\n");
  const DutyPart part = evaluated(file, of.study, of.rows).at(0).parts.at(0);
  CHECK(part.at_other_rests[0] == Approx(std::pow(10, 0.75)));
  CHECK(part.at_other_rests[1] == Approx(std::pow(10, -1.0)));
}

TEST_CASE("duties: a number at the end of a layer's name belongs to the name of its mode") {
  Case of;
  const DutyFile file = of.file(
      "  - name: d\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 30}]\n"
      "    order: [{job: a, repeats: 4}, {job: b, repeats: 3}]\n");
  of.rows.push_back(row_of(of.scratch, {round_name(file.duties[0]), 100, {9e-6, 2e-6, 5e-7}}));
  of.study.jobs.push_back({of.rows.back().job, std::make_shared<const Job>(), ""});
  const auto put = [&](RankingRow& row, const std::string& layer, double damage) {
    SampleLife life;
    life.segments = 4, life.lines = 1, life.samples = 3;
    life.repeats = 1 / damage, life.worst_component = layer + "/wire 1";
    life.more_sites = {{"ring 3/wire 1", 1e-9}};
    life.conductors = {{layer, 1}, {"ring 3", 1}};
    write_sample_life(row.life_file, life);
    row.life_response = modes_text({response_of("ring 1", 1 / damage), response_of("ring", 1e9)});
  };
  const std::array<double, 3> damages{4e-6, 1e-6, 9e-6};  // of a, b, the round
  for (const std::size_t k : {0u, 1u, 2u}) put(of.rows[k == 2 ? 3 : k], "ring 1", damages[k]);
  const DutyResult duty = evaluated(file, of.study, of.rows).at(0);
  // Five rounds; 15 repeats of a and 25 of b are not their own.
  CHECK(duty.changes.at(0) ==
        Approx((15 * damages[0] + 25 * damages[1] + 5 * damages[2]) / (20 * damages[0] + 30 * damages[1])));
  check_lives(duty.lives.percentiles, 1 / (15 * damages[0] + 25 * damages[1] + 5 * damages[2]));
  for (const std::size_t k : {0u, 1u, 3u}) put(of.rows[k], "lead 1", 1e-6);
  CHECK_THAT(message_of([&] { evaluated(file, of.study, of.rows); }),
             Catch::Contains("none of its conductors belongs to the mode 'wires of ring 1'"));
}

TEST_CASE("duties: an order counts the damage of its round beside the repeats that no change interrupts") {
  Case of;
  const DutyFile file = of.file(
      "  - name: d\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 30}]\n"
      "    order: [{job: a, repeats: 4}, {job: b, repeats: 3}]\n");
  const Damages round{9e-6, 2e-6, 5e-7};
  of.rows.push_back(row_of(of.scratch, {round_name(file.duties[0]), 100, round}));
  of.study.jobs.push_back({round_name(file.duties[0]), std::make_shared<const Job>(), ""});
  const std::vector<Program> two{of.programs[0], of.programs[1]};
  const DutyResult duty = evaluated(file, of.study, of.rows)[0];
  // Five rounds hold all of a, and 15 of the 30 repeats of b; in each round one repeat of a and one of b are the round's own.
  const ByHand by_hand(two, {20, 30}, {15, 25, 5}, round), apart(two, {20, 30});
  CHECK(duty.has_order);
  CHECK(duty.rounds_per_hour == Approx(5));
  CHECK(duty.outside == std::vector<std::string>{"b (50 %)"});
  for (std::size_t m = 0; m < 2; ++m) {
    CHECK(duty.damage.same_place[m] == Approx(by_hand.share[m]).epsilon(1e-12));
    CHECK(duty.changes[m] == Approx(by_hand.share[m] / apart.share[m]).epsilon(1e-12));
  }
  check_lives(duty.lives.percentiles, by_hand.hours());
  check_lives(duty.parts[0].without, ByHand(two, {0, 30}).hours());
  // 30 repeats of 60 s and 20 of 30 s leave 20 minutes, of which five rounds need five times 100 - 60 - 30 s.
  const auto refusal = [&](double seconds) {
    of.rows.back().repeat_seconds = seconds;
    return message_of([&] { evaluated(file, of.study, of.rows); });
  };
  CHECK(refusal(90 + 239).empty());
  CHECK_THAT(
      refusal(90 + 241),
      Catch::Contains(
          "take 60.1 minutes of each hour (20.0 x 30.0 s of 'a', 30.0 x 60.0 s of 'b', 5.00 x 241.0 s of moves between them); give "
          "fewer repeats, or shares of the time that leave 33 % for the moves"));
  CHECK(refusal(90 + 240.05).empty());  // by rounding only
  Case full;
  const DutyFile whole = full.file(
      "  - name: d\n    programs: [{job: a, percent_of_time: 50}, {job: b, percent_of_time: 50}]\n"
      "    order: [{job: a, repeats: 1}, {job: b, repeats: 1}]\n");
  full.rows.push_back(row_of(full.scratch, {round_name(whole.duties[0]), 90.05, round}));
  full.study.jobs.push_back({round_name(whole.duties[0]), std::make_shared<const Job>(), ""});
  CHECK_THAT(
      message_of([&] { evaluated(whole, full.study, full.rows); }),
      Catch::Contains("30.0 x 0.050 s of moves between them); give fewer repeats, or shares of the time that leave "
                      "0.042 % for the moves"));
}

TEST_CASE("duties: the life without a program of an order is not known if its others change between each other") {
  Case of;
  const DutyFile file = of.file(
      "  - name: d\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 20}, {job: c, repeats_per_hour: 20}]\n"
      "    order: [{job: a, repeats: 1}, {job: b, repeats: 1}, {job: c, repeats: 1}]\n"
      "  - name: two\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 20}, {job: c, repeats_per_hour: 20}]\n"
      "    order: [{job: a, repeats: 1}, {job: b, repeats: 1}]\n");
  for (const Duty& duty : file.duties) {
    of.rows.push_back(row_of(of.scratch, {round_name(duty), 100, {9e-6, 8e-6, 9e-6}}));
    of.study.jobs.push_back({round_name(duty), std::make_shared<const Job>(), ""});
  }
  const std::vector<DutyResult> results = evaluated(file, of.study, of.rows);
  for (const DutyPart& part : results.at(0).parts) {
    CHECK(std::isnan(part.without[0]));
    CHECK(std::isnan(part.over_share.at(0).hours[0]));
    CHECK(part.over_share.at(1).hours[0] > 0);
    CHECK(without_text(results[0], part) == "not known");
  }
  // Without a only b is left of the order, which changes to no other program. Without c the round stays.
  check_lives(results.at(1).parts[0].without, ByHand({of.programs[1], of.programs[2]}, {20, 20}).hours());
  check_lives(results.at(1).parts[2].without,
              ByHand({of.programs[0], of.programs[1]}, {20, 20}, {0, 0, 20}, {9e-6, 8e-6, 9e-6}).hours());
}

TEST_CASE("duties: a mode that only the changes of an order damage has a warning") {
  Case of;
  const DutyFile file = of.file(
      "  - name: d\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 20}]\n"
      "    order: [{job: a, repeats: 1}, {job: b, repeats: 1}]\n");
  of.rows.push_back(row_of(of.scratch, {round_name(file.duties[0]), 100, {9e-6, 8e-6, 7e-6}}));
  of.study.jobs.push_back({of.rows.back().job, std::make_shared<const Job>(), ""});
  CHECK(uncounted_changes(file, of.study, of.rows).empty());
  for (const std::size_t k : {0u, 1u}) {
    of.programs[k].damage[2] = 0;
    of.rows[k] = row_of(of.scratch, of.programs[k], {response_of("lead", 1e6), response_of("bus", 1e9)});
  }
  const std::vector<Warning> warnings = uncounted_changes(file, of.study, of.rows);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words,
             Catch::StartsWith(
                 "the order of duty 'd' damages wires of bus by 7e-06 per round, and its programs alone do not"));
  CHECK(evaluated(file, of.study, of.rows).at(0).changes.at(1) == 1);
}

TEST_CASE("duties: what one of the programs leaves out is not evaluated, each part once") {
  Case of;
  of.rows[0].not_evaluated = "power cable, connectors";
  of.rows[1].not_evaluated = "twist of power cable, connectors";
  UnvalidatedMode& wall = of.rows[1].unvalidated.emplace_back();
  wall.mode = UnvalidatedMode::wall, wall.hours[1] = 100, wall.bends_at_limit = 1e6;
  const DutyFile file =
      of.file("  - {name: d, programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 20}]}\n");
  CHECK(evaluated(file, of.study, of.rows).at(0).not_evaluated ==
        "power cable, connectors, twist of power cable, hose's wall");
}

TEST_CASE("duties: a plant's table of lives is the same distribution, and holds what its dresspacks share once") {
  Case of;
  const DutyFile file = of.file(
      "  - name: d\n    hours_per_week: 100\n    programs: [{job: a, repeats_per_hour: 20}, {job: b, repeats_per_hour: 30}]\n"
      "  - {name: e, programs: [{job: c, repeats_per_hour: 100}]}\n  - {name: f, programs: [{job: c, repeats_per_hour: 1}]}\n");
  const auto tables = PlantLives(file, of.study, of.rows, {"d", "e"}).in(50, 64, true);
  REQUIRE(tables.size() == 2);
  for (const auto& [name, median] :
       {std::pair("d", ByHand({of.programs[0], of.programs[1]}, {20, 30}).hours()), std::pair("e", 1 / (100 * 9e-6))}) {
    const LifeTable& table = tables.at(name);
    INFO(name);
    CHECK(table.worlds == 50);
    CHECK(table.hours_per_week == (name == std::string("d") ? 100 : 80));
    CHECK(table.robot_life_hours == 40000);
    CHECK(table.shared.empty());  // nothing is uncertain but the scatter
    std::vector<float> all = table.hours;
    REQUIRE(all.size() == table.worlds * table.draws);
    for (std::size_t w = 0; w < table.worlds; ++w) {
      const auto first = table.hours.begin() + std::ptrdiff_t(w * table.draws);
      std::vector<float> of_draws;
      for (std::size_t d = 0; d < table.draws; ++d) of_draws.push_back(float(table.life(w, d)));
      std::sort(of_draws.begin(), of_draws.end());
      CHECK(std::equal(of_draws.begin(), of_draws.end(), first));
    }
    std::sort(all.begin(), all.end());
    // The 3,200 lives have strata of their own in each draw: shares are exact to a draw's stratum of 2 %, which is 5 % of a deviation.
    for (const auto& [share, decades] : {std::pair(0.1, -decade), {0.5, 0.0}, {0.9, decade}})
      CHECK(std::log10(all[std::size_t(share * double(all.size()))] / median) == Approx(decades).margin(0.05 * decade));
  }
  // Lives that depend on parameters: those of an installation are no plant's, and those without effect no one's.
  LifeResponse lead = straight_response(0.1, 0.2, 0.3), bus = straight_response(0, 0.2, 0.3);
  lead.mode = "wires of lead", bus.mode = "wires of bus";
  bus.construction = "tube", bus.material = "bronze";
  of.rows[0] = row_of(of.scratch, of.programs[0], {lead, bus});
  of.rows[1] = row_of(of.scratch, of.programs[1], {lead, bus});
  std::vector<std::string> found;
  const std::map<std::string, LifeTable> known = PlantLives(file, of.study, of.rows, {"d"}).in(50, 64, false);
  for (const SharedValue& value : known.at("d").shared) {
    found.push_back(std::string(uncertain_parameters()[value.parameter].name) + " of " + value.of);
    REQUIRE(value.z.size() == 50);
    double mean = 0, square = 0;
    for (const double z : value.z) mean += z / 50, square += z * z / 50;
    CHECK(mean == Approx(0).margin(1e-6));
    CHECK(square == Approx(1).margin(0.1));  // 50 strata
  }
  std::sort(found.begin(), found.end());
  CHECK(found ==
        std::vector<std::string>{"friction_inside of hose", "model of ", "strength of bronze", "strength of copper"});
}
