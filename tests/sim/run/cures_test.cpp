// The remedies that warnings name: after each is applied, its warning disappears.
#include "sim/run/cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "pipeline/base/constants.h"
#include "pipeline/cable/bend_limit.h"
#include "sim/run/quick_checks.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

std::string words_of(const pipeline::Job& job, pipeline::WarningKind kind) {
  const Simulation simulation(job);
  const RunSummary summary = simulation.run({[](const Sample&) {}});
  std::string words;
  for (const pipeline::Warning& warning : warnings_of(simulation, summary))
    if (warning.kind == kind) words += warning.words + "\n";
  return words;
}

double value_of(const std::string& words, const std::string& key) {
  const std::size_t remedy = words.find("Remedy: "), at = words.find(key + ": ", remedy);
  INFO(words);
  REQUIRE(remedy != std::string::npos);
  REQUIRE(at != std::string::npos);
  return std::stod(words.substr(at + key.size() + 2));
}

std::string of_length_and_bend(const pipeline::Job& job) {
  for (const pipeline::Warning& warning : quick_warnings(job).warnings)
    if (warning.kind == pipeline::WarningKind::bend_radius || warning.kind == pipeline::WarningKind::slack)
      return warning.words;
  return "";
}

/// Returns a job whose tool clamp approaches the base clamp and moves away.
pipeline::Job swinging_job(double free_length) {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  job.simulation.floor = false;
  job.robot.joints[0].axis = {0, 0, 1};
  job.robot.joints[0].origin = {0.05, 0, 1};
  job.motion.steps = {move_to(pi / 3), move_to(-pi / 3, "sweep"), move_to(pi / 3)};
  job.dresspacks[0].routing.free_length = free_length;
  return job;
}

TEST_CASE("a short run of a long program ends after its share of work, with the checks until then") {
  pipeline::Job job = simple_job();
  job.simulation.segments = 60;
  job.motion.steps = {move_to(0), move_to(0.5), dwell_for(900), move_to(0)};  // 180,000 steps of 60 segments: 1.1e7
  const ShortRun run = short_run(job, short_run_segments);
  INFO(run.refusal);
  REQUIRE(run.stopped_at);
  CHECK(*run.stopped_at < 900);
  CHECK_FALSE(run.checks.empty());
  constexpr double most = 5e6, samples = 1.02;  // the limit, and the interval in which it is exceeded
  CHECK(run.work > most / 2);
  CHECK(run.work < samples * most);

  job.motion.steps = {move_to(0), move_to(0.5), move_to(0)};
  CHECK_FALSE(short_run(job, short_run_segments).stopped_at);
}

TEST_CASE("checks shorten a long wait, check the moves behind it, and state the time of the program") {
  pipeline::Job job = simple_job();
  job.simulation.segments = 60;
  job.motion.steps = {move_to(0), move_to(0.5), dwell_for(20), move_to(1.5), move_to(0)};
  const QuickFindings shorter = quick_findings(job);
  CHECK_FALSE(shorter.run.stopped_at);
  job.motion.steps[2].dwell = 900;  // as above: a short run of all of it is too much work
  const QuickFindings found = quick_findings(job);
  CHECK_FALSE(found.run.stopped_at);
  CHECK(found.run.work == shorter.run.work);
  REQUIRE(found.checks.size() == shorter.checks.size());
  REQUIRE_FALSE(found.checks.empty());
  for (std::size_t k = 0; k < found.checks.size(); ++k)  // times of 900 s are rounded to 1e-13 s
    CHECK(found.checks[k].value == Approx(shorter.checks[k].value).epsilon(1e-6));

  job.motion.longest_wait = settled_after;
  const RobotPath path(job);
  pipeline::Job whole = job;
  whole.motion.longest_wait = 1e9;
  CHECK(path.duration() < path.program_duration() - 889.9);
  CHECK(path.moment(path.duration()) == RobotPath(whole).moment(RobotPath(whole).duration()));
}

