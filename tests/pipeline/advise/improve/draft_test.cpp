// Jobs without a routing, and dresspacks of another size.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "pipeline/advise/improve/draft.h"
#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/outcome.h"
#include "pipeline/advise/improve/scaled.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/files/check_names.h"
#include "pipeline/files/receipt.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/build_graph.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Returns the folder of a job whose simulation noted these lines of checks.
std::filesystem::path job_with(const Scratch& scratch, const std::string& checks) {
  const std::filesystem::path output = scratch.write("job/motion.h5", "what the receipt is of"),
                              folder = output.parent_path();
  const std::filesystem::path receipt = folder / files_of_stage(0).receipt;
  std::filesystem::create_directories(receipt.parent_path());
  Receipt made;
  made.recipe = "recipe", made.input = "-", made.output = "output";
  made.results = {{"checks", checks}};
  write_receipt(receipt, made, output);
  return folder;
}

const std::string found_routing =
    "base_clamp: {link: link_3, position_m: [0, 0, 0.4], direction: [1, 0, 0.4]}\n"
    "tool_clamp: {link: link_6, position_m: [0.1, 0, 0.2], direction: [1, 0, 0]}\nfree_length_m: 2.1\n";

}  // namespace

TEST_CASE("a dresspack in another size is similar to itself") {
  const Dresspack whole = draft_of({.of = "abb_irb6640_185_280"}).job.dresspacks.front().dresspack;
  const Dresspack half = scaled(whole, 0.5);
  CHECK(half.diameter == whole.diameter / 2);
  CHECK(half.mass_per_length == whole.mass_per_length / 4);
  CHECK(half.bending_stiffness == whole.bending_stiffness / 16);
  CHECK(half.hose_corrugation->wall == whole.hose_corrugation->wall / 2);
  const Component &part = whole.components.front().components.front(),
                  &small = half.components.front().components.front();
  CHECK(small.radius == part.radius / 2);
  CHECK(small.components.front().helix_radius == part.components.front().helix_radius / 2);
  CHECK(small.lay_angle == part.lay_angle);
  const Dresspack back = scaled(half, 2);
  CHECK(back.torsional_stiffness == whole.torsional_stiffness);
  CHECK(back.components.front().measured_bending_stiffness == whole.components.front().measured_bending_stiffness);
}

TEST_CASE("a robot's name is enough for a job, once a routing and a motion are found") {
  const Draft draft = draft_of({.of = "kuka_kr16_2", .dresspack = "sensor_cable"});
  CHECK(draft.exercise);
  CHECK(draft.job.dresspacks.front().routing.base_clamp->link == "link_3");
  CHECK(draft.job.dresspacks.front().routing.tool_clamp->link == "link_6");
  const std::string motion = "{name: m, source: none, steps: [{joints_deg: [0, -90, 90, 0, 0, 0]}]}";
  const Node as_it_is = routed(draft, found_routing, motion, 1);
  CHECK(as_it_is.find("robot")->text == "kuka_kr16_2");  // names are not replaced
  CHECK(as_it_is.find("dresspack")->text == "sensor_cable");
  CHECK(job_from(as_it_is).dresspacks.front().routing.free_length == 2.1);
  const Job small = job_from(routed(draft, found_routing, motion, 0.5));
  CHECK(small.dresspacks.front().dresspack.diameter == Approx(0.0085 / 2).epsilon(1e-12));
}

TEST_CASE("of a job all but the routing is kept, and what cannot be routed is refused") {
  const Draft draft = draft_of({.of = "side_panel", .tool_link = "link_5", .sets = {"simulation.segments=20"}});
  CHECK_FALSE(draft.exercise);
  CHECK(draft.job.dresspacks.front().routing.tool_clamp->link == "link_5");
  CHECK(job_from(routed(draft, found_routing, "", 1)).simulation.segments == 20);
  CHECK_THROWS_WITH(draft_of({.of = "irb6640_two_dresspacks"}),
                    Catch::Contains("a routing is proposed for one dresspack"));
  CHECK_THROWS_WITH(draft_of({.of = "no_such_thing"}), Catch::Contains("'no_such_thing' is not in the catalogue"));
  CHECK_THROWS_WITH(draft_of({.of = "side_panel", .tool_link = "link_9"}), Catch::Contains("link_9"));
  // A routing may lack keys, but it has no others and no wrong values.
  const Scratch scratch;
  const auto of_routing = [&](const std::string& routing) {
    return draft_of({.of = scratch.write("job.yaml", "robot: kuka_kr16_2\nrouting: " + routing + "\n").string(),
                     .dresspack = "sensor_cable"});
  };
  for (const char* routing : {"{base_clamp: {link: link_2}, rings: [{link: link_4}]}", ""})
    CHECK_NOTHROW(of_routing(routing));
  CHECK_THROWS_WITH(of_routing("{base_clamp: {link: link_2, positon_m: [0, 0, 0.3]}}"),
                    Catch::Contains("job.yaml:2:38: error: unknown key 'routing.base_clamp.positon_m'; did you mean "
                                    "'position_m'?"));
  CHECK_THROWS_WITH(of_routing("{sied: left}"), Catch::Contains("did you mean 'side'?"));
  CHECK_THROWS_WITH(of_routing("{free_length_m: -2}"), Catch::Contains("routing.free_length_m is -2 (must be > 0"));
}