TEST_CASE("a changed routing is checked only until a limit decides") {
  const pipeline::Job job = swinging_job(1.2);
  const auto smallest = [](const ShortRun& run) {
    for (const Check& check : run.checks)
      if (check.name == "smallest bend radius") return check.value;
    return 0.0;
  };
  const ShortRun whole = short_run(job, short_run_segments);
  CHECK_FALSE(whole.stopped_at);
  const double radius = smallest(whole);
  REQUIRE(radius > 0);
  const ShortRun ended = short_run(job, short_run_segments, 1.01 * radius);
  REQUIRE(ended.stopped_at);
  CHECK(ended.work < whole.work);
  CHECK(smallest(ended) < 1.01 * radius);
  const ShortRun kept = short_run(job, short_run_segments, 0.99 * radius);
  CHECK_FALSE(kept.stopped_at);
  CHECK(smallest(kept) == radius);

  int asked = 0;
  const auto at = [&](int last) {
    asked = 0;
    return findings_unless(
        job, [&](const QuickFindings&) { return ++asked == last; }, 0, 0);
  };
  CHECK(at(1).run.work == 0);  // only the slack is evaluated
  const QuickFindings all = at(-1), found = quick_findings(job);
  REQUIRE(all.checks.size() == found.checks.size());
  for (std::size_t k = 0; k < all.checks.size(); ++k) {
    CHECK(all.checks[k].name == found.checks[k].name);
    CHECK(all.checks[k].value == found.checks[k].value);
    CHECK(all.checks[k].warning == found.checks[k].warning);
  }
}

TEST_CASE("a program of one pose is checked at rest in this pose") {
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0)};
  std::vector<std::string> names;
  for (const Check& check : quick_findings(job).checks) names.push_back(check.name);
  CHECK(std::find(names.begin(), names.end(), "smallest bend radius at rest") != names.end());
}

TEST_CASE("cures: a length that is too short or too long is cured by the length that is named") {
  for (const double length : {0.955, 1.7}) {
    pipeline::Job job = swinging_job(length);
    const std::string words = words_of(job, pipeline::WarningKind::slack);
    job.dresspacks[0].routing.free_length = value_of(words, "routing.free_length_m");
    CHECK(words_of(job, pipeline::WarningKind::slack) == "");
  }
}

TEST_CASE(
    "cures: a length in millimetres is cured by the same number in metres, or by the lengths that suit the clamps") {
  pipeline::Job job = swinging_job(1200);
  CHECK_THAT(of_length_and_bend(job),
             Catch::Contains("Remedy: routing.free_length_m: 1.200") && !Catch::Contains("other clamps"));
  job.dresspacks[0].routing.free_length = 830;  // 0.83 m would be too short
  CHECK_THAT(of_length_and_bend(job), Catch::Contains(" or less, 0.") && !Catch::Contains("other clamps"));
}

TEST_CASE("cures: a limit that is named for a bend at rest is also kept in motion") {
  pipeline::Job job = swinging_job(0.97);
  job.robot.joints[0].speed = job.robot.joints[0].acceleration = 60;  // the hose swings outward
  job.dresspacks[0].dresspack.least_bend_radius = 30;
  const std::string words = of_length_and_bend(job);
  REQUIRE_THAT(words, Catch::Contains("at rest"));
  job.dresspacks[0].dresspack.least_bend_radius = value_of(words, "dresspack.least_bend_radius_mm") / 1000;
  CHECK(of_length_and_bend(job) == "");
}

TEST_CASE("cures: a twist to one side is cured by a pre-twist, one to both sides by a longer hose") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  job.dresspacks[0].dresspack.most_twist = 1.4;  // [rad/m]; the motion twists the sagging hose of 1 m by 0 .. 1.8 rad
  std::string words = words_of(job, pipeline::WarningKind::twist);
  CHECK_THAT(words, Catch::Contains("-hand), ") && Catch::Contains("m from the base clamp") &&
                        Catch::Contains("step 2 'turn'"));
  job.dresspacks[0].routing.pre_twist = value_of(words, "routing.pre_twist_deg") * degree;
  CHECK(words_of(job, pipeline::WarningKind::twist) == "");

  job.dresspacks[0].dresspack.most_twist = 0.8;  // less than the 0.9 rad in either direction
  words = words_of(job, pipeline::WarningKind::twist);
  job.dresspacks[0].routing.free_length = value_of(words, "routing.free_length_m");
  CHECK(job.dresspacks[0].routing.free_length > 1);
  CHECK(words_of(job, pipeline::WarningKind::twist) == "");
}

TEST_CASE("cures: the checks at rest and a run find the same twist, whole turns included, and the same remedy") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  job.dresspacks[0].routing.mounting_pose = {-7};  // more than one turn from the program
  job.dresspacks[0].dresspack.most_twist = 5;      // the program twists it by 7 .. 9 rad
  const auto of_twist = [](const std::vector<pipeline::Warning>& warnings, const char* name) {
    for (const pipeline::Warning& warning : warnings)
      if (warning.words.find(name) != std::string::npos) return warning.words;
    return std::string();
  };
  const std::string rest = of_twist(quick_warnings(job).warnings, "largest twist at rest: "),
                    run = words_of(job, pipeline::WarningKind::twist);
  INFO(rest << run);
  const auto number = [](const std::string& words, const std::string& key) {
    REQUIRE(words.find(key) != std::string::npos);
    return std::stod(words.substr(words.find(key) + key.size()));
  };
  // In deg/m. A run's largest twist is that of one link and oscillates; the sag reduces it by a few degrees.
  CHECK(number(rest, "at rest: ") == Approx(number(run, "largest twist: ")).epsilon(0.1));
  CHECK(number(rest, "turn it by ") == Approx(number(run, "turn it by ")).epsilon(0.05));
  CHECK(value_of(rest, "routing.pre_twist_deg") == Approx(value_of(run, "routing.pre_twist_deg")).epsilon(0.05));
  job.dresspacks[0].routing.pre_twist = value_of(rest, "routing.pre_twist_deg") * degree;
  CHECK(of_twist(quick_warnings(job).warnings, "largest twist at rest: ") == "");
}

TEST_CASE("cures: a bend that is there at rest is cured by a length or by directions that are tried at rest") {
  pipeline::Job job = swinging_job(1.3);
  job.motion.acceleration_percent = 2;  // nearly at rest
  job.robot.joints[0].acceleration = 0.5;
  job.dresspacks[0].routing.tool_clamp->direction = {0, 1, 0};
  job.dresspacks[0].dresspack.least_bend_radius = 0.22;  // at rest the radius is 0.196
  const std::string words = words_of(job, pipeline::WarningKind::bend_radius);
  INFO(words);
  CHECK_THAT(words, Catch::Contains("smallest bend radius: ") && Catch::Contains("already at rest") &&
                        Catch::Contains("m from the base clamp") && Catch::Contains("(bend radius at rest "));
  job.dresspacks[0].routing.free_length = value_of(words, "routing.free_length_m");
  for (const char* clamp : {"base_clamp", "tool_clamp"}) {
    const std::string key = std::string("routing.") + clamp + ".direction: [";
    const std::size_t at = words.find(key);
    if (at == std::string::npos) continue;
    pipeline::Vector3d direction;
    REQUIRE(std::sscanf(words.c_str() + at + key.size(), "%lf, %lf, %lf", &direction[0], &direction[1],
                        &direction[2]) == 3);
    auto& of = std::string(clamp) == "base_clamp" ? job.dresspacks[0].routing.base_clamp
                                                  : job.dresspacks[0].routing.tool_clamp;
    of->direction = direction;
  }
  CHECK(words_of(job, pipeline::WarningKind::bend_radius) == "");
}