TEST_CASE("entries of a job stay references in its own folder, and in another one as far as they are files") {
  const Scratch scratch;
  const std::string source = DRESSLIFE_SOURCE_DIR;
  const auto copy = [&](const std::string& name, const std::string& of) {
    std::filesystem::create_directories((scratch / name).parent_path());
    std::filesystem::copy_file(source + "/config/" + of, scratch / name);
  };
  copy("robots/mine.yaml", "robots/kuka_kr16_2.yaml");
  copy("hose.yaml", "dresspacks/sensor_cable.yaml");
  copy("weld.src", "programs/pick_and_place.src");
  const auto job = scratch.write(
      "job.yaml", "robot: mine\nmotion: {program: weld.src, passes: 1}\ndresspack: hose.yaml\nrouting: {" +
                      std::string("base_clamp: {link: link_3}}\n"));
  const Draft draft = draft_of({.of = job.string()});
  const Node beside = routed(draft, found_routing, "", 1, scratch / ".");
  CHECK(beside.find("robot")->text == "mine");
  CHECK(beside.find("motion")->find("program")->text == "weld.src");
  CHECK(beside.find("motion")->entries.size() == 2);
  CHECK(beside.find("dresspack")->text == "hose.yaml");
  const auto lines = to_yaml(beside);
  CHECK(std::count(lines.begin(), lines.end(), '\n') <= 15);  // robot 1, motion 3, dresspack 1, routing 10
  const auto found = scratch.write("found.yaml", lines);
  CHECK(job_text(read_job(found)) == job_text(job_from(routed(draft, found_routing, "", 1))));
  // Lines that change a named robot stay lines, unless --set changes more of it.
  const std::string boxes = "robot.links.7.boxes";
  const auto changed = scratch.write(
      "changed.yaml", read_text(job) + boxes + ": [{position_m: [0.2, 0, 0], sides_m: [0.1, 0.1, 0.1]}]\n");
  const Draft of_changed = draft_of({.of = changed.string()});
  const Node lines_beside = routed(of_changed, found_routing, "", 1, scratch / ".");
  CHECK(lines_beside.find("robot")->text == "mine");
  REQUIRE(lines_beside.find(boxes));
  const auto found_changed = scratch.write("found_changed.yaml", to_yaml(lines_beside));
  CHECK(job_text(read_job(found_changed)) == job_text(job_from(routed(of_changed, found_routing, "", 1))));
  CHECK(routed(draft_of({.of = changed.string(), .sets = {"robot.links.7.boxes=[]"}}), found_routing, "", 1,
               scratch / ".")
            .find("robot")
            ->find("joints"));
  // In another folder a name relative to this folder is not valid.
  const auto other = scratch.write("other/found.yaml", to_yaml(routed(draft, found_routing, "", 1, scratch / "other")));
  CHECK(read_document(other).find("dresspack")->text == "./../hose.yaml");
  CHECK(read_document(other).find("robot")->find("joints"));
  CHECK(part_text(read_job(other), JobPart::sim) == part_text(read_job(found), JobPart::sim));
}

TEST_CASE("a routed job keeps its calibration in another folder, and the side of its hose") {
  const Scratch scratch;
  const std::string job = read_text(DRESSLIFE_SOURCE_DIR "/config/jobs/side_panel.yaml");
  std::filesystem::copy_file(DRESSLIFE_SOURCE_DIR "/config/observations/typical_cables.yaml", scratch / "cal.yaml");
  const auto file = scratch.write("job.yaml", job + "calibration: cal.yaml\n");
  const Draft draft = draft_of({.of = file.string(), .sets = {"routing.side=right"}});
  CHECK(draft.job.dresspacks.front().routing.side == Side::right);
  CHECK(routed(draft, found_routing, "", 1).find("routing")->find("side")->text == "right");
  CHECK(routed(draft, found_routing + "side: left\n", "", 1).find("routing")->find("side")->text == "left");
  CHECK(routed(draft, found_routing, "", 1, scratch / ".").find("calibration")->text == "cal.yaml");
  std::filesystem::create_directories(scratch / "other");
  const Node other = routed(draft, found_routing, "", 1, scratch / "other");
  CHECK(other.find("calibration")->text == "./../cal.yaml");
  CHECK(read_job(scratch.write("other/found.yaml", to_yaml(other))).calibration.has_value());
}