TEST_CASE("cures: a limit that no length and no direction keeps says so, with the radius that the motion needs") {
  pipeline::Job job = swinging_job(1.0);
  job.dresspacks[0].dresspack.least_bend_radius = 30;  // of nearly straight hoses
  const std::string words = words_of(job, pipeline::WarningKind::bend_radius);
  CHECK_THAT(
      words,
      Catch::Contains("with these two clamps no length and no direction that was tried") &&
          Catch::Contains(
              "Remedy: other clamps (`dresslife route` searches for them, longer than `dresslife new`; where `dresslife route` proposed these clamps, it finds no others)") &&
          Catch::Contains(" mm at rest, too little for a short run; required: 30000.0 mm") &&
          Catch::Contains("(`dresslife check` also moves them by up to 100 mm)"));
  CHECK_THAT(words, !Catch::Contains("temperature"));
  job.cell.temperature = 60;
  CHECK_THAT(
      words_of(job, pipeline::WarningKind::bend_radius),
      Catch::Contains(
          "; check cell.temperature_C: 60 (a polymer's stiffness from the construction is 0.52 times that at 23 C)"));
  job.cell.temperature = pipeline::Cell::usual_temperature;
  job.dresspacks[0].dresspack.least_bend_radius = value_of(words, "dresspack.least_bend_radius_mm") / 1000;
  CHECK(words_of(job, pipeline::WarningKind::bend_radius) == "");
}

TEST_CASE("cures: a limit that a length keeps at rest and none keeps in a run is given up with both radii") {
  int both = 0;
  for (const double limit : {0.26, 0.28}) {
    pipeline::Job job = swinging_job(0.97);
    job.robot.joints[0].speed = job.robot.joints[0].acceleration = 60;  // the hose swings outward
    job.dresspacks[0].dresspack.least_bend_radius = limit;
    const std::string words = words_of(job, pipeline::WarningKind::bend_radius);
    CAPTURE(limit, words);
    const std::size_t at = words.find(" m, bend radius ");
    if (at == std::string::npos) continue;
    CHECK_THAT(
        words,
        Catch::Contains(
            "Remedy: other clamps (`dresslife route` searches for them, longer than `dresslife new`; where `dresslife route` proposed these clamps, it finds no others): with these two clamps no length and no direction"));
    const double rest = std::stod(words.substr(at + 16));
    const std::size_t run = words.find(" mm at rest, ");
    REQUIRE(run != std::string::npos);
    if (words.find(" mm in a short run; required: ") == std::string::npos) continue;
    CHECK(std::stod(words.substr(run + 13)) < 1e3 * limit);
    both += rest > 1e3 * limit;
  }
  CHECK(both > 0);
}

TEST_CASE("cures: where a length keeps the limits, the length alone is named, once") {
  pipeline::Job job = swinging_job(0.955);  // too short
  job.dresspacks[0].dresspack.least_bend_radius = 0.1;
  std::string remedies;
  for (const pipeline::Warning& warning : quick_warnings(job).warnings) {
    INFO(warning.words);
    const std::size_t at = warning.words.find("Remedy: ");
    REQUIRE(at != std::string::npos);
    CHECK_THAT(warning.words,
               Catch::Contains("Remedy: routing.free_length_m: ") && !Catch::Contains("no length and no direction"));
    if (remedies.empty()) remedies = warning.words.substr(at);
    CHECK(warning.words.substr(at) == remedies);
  }
  CHECK_FALSE(remedies.empty());
  // With a limit between the radius of the best length and that with a margin, the best length keeps it and is named.
  job.dresspacks[0].routing.free_length = value_of(remedies, "routing.free_length_m");
  double radius = 0;
  for (const Check& check : quick_findings(job).checks)
    if (check.name == "smallest bend radius") radius = check.value;
  REQUIRE(radius > 0);
  job.dresspacks[0].dresspack.least_bend_radius = radius / 1.01;
  job.dresspacks[0].routing.free_length = 0.955;
  const std::string words = of_length_and_bend(job);
  INFO(words);
  CHECK(value_of(words, "routing.free_length_m") > 0.96);
  CHECK_THAT(words, !Catch::Contains("no length and no direction"));
}

TEST_CASE("cures: ten diameters count where no bend radius is given, and the warning says which key would say so") {
  pipeline::Job job = swinging_job(1.3);
  job.dresspacks[0].routing.tool_clamp->direction = {0, 1, 0};
  CHECK_THAT(
      words_of(job, pipeline::WarningKind::bend_radius),
      Catch::Contains(
          "dresspack.least_bend_radius_mm is not given, so that ten diameters of the hose (40 mm) count, because"));
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.components.assign(1, {});  // a core without a hose
  CHECK(pipeline::bend_rule(dresspack) == "ten diameters of the cable (40 mm) count");
  dresspack.hose_corrugation = pipeline::Corrugation{};
  dresspack.components.assign(2, {});
  dresspack.components[0].radius = 0.002, dresspack.components[1].radius = 0.006,
  dresspack.components[1].helix_radius = 0.01;
  dresspack.components[1].name = "power";
  CHECK(pipeline::least_bend_radius(dresspack) == Approx(0.13));
  CHECK_THAT(pipeline::bend_rule(dresspack),
             Catch::Contains("ten diameters of 'power' (12 mm) in the hose, 10 mm off its axis, count"));
  dresspack.diameter = 0.05;
  CHECK(pipeline::least_bend_radius(dresspack) == Approx(0.15));
  CHECK_THAT(pipeline::bend_rule(dresspack), Catch::Contains("3 diameters of the hose (50 mm) count"));
}

TEST_CASE("cures: a bend beside a clamp names its bend relief, unless it has one or the bend is far from it") {
  pipeline::Job job = swinging_job(1.3);
  job.dresspacks[0].routing.base_clamp->direction = {0, -1, 0};  // away from the other clamp
  job.dresspacks[0].dresspack.least_bend_radius = 0.25;
  const std::string words = words_of(job, pipeline::WarningKind::bend_radius);
  CHECK_THAT(words, Catch::Contains("dresslife improve tries: routing.base_clamp.bend_relief: {length_mm: 120, ") &&
                        Catch::Contains(" and simulation.segments: 44 (with 20 it tries four segments, 260 mm)"));
  CHECK(pipeline::first_relief(0.04, 2, 1.3 / 20).length == Approx(0.26));  // the relief of improve
  job.dresspacks[0].routing.base_clamp->bend_relief = {0.1, 0};             // without stiffness: an identical run
  CHECK_THAT(words_of(job, pipeline::WarningKind::bend_radius),
             Catch::Contains("Remedy") && !Catch::Contains("bend_relief"));
}

TEST_CASE("cures: a bend that its clamp's link causes within a segment is warned of, with the number that shows it") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  CHECK(words_of(job, pipeline::WarningKind::mesh) == "");
  job.robot.links[0].capsules = {{{0.06, -0.2, 0.892}, {0.06, 0.2, 0.892}, 0.1}};  // lifts the hose by 12 mm
  const std::string words = words_of(job, pipeline::WarningKind::mesh);
  CHECK_THAT(words, Catch::Contains("the segments are 50 mm long, and the smallest bend radius, ") &&
                        Catch::Contains("simulation.segments: 50;"));
  job.simulation.segments = 50;
  CHECK(words_of(job, pipeline::WarningKind::mesh) == "");
}

TEST_CASE(
    "cures: segments longer than the decay of a bend beside a pulled clamp are warned of, with the number that cures it") {
  pipeline::Job job = swinging_job(1.3);
  CHECK(words_of(job, pipeline::WarningKind::mesh) == "");
  job.simulation.segments = 16;
  job.dresspacks[0].dresspack.bending_stiffness = 0.02;
  const std::string words = words_of(job, pipeline::WarningKind::mesh);
  CHECK_THAT(words, Catch::Contains("simulation.segments is 16: a segment is 81 mm long"));
  job.simulation.segments = static_cast<int>(value_of(words, "simulation.segments"));
  CHECK(words_of(job, pipeline::WarningKind::mesh) == "");
}

TEST_CASE("cures: a hose that is pulled tight is cured by its length") {
  pipeline::Job job = swinging_job(0.952);
  job.dresspacks[0].dresspack.most_tension = 20;
  const std::string words = words_of(job, pipeline::WarningKind::tension);
  CHECK_THAT(words, Catch::Contains("it is pulled tight"));
  CHECK(value_of(words, "routing.free_length_m") > 0.96);
}

/// Returns the number after a key of a remedy; std::nullopt: the remedy does not contain this key.
std::optional<double> number_behind(const std::string& words, const std::string& key) {
  const std::size_t at = words.find(key + ": ");
  return at == std::string::npos ? std::nullopt : std::optional(std::stod(words.substr(at + key.size() + 2)));
}