TEST_CASE("the worst of several jobs has the least life and the most of each limit") {
  Outcome good, tight;
  good.hours = std::numeric_limits<double>::infinity();
  good.beyond.assign(outcome_limits, -0.5);
  good.modes = {{"jacket wear", 500}}, good.robot_life = 40000;
  tight = good;
  tight.hours = 100;
  tight.beyond[0] = 0.25;
  tight.reached.resize(outcome_limits);
  tight.reached[0] = "467 mm, at least 600 mm";
  tight.modes = {{"jacket wear", 900}, {"abrasion", 70}};
  const Outcome worst = worst_of({good, tight});
  CHECK(worst.hours == 100);
  CHECK(worst.violation() == 0.25);
  CHECK_FALSE(worst.feasible());
  CHECK(worst.words() == "bend radius violated by 22 % (467 mm, at least 600 mm)");
  CHECK(worst.robot_life == 40000);
  CHECK(mode_words(worst) == "abrasion from 70.0 h, jacket wear from 500 h");
  CHECK(good.feasible());
  RankingRow failed;
  failed.failure = "job.yaml: error: routing.free_length_m is too short; make it longer";
  CHECK_FALSE(outcome_of(failed, "nowhere").feasible());
  for (const std::string other :
       {"motion.h5: error: cannot be written (No space left on device); free space, then run again",
        "dresslife-sim ended without a message (killed, or out of memory?)"}) {
    failed.failure = other;
    CHECK_THROWS_AS(outcome_of(failed, "nowhere"), MachineFault);
  }
  RankingRow lost;  // its state is done, but its simulation's notes are missing
  lost.planned_hours = {1, 2, 3};
  CHECK_THROWS_AS(outcome_of(lost, "nowhere"), MachineFault);
}

TEST_CASE("pieces of the bend radius join those that are there, and other limits keep theirs") {
  const std::vector<std::string>& names = outcome_limit_names();
  const auto bend = static_cast<std::size_t>(std::find(names.begin(), names.end(), "bend radius") - names.begin());
  std::vector<std::vector<double>> pieces;
  add_bends(pieces, {0.1, -0.2});
  REQUIRE(pieces.size() > bend);
  CHECK(pieces[bend] == std::vector<double>{0.1, -0.2});
  pieces.resize(bend + 3, {7});
  add_bends(pieces, {0.3});
  REQUIRE(pieces.size() == bend + 3);
  CHECK(pieces[bend] == std::vector<double>{0.1, -0.2, 0.3});
  CHECK(pieces[bend + 2] == std::vector<double>{7});
}

TEST_CASE("of a screened candidate the violated limits are named, each with its own share") {
  ScreenedList list;
  list.limits = {"too short", "bracket", "twisted too far"};
  CHECK(list.words({"", "", true, {0.25, -1, 0.5}}) == "too short by 25 % of the length, twisted too far by 50 %");
  CHECK(list.words({"", "", false, {-0.25, 0, -0.5}}) == "");
  CHECK(ScreenedCandidate{"", "", true, {0.25, -1, 0.5}}.violation() == 0.75);
}

TEST_CASE("a check counts as passed on the far side of its limit, and as kept on the near side") {
  struct {
    const char* name;
    double value, limit, beyond;  // only its own limit is exceeded, by `beyond`; 0: kept
  } const cases[] = {
      {check_name::bend_radius, 0.2, 0.25, std::log(1.25)},
      {check_name::bend_radius, 0.3, 0.25, 0},
      {check_name::twist, 3.6, 3, 0.2},
      {check_name::twist, -3.6, 3, 0.2},
      {check_name::twist, -2.4, 3, 0},
      {check_name::tension, 50, 40, std::log(1.25)},
      {check_name::tension, 30, 40, 0},
      {check_name::contact_force, 50, 40, std::log(50 / 45.0)},
      {check_name::contact_force, 43, 40, 0},
      {check_name::travel, 0.5, 0.4, 0.25},
      {check_name::travel, 0.39, 0.4, 0},
  };
  const RankingRow done = [] {
    RankingRow row;
    row.planned_hours = {1, 2, 3};
    return row;
  }();
  for (const auto& one : cases) {
    INFO(one.name << " " << one.value << " of " << one.limit);
    const Scratch scratch;
    AskedLimits asked;
    asked.contact_force = 45;
    const Outcome outcome =
        outcome_of(done, job_with(scratch, fmt::format("{} {} {}\n", one.value, one.limit, one.name)), asked);
    CHECK(outcome.failure == "");
    CHECK(outcome.violation() == Approx(one.beyond).margin(1e-8));  // a full stroke counts as 1e-9
  }
}