/// Returns the job with the keys of the remedy in `words` applied.
pipeline::Job remedied(pipeline::Job job, const std::string& words) {
  pipeline::Routing& routing = job.dresspacks[0].routing;
  const std::string remedy = words.substr(words.find("Remedy: "));
  if (const auto value = number_behind(remedy, "routing.free_length_m")) routing.free_length = *value;
  if (const auto value = number_behind(remedy, "routing.pre_twist_deg")) routing.pre_twist = *value * degree;
  if (const auto value = number_behind(remedy, "motion.acceleration_percent")) job.motion.acceleration_percent = *value;
  for (const char* clamp : {"base", "tool"}) {
    const std::string key = std::string("routing.") + clamp + "_clamp.direction: [";
    const std::size_t at = remedy.find(key);
    if (at == std::string::npos) continue;
    pipeline::Vector3d direction;
    REQUIRE(std::sscanf(remedy.c_str() + at + key.size(), "%lf, %lf, %lf", &direction[0], &direction[1],
                        &direction[2]) == 3);
    (std::string(clamp) == "base" ? routing.base_clamp : routing.tool_clamp)->direction = direction;
  }
  return job;
}

/// Returns the largest tension in the program [N].
double tension_of(const pipeline::Job& job) {
  for (const Check& check : quick_findings(job).checks)
    if (check.name == "largest tension") return check.value;
  return 0;
}

TEST_CASE("cures: a hose that its weight pulls is cured by its length, or by a slower program whose price is stated") {
  pipeline::Job job = swinging_job(1.42);
  job.dresspacks[0].dresspack.bending_stiffness = 0.02;  // it hangs; a stiffer hose would carry itself on its clamps
  job.dresspacks[0].dresspack.least_bend_radius = 0.005;
  const double tension = tension_of(job);
  REQUIRE(tension > 0);
  // A catenary pulls its ends least if it is 1.26 times as long as their distance. This one is longer.
  job.dresspacks[0].dresspack.most_tension = 0.95 * tension;
  const std::string words = words_of(job, pipeline::WarningKind::tension);
  INFO(words);
  CHECK_THAT(words, Catch::Contains("its weight and the acceleration") && !Catch::Contains("acceleration_percent"));
  CHECK(value_of(words, "routing.free_length_m") < 1.42);
  CHECK(words_of(remedied(job, words), pipeline::WarningKind::tension) == "");
  // The checks before the run warn of it, too.
  std::string before;
  for (const pipeline::Warning& warning : quick_warnings(job).warnings)
    if (warning.kind == pipeline::WarningKind::tension) before += warning.words;
  CHECK(value_of(before, "routing.free_length_m") == value_of(words, "routing.free_length_m"));
  // At the length with the least tension only a slower program is left. It has a price, which the warning states.
  std::string slow = words;
  for (int k = 0; k < 8 && slow.find("routing.free_length_m") != std::string::npos; ++k) {
    job = remedied(job, slow);
    job.dresspacks[0].dresspack.most_tension = 0.85 * tension_of(job);
    slow = words_of(job, pipeline::WarningKind::tension);
  }
  INFO(slow);
  const pipeline::Job slower = remedied(job, slow);
  const double now = Simulation(job).path().duration(), then = Simulation(slower).path().duration();
  CHECK(then > now);
  CHECK_THAT(slow, Catch::Contains(fmt::format("a repeat takes {:.1f} s instead of {:.1f} s", then, now)));
  CHECK(words_of(slower, pipeline::WarningKind::tension) == "");
  // No routing and no speed carries the weight with 0.5 N.
  job.dresspacks[0].dresspack.most_tension = 0.5;
  const std::string heavy = words_of(job, pipeline::WarningKind::tension);
  CHECK_THAT(heavy, Catch::Contains("`dresslife route`") && !Catch::Contains("acceleration_percent: "));
}

/// Returns a job with a drum about the axis, which turns by 160 deg. The hose beside the drum winds around it.
pipeline::Job winding_job(double free_length) {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  job.simulation.floor = false;
  job.robot.links[1].capsules = {{{0.1, 0, 0}, {0.8, 0, 0}, 0.2}};
  job.dresspacks[0].routing.base_clamp->position = {0, 0.25, 1};
  job.dresspacks[0].routing.tool_clamp->position = {0.9, 0.25, 0};
  job.motion.steps = {move_to(0, "start"), move_to(2.8, "wind"), move_to(0, "back")};
  job.dresspacks[0].dresspack.least_bend_radius = 0.15;
  job.dresspacks[0].routing.free_length = free_length;
  return job;
}

TEST_CASE("cures: remedies that are applied end within three rounds without a warning, or at other clamps") {
  std::vector<std::pair<std::string, pipeline::Job>> jobs;
  for (const double length : {0.955, 1.0, 1.3, 1.7}) jobs.emplace_back("swinging", swinging_job(length));
  for (const double length : {1.06, 1.1, 1.25, 1.6}) jobs.emplace_back("winding", winding_job(length));
  jobs.emplace_back("across", swinging_job(1.3));
  jobs.back().second.dresspacks[0].routing.tool_clamp->direction = {0, 1, 0};
  jobs.emplace_back("wound and bent", winding_job(1.25));
  jobs.back().second.dresspacks[0].dresspack.least_bend_radius = 0.35;
  jobs.emplace_back("wound and never straight enough", winding_job(1.25));
  jobs.back().second.dresspacks[0].dresspack.least_bend_radius = 2;
  int cured = 0, given_up = 0, taut = 0;
  for (auto& [name, job] : jobs) {
    CAPTURE(name, job.dresspacks[0].routing.free_length);
    std::string words = of_length_and_bend(job), all = words;
    const bool warned = !words.empty();
    taut += words.find("is pulled tight") != std::string::npos;
    const auto gives_up = [&] {
      return words.find("with these two clamps no length and no direction") != std::string::npos &&
             words.find("`dresslife route`") != std::string::npos;
    };
    for (int round = 0; round < 3 && !words.empty() && !gives_up(); ++round) {
      job = remedied(job, words);
      words = of_length_and_bend(job);
      all += "\n" + words;
    }
    INFO(all);
    CHECK((words.empty() || gives_up()));
    cured += warned && words.empty();
    given_up += gives_up();
  }
  CHECK(cured >= 3);
  CHECK(given_up >= 1);
  CHECK(taut >= 1);
}

TEST_CASE("cures: a job that the simulation refuses as taut runs with the length that the refusal names") {
  pipeline::Job job = winding_job(1.06);  // 1.03 m from clamp to clamp, 1.15 m around the drum
  const auto refusal = [&]() -> std::optional<RoutingRefusal> {
    try {
      Simulation(job).run({[](const Sample&) {}});
    } catch (const RoutingRefusal& refused) {
      return refused;
    }
    return {};
  };
  const auto refused = refusal();
  REQUIRE(refused);
  CHECK_THAT(refused->problem, Catch::Contains("is pulled tight"));
  const std::string remedy = refusal_remedy(job, *refused);
  INFO(remedy);
  job = remedied(job, "Remedy: " + remedy);
  CHECK(job.dresspacks[0].routing.free_length > 1.1);
  CHECK_FALSE(refusal());
}

TEST_CASE("cures: a dresspack with both clamps on one link is told, by the checks and by a run") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  job.dresspacks[0].routing.tool_clamp = job.dresspacks[0].routing.base_clamp;
  job.dresspacks[0].routing.tool_clamp->position = {0.9, 0, 1};
  CHECK_THAT(words_of(job, pipeline::WarningKind::motion), Catch::Contains("both clamps of dresspack are on bench"));
  std::string words;
  for (const pipeline::Warning& warning : quick_warnings(job).warnings) words += warning.words;
  CHECK_THAT(words, Catch::Contains("both clamps of dresspack are on bench"));
  CHECK(words_of(simple_job(), pipeline::WarningKind::motion) == "");
}

}  // namespace
}  // namespace dresslife::sim