TEST_CASE(
    "modes beside the wires have limits in hours, and a limit of what a job does not evaluate is refused at its place") {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const auto mode = [](const char* name, double early, double median) {
    UnvalidatedMode of;
    of.mode = name, of.hours = {early, median, 10 * median};
    return of;
  };
  RankingRow row;
  row.job = "hard", row.planned_hours = {1, 2, 3}, row.not_evaluated = "abrasion, kinks";
  row.unvalidated = {mode(UnvalidatedMode::rating, 500, 2000), mode(UnvalidatedMode::rating, 8000, 9000),
                     mode(UnvalidatedMode::wall, UnvalidatedMode::unknown, 700)};
  const Scratch scratch;
  const std::filesystem::path folder = job_with(scratch, "");
  AskedLimits asked;
  asked.where = {"study.yaml", 7};
  CHECK(outcome_of(row, folder, asked).violation() == 0);
  asked.rating = 1000, asked.wall = 1000;  // the first of several; of the wall the median
  CHECK(outcome_of(row, folder, asked).violation() == Approx(std::log(2.0) + std::log(1000 / 700.0)));
  asked.rating = 500, asked.wall = 700;  // exactly at the limits
  CHECK(outcome_of(row, folder, asked).violation() == 0);
  row.unvalidated.push_back(mode(UnvalidatedMode::jacket, 400, 4000));
  row.unvalidated.push_back(mode(UnvalidatedMode::jacket, 7000, 8000));
  row.unvalidated.back().dresspack = "inner";
  row.robot_life_hours = 30000;
  const Outcome outcome = outcome_of(row, folder, asked);
  CHECK(outcome.robot_life == 30000);
  CHECK(mode_words(outcome) ==
        "jacket wear from 400 h, maker's rating from 500 h, hose's wall from 700 h, jacket wear of inner from 7,000 h");
  row.unvalidated.pop_back();
  asked.jacket = 1200;
  CHECK(outcome_of(row, folder, asked).violation() == Approx(std::log(3.0)));
  CHECK(outcome_of(row, folder, asked).words() == "jacket wear violated by 67 % (400 h, at least 1,200 h)");
  row.unvalidated.pop_back(), asked.jacket.reset();
  row.unvalidated.push_back(mode(UnvalidatedMode::corkscrew, 100, 200));
  asked.corkscrew = 200;
  CHECK(outcome_of(row, folder, asked).words() == "corkscrew violated by 50 % (100 h, at least 200 h)");
  row.unvalidated.pop_back(), asked.corkscrew.reset();
  row.unvalidated.push_back(mode(UnvalidatedMode::kink, endless, endless));
  row.unvalidated.back().margin = 1.5, asked.kink = 3;
  CHECK(outcome_of(row, folder, asked).words() == "kink violated by 50 % (1.50 times, at least 3.00 times)");
  row.unvalidated.back().margin = endless;  // nothing bends
  CHECK(outcome_of(row, folder, asked).violation() == 0);
  row.unvalidated.pop_back(), asked.kink.reset();
  row.unvalidated[0].hours.fill(endless), row.unvalidated[1].hours.fill(endless);
  asked.rating = 1e5;
  CHECK(outcome_of(row, folder, asked).violation() == 0);
  CHECK_NOTHROW(check_evaluated(asked, row));
  asked.abrasion = 1000;
  CHECK_THROWS_WITH(
      check_evaluated(asked, row),
      Catch::StartsWith("study.yaml:7: error: abrasion_life_h is a limit of 'abrasion', which is not evaluated") &&
          Catch::Contains("abrasion, kinks"));
  row.failure = "too short";  // then the failure itself is reported
  CHECK_NOTHROW(check_evaluated(asked, row));
}

TEST_CASE(
    "candidates have the whole error of computed lives, also the job whose dresspacks a calibration has observed") {
  const Scratch scratch;
  const Job plain = job_from(parse_yaml(sample_job, "test.yaml"));
  Calibration calibration;
  calibration.own_spread = 0.2;
  calibration.under = learned_under({&plain});
  calibration.under.motions = motion_digest(plain);
  LearnedParameter strength;
  strength.name = "strength", strength.covariance = {0.25};
  calibration.parameters = {strength};
  scratch.write("learned.yaml", to_yaml(echo_fields(calibration)));
  const auto file = scratch.write("job.yaml", sample_job + "calibration: learned.yaml\n");
  CHECK(read_job(file).calibration->residual_spread == 0.2);
  ImproveRequest request;
  request.file = file;
  for (const auto& sets : {std::vector<std::string>{}, {"routing.free_length_m=1.25"}}) {
    const std::vector<StudyJob> jobs = changed_jobs(request, sets, "trial");
    REQUIRE(jobs.size() == 1);
    CHECK(jobs[0].job->calibration->residual_spread == 1);
    CHECK(jobs[0].job->calibration->own_spread == 0.2);
  }
}

}  // namespace dresslife::pipeline
