#include "pipeline/resolve/plausible_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

#include "pipeline/base/constants.h"
#include "pipeline/resolve/radians.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

MotionStep move_to(std::vector<double> degrees) {
  MotionStep step;
  for (const double angle : degrees) step.joints.push_back(angle * degree);
  return step;
}

std::vector<Warning> plausibility_warnings(const Job& job) {
  return joined(plausibility_of_motion(job), plausibility_of_lives(job));
}

std::size_t doubts(std::vector<MotionStep> steps) {
  Motion motion;
  motion.steps = std::move(steps);
  return plausibility_of_steps(motion).size();
}

}  // namespace

TEST_CASE("plausible jobs: a warning at the path of a key is located in the user's file, others keep their places") {
  const Node document = parse_yaml("motion:\n  tools:\n    - {name: gun}\nstrain: {gate: 2}\n", "mine.yaml");
  const auto place = [&](const std::string& where, const std::string& words) {
    return located({{WarningKind::motion, where, words}}, document).front().where;
  };
  CHECK(place("motion.tools.1", "the quaternion of it") == "mine.yaml:3:7");
  CHECK(place("motion.tools.2", "strain.gate is 2") == "motion.tools.2");  // in another file
  CHECK(place("welding.mod:12", "strain.gate is 2") == "welding.mod:12");
  CHECK(place("", "strain.gate is 2") == "mine.yaml:4:16");
}

TEST_CASE("plausible jobs: a hose with more pressure than its maker allows at the cell's temperature is warned of") {
  const auto warnings_at = [](double bar, double temperature) {
    Component hose;
    hose.name = "water hose";
    hose.plain = PlainPart{};
    hose.plain->kind = PlainKind::hose;
    hose.plain->pressure = 8e5;
    if (bar > 0) hose.plain->most_pressure = 1e5 * bar;
    Job job;
    job.motion.rig.emplace();
    job.dresspacks.resize(1);
    job.dresspacks[0].dresspack.core_components.push_back(hose);
    job.cell.temperature = temperature;
    return plausibility_of_lives(job);
  };
  CHECK(warnings_at(0, 20).empty());  // no limit
  CHECK(warnings_at(8, 20).empty());
  CHECK(warnings_at(8, 10).empty());
  CHECK(warnings_at(8, 23).empty());  // makers state limits for 20 or 23 C
  CHECK(warnings_at(8, 24).size() == 1);
  REQUIRE(warnings_at(7.9, 20).size() == 1);
  CHECK_THAT(warnings_at(7.9, 10)[0].words,
             Catch::StartsWith("the pressure_bar of water hose is 8 (limit 7.9 at 10 C by most_pressure_bar)"));
  CHECK(warnings_at(11.36, 40).empty());  // SMC, polyamide 12: 0.70 of that at 20 C
  REQUIRE(warnings_at(11.34, 40).size() == 1);
  CHECK_THAT(warnings_at(10, 40)[0].words,
             Catch::Contains("(limit 7.05 at 40 C by most_pressure_bar, with 1.75 % less per kelvin"));
}

TEST_CASE("plausible jobs: the doubts of a calibration and ratings without an effect are warned of") {
  Job job;
  CHECK(plausibility_of_lives(job).empty());
  job.uncertainty.ratings_left_out = "fatigue.stress: cyclic (this job has elastic)";
  REQUIRE(plausibility_of_lives(job).size() == 1);
  CHECK_THAT(plausibility_of_lives(job)[0].words,
             Catch::Contains("because they were learned with fatigue.stress: cyclic (this job has elastic)"));
  job.uncertainty.ratings_left_out.clear();
  LearnedParameter& strength = job.calibration.emplace().parameters.emplace_back();
  strength.name = "strength";
  CHECK(plausibility_of_lives(job).empty());
  job.uncertainty.spread[index_of(Uncertain::strength)] = 1;
  REQUIRE(plausibility_of_lives(job).size() == 1);
  CHECK_THAT(plausibility_of_lives(job)[0].words, Catch::Contains("uncertainty.strength: 1 has no effect"));
  strength.prior = 0;  // the jobs of its observations stated the same
  CHECK(plausibility_of_lives(job).empty());
  job.uncertainty = {};
  job.calibration.emplace().doubts = "'flex' is far from its prediction\n'cell': its job exceeds limits";
  REQUIRE(plausibility_of_lives(job).size() == 2);
  job.calibration->contradiction = "'cell': the records contradict the prediction. Remedy: none";
  const std::vector<Warning> warnings = plausibility_of_lives(job);
  REQUIRE(warnings.size() == 3);
  CHECK(warnings[0].words == "calibration: 'cell': the records contradict the prediction. Remedy: none");
  CHECK(warnings[1].words == "calibration: 'flex' is far from its prediction");
  CHECK(warnings[2].words == "calibration: 'cell': its job exceeds limits");
}

TEST_CASE(
    "plausible steps: a place less than a millimetre beside the one before is an offset in metres, but not in a dense path") {
  const auto doubts_of = [](const std::vector<double>& heights) {  // [mm]
    Motion motion;
    for (const double height : heights) {
      MotionStep step;
      step.position = {0.5, 0.1, 1e-3 * height}, step.quaternion = {1, 0, 0, 0}, step.tool_speed = 0.5;
      motion.steps.push_back(step);
    }
    std::string words;
    for (const Warning& warning : plausibility_of_steps(motion)) words += warning.words;
    return words;
  };
  CHECK(doubts_of({0, 200, 400}).empty());
  CHECK(doubts_of({0, 200, 200.01, 400}).empty());  // within a robot's repeatability
  CHECK_THAT(doubts_of({0, 200, 200.1, 400}),
             Catch::Contains("lies 0.1 mm from the one before") && Catch::Contains("100 mm in the program"));
  CHECK(doubts_of({0, 0.5, 1, 1.5, 2}).empty());
}

TEST_CASE("plausible steps: a fast speed is doubted in the unit of its program") {
  const auto doubts_of = [](const char* file, double speed) {
    Motion motion;
    MotionStep step;
    step.position = {0.5, 0.1, 0.2}, step.quaternion = {1, 0, 0, 0}, step.tool_speed = speed, step.where = {file, 3, 1};
    motion.steps.push_back(step);
    std::string words;
    for (const Warning& warning : plausibility_of_steps(motion)) words += warning.words;
    return words;
  };
  CHECK_THAT(doubts_of("weld.ls", 500), Catch::Contains("is 500000 mm/s (limit 10000 mm/s or less)") &&
                                            Catch::Contains("Remedy: 10000 mm/s or less") && !Catch::Contains(" m/s"));
  CHECK_THAT(doubts_of("weld.ls", 20), Catch::Contains("2000 mm/s if the decimal point slipped"));
  CHECK_THAT(doubts_of("weld.script", 250),
             Catch::Contains("is 250 m/s") && Catch::Contains("0.25 m/s if that was mm/s"));
}

TEST_CASE("plausible job: a speed for moves that all have their own has no effect, and the override is named") {
  Motion motion;
  motion.steps.resize(2);
  motion.steps[0].joints = {0}, motion.steps[1].joints = {1};
  motion.speed_percent = 50;
  CHECK(plausibility_of_steps(motion).empty());
  for (MotionStep& step : motion.steps) step.tool_speed = 0.5;
  REQUIRE(plausibility_of_steps(motion).size() == 1);
  CHECK(plausibility_of_steps(motion)[0].words.find("motion.override_percent: 50") != std::string::npos);
  motion.speed_percent = 0.5;  // as a share instead of per cent; the override is at least 1 %
  CHECK(plausibility_of_steps(motion)[0].words.find("motion.override_percent: 50") != std::string::npos);
}

TEST_CASE("plausible job: the quaternion of a tool in the order x, y, z, w") {
  const auto words = [](std::vector<double> quaternion, int line) {
    Job job;
    MotionFrame frame;
    frame.name = "gun", frame.quaternion = std::move(quaternion), frame.quaternion_where = {"job.yaml", line};
    job.motion.tools = job.motion.work_objects = {frame};
    std::vector<std::string> lines;
    for (const Warning& warning : plausibility_of_motion(job)) lines.push_back(warning.line());
    return lines;
  };
  const auto whole = words({0, 0, 0, 1}, 7);
  REQUIRE(whole.size() == 2);
  CHECK(
      whole[0].find(
          "the quaternion of motion.tools[1] ('gun') is [0, 0, 0, 1] (order: w, x, y, z), a turn by 180 deg about z") !=
      std::string::npos);
  CHECK_THAT(whole[0],
             Catch::Contains("job.yaml:7") &&
                 Catch::Contains("Likely cause: the order x, y, z, w. Remedy: [1, 0, 0, 0] if no turn is meant"));
  CHECK_THAT(whole[1], Catch::Contains("motion.work_objects[1]"));
  const auto nearly = words({0, 0.1, 0, 0.995}, 7);
  REQUIRE(nearly.size() == 2);
  CHECK_THAT(nearly[0], Catch::Contains("[0.995, 0, 0.1, 0] if that was x, y, z, w"));
  CHECK(words({0.2, 0.1, 0, 0.97468}, 7).empty());
  CHECK(words({1, 0, 0, 0}, 7).empty());
  CHECK(words({0, 0, 0, 1}, 0).empty());  // of a program
}

TEST_CASE("plausible steps: angles that are all below a turn in radians and yet move") {
  CHECK(doubts({}) == 0);
  CHECK(doubts({move_to({1, 2}), move_to({1.2, 2})}) == 1);
  CHECK(doubts({move_to({100, 2}), move_to({100.05, 2})}) == doubts({move_to({1, 2}), move_to({1.05, 2})}));  // at rest
  CHECK(doubts({move_to({1, -6.2}), move_to({3, 2})}) == 1);
  CHECK(doubts({move_to({1, -6.3}), move_to({3, 2})}) == 0);
  CHECK(doubts({move_to({1, 2}), move_to({6.3, 2})}) == 0);
  MotionStep block;
  block.repeat = 2, block.steps = {move_to({90, 0})};
  CHECK(doubts({move_to({1, 2}), move_to({3, 2}), block}) == 0);  // a block's contents count as well
}

TEST_CASE("plausible steps: speeds that are shares or in mm/s, dwells in ms, told once with their number") {
  const auto with = [](std::optional<double> percent, std::optional<double> tool, double dwell) {
    MotionStep step = move_to({90, 0});
    step.speed_percent = percent, step.tool_speed = tool, step.dwell = dwell;
    return step;
  };
  CHECK(doubts({with(1, 10, 100)}) == 0);
  CHECK(doubts({with(0.99, {}, 0)}) == 1);
  CHECK(doubts({with({}, 10.1, 0)}) == 1);
  CHECK(doubts({with({}, {}, 101)}) == 1);
  CHECK(doubts({with(0.5, 500, 2000)}) == 3);
  Motion motion;
  motion.steps = {move_to({0, 0}), with(0.5, {}, 0), with(0.6, {}, 0), with(0.7, {}, 0)};
  const std::vector<Warning> warnings = plausibility_of_steps(motion);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].line(), Catch::Contains("speed_percent is 0.5") && Catch::Contains("(and 2 more)") &&
                                     Catch::Contains("speed_percent: 50"));
}

TEST_CASE("plausible steps: a recording without its column of times") {
  const auto recording = [](int rows, double step, bool timed) {
    std::vector<MotionStep> steps;
    for (int k = 0; k < rows; ++k) {
      steps.push_back(move_to({20 + step * k, 0}));
      if (timed && k > 0) steps.back().duration = 0.1;
    }
    return steps;
  };
  CHECK(doubts(recording(30, 2.9, false)) == 1);
  CHECK(doubts(recording(29, 2.9, false)) == 0);
  CHECK(doubts(recording(30, 3.1, false)) == 0);
  CHECK(doubts(recording(30, 2.9, true)) == 0);
}

TEST_CASE("plausible jobs: angles in radians, obstacles without contact, repeats of a life") {
  const auto lines = [](const std::string& text) {
    std::vector<std::string> words;
    for (const Warning& warning : radians_in(parse_yaml(text, "job.yaml"), "routing")) words.push_back(warning.line());
    return words;
  };
  const auto vector = lines("mounting_pose_deg: [0, -1.5708, 0.7854, 0]\n");
  REQUIRE(vector.size() == 1);
  CHECK_THAT(vector[0], Catch::Contains("job.yaml:1:1: ") &&
                            Catch::Contains("routing.mounting_pose_deg: [0, -90, 45, 0] if that was radians"));
  CHECK(lines("a: {roll_deg: 1.57}\nb: [{phase_deg: 3.14159}, {phase_deg: 0.5236}]\n").size() == 3);
  CHECK(
      lines(
          "mounting_pose_deg: [0, -90, 1.5708]\nroll_deg: 0\nphase_deg: 1.6\nlay_angle_deg: 0.52\npre_twist_deg: 3.14\n")
          .empty());
  Job job;
  CHECK(plausibility_warnings(job).empty());
  job.simulation.contact = false;
  CHECK(plausibility_warnings(job).empty());
  job.cell.boxes.emplace_back();
  CHECK(plausibility_warnings(job).size() == 1);
  job.simulation.contact = true;
  job.simulation.most_repeats = 100;
  CHECK(plausibility_warnings(job).empty());
  job.simulation.most_repeats = 101;
  CHECK(plausibility_warnings(job).size() == 1);
  job.simulation.most_repeats = 100, job.dresspacks[0].routing.free_length = 1800;
  REQUIRE(plausibility_warnings(job).size() == 1);
  CHECK_THAT(plausibility_warnings(job)[0].words,
             Catch::Contains("routing.free_length_m: 1.8 if that was millimetres"));
  job.dresspacks[0].routing.free_length = 1.8;
  for (const auto& [twist, doubts] :
       {std::pair{1.57, 1}, {-0.785, 1}, {0.5, 1}, {-4.91, 0}, {2.7, 0}, {45.0, 0}, {3601.0, 1}}) {
    job.dresspacks[0].routing.pre_twist =
        twist * degree;  // eighths of a turn in rad, halves of a turn, or a search's angles
    CAPTURE(twist);
    CHECK(plausibility_warnings(job).size() == std::size_t(doubts));
  }
}

TEST_CASE("plausible jobs: the base clamp is not on a link beyond that of the tool clamp") {
  const auto words_of = [](const std::string& base, const std::string& tool) {
    Job job;
    for (const char* const name : {"base_link", "link_3", "link_6"}) job.robot.links.emplace_back().name = name;
    Routing& routing = job.dresspacks[0].routing;
    routing.free_length = 2;
    routing.base_clamp.emplace().link = base, routing.tool_clamp.emplace().link = tool;
    std::string words;
    for (const Warning& warning : plausibility_of_motion(job))
      if (warning.words.find("nearer to the robot's base") != std::string::npos) words += warning.words;
    return words;
  };
  CHECK(words_of("link_3", "link_6") == "");
  CHECK(words_of("link_3", "link_3") == "");
  CHECK_THAT(words_of("link_6", "link_3"),
             Catch::Contains("routing.base_clamp is on link_6, and routing.tool_clamp on link_3") &&
                 Catch::Contains("exchange base_clamp and tool_clamp"));
}

TEST_CASE("plausible jobs: a sample rate that misses the swing, a gate that hides cycles") {
  const auto doubts_of = [](double rate, double gate, bool prescribed) {
    Job job;
    job.simulation.sample_rate = rate, job.strain.gate = gate;
    if (prescribed) job.motion.rig.emplace();
    return plausibility_warnings(job).size();
  };
  CHECK(doubts_of(5, 2e-4, false) == 0);
  CHECK(doubts_of(4.9, 2e-4, false) == 1);
  CHECK(doubts_of(4.9, 2e-4, true) == 0);
  CHECK(doubts_of(5, 2.1e-4, true) == 1);
  CHECK(doubts_of(1, 0.1, false) == 2);
}

TEST_CASE(
    "plausible jobs: a remedy with a number keeps the limit that it cures, from the smallest to the largest number") {
  struct Key {
    std::string name;
    double unit;  ///< SI of a number in the key's unit
    std::function<double&(Job&)> value;
    double least, most;
  };
  const std::vector<Key> keys{
      {"strain.gate", 1, [](Job& of) -> double& { return of.strain.gate; }, 1e-6, 0.1},
      {"fatigue.endurance_strain", 1, [](Job& of) -> double& { return of.fatigue.endurance_strain; }, 1e-4, 0.1},
      {"fatigue.failed_wires_percent", 1, [](Job& of) -> double& { return of.fatigue.failed_wires_percent; }, 1e-4,
       100},
      {"inspection.found_percent", 1, [](Job& of) -> double& { return of.inspection.found_percent; }, 1e-4, 100},
      {"inspection.visible_depth_percent", 1, [](Job& of) -> double& { return of.inspection.visible_depth_percent; },
       1e-4, 100},
      {"fatigue.robot_life_hours", 1, [](Job& of) -> double& { return of.fatigue.robot_life_hours; }, 1, 1e7},
      {"fatigue.operating_hours_per_week", 1, [](Job& of) -> double& { return of.fatigue.operating_hours_per_week; },
       0.1, 168},
      {"fatigue.strength_factor", 1, [](Job& of) -> double& { return of.fatigue.strength_factor; }, 0.01, 100},
      {"fatigue.model_factor", 1, [](Job& of) -> double& { return of.fatigue.model_factor; }, 1e-4, 1e4},
      {"strain.slack_factor", 1, [](Job& of) -> double& { return of.strain.factors.slack; }, 1e-3, 1e5},
      {"uncertainty.model", 1, [](Job& of) -> double& { return of.uncertainty.spread[index_of(Uncertain::model)]; }, 1,
       1e5},
      {"motion.spot_time_s", 1, [](Job& of) -> double& { return of.motion.spot_time; }, 1e-3, 1e6},
      {"motion.speed_percent", 1, [](Job& of) -> double& { return of.motion.speed_percent; }, 1e-3, 100},
      {"motion.zone_deg", degree, [](Job& of) -> double& { return of.motion.zone; }, 1e-3, 1e4},
      {"simulation.periodic_tolerance_mm", 1e-3, [](Job& of) -> double& { return of.simulation.periodic_tolerance; },
       1e-3, 1e6},
      {"routing.free_length_m", 1, [](Job& of) -> double& { return of.dresspacks[0].routing.free_length; }, 0.1, 1e6},
      {"routing.longest_bracket_mm", 1e-3, [](Job& of) -> double& { return *of.dresspacks[0].routing.longest_bracket; },
       1e-5, 1e4},
      {"stroke_m", 1, [](Job& of) -> double& { return of.dresspacks[0].routing.retraction->stroke; }, 1e-2, 1e6},
      {"force_N", 1, [](Job& of) -> double& { return of.dresspacks[0].routing.retraction->force; }, 1e-2, 1e9},
      {"spring_N_per_m", 1, [](Job& of) -> double& { return of.dresspacks[0].routing.retraction->spring; }, 1e-2, 1e9},
      {"mass_kg", 1, [](Job& of) -> double& { return of.dresspacks[0].routing.retraction->mass; }, 1e-2, 1e9}};
  Job plain;
  Routing& routing = plain.dresspacks[0].routing;
  routing.free_length = 2, routing.longest_bracket = 0.15;
  routing.retraction.emplace();
  routing.retraction->stroke = 0.5, routing.retraction->force = 50;
  REQUIRE(plausibility_warnings(plain).empty());
  for (const Key& key : keys) {
    int cured = 0;
    for (double number = key.least; number <= key.most * 1.0001; number *= 1.7) {
      Job job = plain;
      key.value(job) = number * key.unit;
      const std::vector<Warning> doubts = plausibility_warnings(job);
      if (doubts.empty()) continue;
      REQUIRE(doubts.size() == 1);
      const std::string words = doubts[0].words, remedy = words.substr(words.find("Remedy: ") + 8);
      CAPTURE(words);
      double proposed = 0;
      if (!remedy.starts_with(key.name + ": ") ||
          std::sscanf(remedy.c_str() + key.name.size() + 2, "%lf", &proposed) != 1)
        continue;  // "no key", or a data sheet
      key.value(job) = proposed * key.unit;
      const std::vector<Warning> left = plausibility_warnings(job);
      CHECK((left.empty() ? "" : left[0].words) == "");
      ++cured;
    }
    CAPTURE(key.name);
    CHECK(cured > 0);
  }
}

TEST_CASE("plausible steps: a remedy with a number keeps the limit that it cures") {
  const auto problem = [](const MotionStep& step) {
    Motion motion;
    motion.steps = {move_to({0, 0}), step};
    std::string words;
    for (const Warning& warning : plausibility_of_steps(motion)) words += warning.words;
    return words;
  };
  const auto number_after = [](const std::string& words, const char* key) {
    const std::size_t at = words.find(key, words.find("Remedy: "));
    return at == std::string::npos ? NAN : std::stod(words.substr(at + std::strlen(key)));
  };
  for (const double percent : {0.003, 0.02, 0.5}) {
    MotionStep step = move_to({90, 0});
    step.speed_percent = percent;
    step.speed_percent = number_after(problem(step), "speed_percent: ");
    CHECK(problem(step) == "");
    step.acceleration_percent = percent;
    step.acceleration_percent = number_after(problem(step), "the acceleration in per cent: ");
    CHECK(problem(step) == "");
  }
  for (const char* const file : {"a.src", "a.mod"})
    for (const double speed : {12.0, 35.0, 49.0, 51.0, 500.0, 4e4}) {
      MotionStep step = move_to({90, 0});
      step.where.file = file, step.tool_speed = speed;
      step.tool_speed = number_after(problem(step), "Remedy: ") / (std::string_view(file) == "a.src" ? 1 : 1000);
      CAPTURE(file, speed);
      CHECK(problem(step) == "");
    }
  for (const double wait : {120.0, 36000.0, 5e5}) {
    MotionStep step;
    step.dwell = wait;
    const std::string words = problem(step);
    CHECK_THAT(words,
               Catch::Contains("if the hose waits so long, dwell_s: 10: a run simulates each second of a wait") &&
                   Catch::Contains("a duty with repeats_per_hour"));
    CHECK((words.find("milliseconds; ") != std::string::npos) == (wait <= 1e5));
  }
}

TEST_CASE(
    "plausible jobs: cores at the first level of a dresspack are those of one cable, whose clamps grip the jacket") {
  Job job;
  job.motion.steps.resize(2);
  MountedDresspack& mounted = job.dresspacks.emplace_back();
  Component core, wire;
  core.count = 7, core.radius = 1.2e-3, core.helix_radius = 2.8e-3;
  wire.radius = 1e-4;
  core.components = {wire};
  mounted.dresspack.diameter = 10e-3;
  mounted.dresspack.components = {core};
  const auto warned = [&] {
    return std::ranges::any_of(plausibility_of_lives(job), [](const Warning& warning) {
      return warning.words.find("the 7 parts of the dresspack fill 40 % of its cross-section (limit 25 %)") !=
             std::string::npos;
    });
  };
  CHECK(warned());
  mounted.dresspack.diameter = 20e-3;  // single cores on the arm
  CHECK_FALSE(warned());
  mounted.dresspack.diameter = 10e-3;
  job.strain.slip = {Slip::stick};  // a grip changes nothing
  CHECK_FALSE(warned());
  job.strain.slip = {Slip::friction};
  Component cable = core;
  cable.count = 1, cable.radius = 5e-3, cable.helix_radius = 0, cable.components = {core};
  mounted.dresspack.components = {cable};
  CHECK_FALSE(warned());
}

TEST_CASE("plausible jobs: a bend relief of fewer than four segments, or that is a tube") {
  const auto words_of = [](double length, double stiffness) {
    Job job;
    job.dresspacks[0].dresspack.bending_stiffness = 7;
    Routing& routing = job.dresspacks[0].routing;
    routing.free_length = 2;
    routing.base_clamp.emplace().bend_relief = {length, stiffness};
    job.simulation.segments = 64;
    std::string words;
    for (const Warning& warning : plausibility_warnings(job)) words += warning.words + "\n";
    return words;
  };
  CHECK(words_of(0.126, 15) == "");
  CHECK_THAT(words_of(0.124, 15), Catch::Contains("bend_relief.length_mm is 124: 4 segments (limit 4)") &&
                                      Catch::Contains("Remedy: simulation.segments: 65"));
  CHECK_THAT(words_of(0.0002, 15), Catch::Contains("bend_relief.length_mm: 200 if that was metres"));
  CHECK(words_of(0.05, 0) == "");
  CHECK(words_of(0, 15) == "");
  CHECK(words_of(0.2, 70) == "");
  CHECK_THAT(words_of(0.2, 71),
             Catch::Contains("bend_relief.bending_stiffness_Nm2 is 71 (limit 70, 10 times the dresspack's)") &&
                 Catch::Contains("bending_stiffness_Nm2: 7, as the dresspack"));
}

TEST_CASE("plausible jobs: a mounting pose in rounded radians, segments longer than a bend") {
  const auto words_of = [](const std::vector<double>& degrees, int segments) {
    Job job;
    Routing& routing = job.dresspacks[0].routing;
    routing.free_length = 2;
    routing.base_clamp.emplace();
    for (const double angle : degrees) routing.mounting_pose.push_back(angle * degree);
    job.dresspacks[0].dresspack.least_bend_radius = 0.26;
    job.simulation.segments = segments;
    std::string words;
    for (const Warning& warning : plausibility_warnings(job)) words += warning.words + "\n";
    return words;
  };
  CHECK_THAT(
      words_of({0, -0.17, 0.17, 0, 1.05, 0}, 64),
      Catch::Contains("no angle of routing.mounting_pose_deg, [0, -0.17, 0.17, 0, 1.05, 0], is larger than 1.05 deg") &&
          Catch::Contains("routing.mounting_pose_deg: [0, -9.74, 9.74, 0, 60.16, 0] if those were radians"));
  CHECK(words_of({0, -10, 10, 0, 60, 0}, 64) == "");
  CHECK(words_of({0, -5, 5, 0, 2, 0}, 64) == "");  // whole degrees
  CHECK(words_of({0, -9.74, 9.74, 0, 60.16, 0}, 64) == "");
  CHECK(words_of({}, 16) == "");  // 0.125 m
  CHECK_THAT(words_of({}, 8), Catch::Contains("a segment is 0.25 m long"));
  CHECK_THAT(words_of({}, 4), Catch::Contains("simulation.segments is 4: a segment is 0.5 m long (limit 0.13 m") &&
                                  Catch::Contains("Remedy: simulation.segments: 64"));
}

namespace {

/// Returns a job with six axes of a published robot. file: source of the robot; accelerations: source of the accelerations.
Job with_axes(const std::string& file = "robot.yaml", const std::string& accelerations = "robot.yaml") {
  Job job;
  const double speeds[] = {175, 175, 175, 360, 360, 500}, rates[] = {760, 555, 1170, 5155, 5420, 7615};
  for (int k = 0; k < 6; ++k) {
    Joint joint;
    joint.name = fmt::format("a{}", k + 1);
    joint.lower = -180 * degree, joint.upper = 180 * degree, joint.speed = speeds[k] * degree,
    joint.acceleration = rates[k] * degree;
    joint.where = {file, 10 + k}, joint.acceleration_where = {accelerations, 4, 8};
    job.robot.joints.push_back(joint);
  }
  return job;
}

std::string doubts_of(const Job& job) {
  std::string words;
  for (const Warning& warning : plausibility_warnings(job)) words += warning.line() + "\n";
  return words;
}

}  // namespace

TEST_CASE(
    "plausible jobs: limits of axes in degrees in a URDF, in radians in YAML, and those of wrists that turn far") {
  CHECK(doubts_of(with_axes()) == "");
  Job job = with_axes("arm.urdf", "job.yaml");
  CHECK(doubts_of(job) == "");
  job.robot.joints[0].lower = -180, job.robot.joints[0].upper = 180;  // [rad] as written
  CHECK_THAT(doubts_of(job),
             Catch::StartsWith("arm.urdf:10: warning: a1 turns from -10313 to 10313 deg (limit 4 turns)") &&
                 Catch::Contains("limit lower=\"-3.1416\" upper=\"3.1416\" if those were degrees"));
  job.robot.joints[0].lower = -4 * 360 * degree, job.robot.joints[0].upper = 4 * 360 * degree;
  CHECK(doubts_of(job) == "");
  job.robot.joints[0].upper = 36000 * degree,
  job.robot.joints[0].lower = -job.robot.joints[0].upper;  // continuous
  CHECK(doubts_of(job) == "");
  job.robot.joints[0].upper =
      251 * 360 * degree;  // a wrist with 251 revolutions, 1577 rad: no robot has a limit of 1577 deg
  CHECK(doubts_of(job) == "");
  Job radians = with_axes();
  for (Joint& joint : radians.robot.joints) joint.lower = -2.9 * degree, joint.upper = 2.9 * degree;
  CHECK_THAT(doubts_of(radians),
             Catch::Contains("robot.yaml:10: warning: no axis of the robot turns farther than 2.9 deg") &&
                 Catch::Contains("lower_deg: -166.2 and upper_deg: 166.2 of a1 if those were radians"));
}

TEST_CASE("plausible jobs: speeds of a URDF in degrees, accelerations in radians or reversed") {
  Job job = with_axes("arm.urdf", "job.yaml");
  job.robot.joints[2].speed = 166;
  CHECK_THAT(
      doubts_of(job),
      Catch::Contains("arm.urdf:12: warning: velocity of a3 is 166 rad/s, 9511 deg/s (limits 5 .. 3000 deg/s)") &&
          Catch::Contains("velocity=\"2.897\" if that was deg/s"));
  job = with_axes("arm.urdf", "job.yaml");
  for (Joint& joint : job.robot.joints) joint.acceleration *= degree;
  const std::string slow = doubts_of(job);
  CHECK_THAT(slow,
             Catch::StartsWith("job.yaml:4:8: warning: a1 takes 13.2 s") &&
                 Catch::Contains("accelerations_deg_per_s2: [760, 555, 1170, 5155, 5420, 7615] if that was rad/s2"));
  CHECK(std::count(slow.begin(), slow.end(), '\n') == 1);  // one remedy for all axes
  job = with_axes("arm.urdf", "job.yaml");
  for (int k = 0; k < 3; ++k) std::swap(job.robot.joints[k].acceleration, job.robot.joints[5 - k].acceleration);
  CHECK_THAT(
      doubts_of(job),
      Catch::StartsWith(
          "job.yaml:4:8: warning: axes 1 to 3 accelerate by 5155 deg/s2 and more, and the wrist by 1170 at most") &&
          Catch::Contains("accelerations_deg_per_s2: [760, 555, 1170, 5155, 5420, 7615] if so"));
  job = with_axes("arm.urdf", "job.yaml");
  for (Joint& joint : job.robot.joints) joint.acceleration *= 10;
  CHECK_THAT(
      doubts_of(job),
      Catch::Contains("every axis reaches its full speed within 0.0315 s (limit 0.05 s") &&
          Catch::Contains("accelerations_deg_per_s2: [760, 555, 1170, 5155, 5420, 7615] if there is an extra zero"));
  for (Joint& joint : job.robot.joints) joint.acceleration = 500 * degree;  // all equal
  CHECK(doubts_of(job) == "");
}

TEST_CASE("plausible steps: tools and work objects in metres") {
  const auto doubts_at = [](double x, double y, double z) {
    Motion motion;
    motion.tools.push_back({"grip", {x / 1e3, y / 1e3, z / 1e3}, {1, 0, 0, 0}, false});
    motion.work_objects.push_back({"table", {0, 0, 0}, {1, 0, 0, 0}, false});
    std::string words;
    for (const Warning& warning : plausibility_of_steps(motion)) words += warning.words;
    return words;
  };
  CHECK_THAT(
      doubts_at(0, 0, 0.22),
      Catch::Contains("tool 'grip' lies 0.22 mm from the frame in which it is given (limit 0, or more than 5 mm)") &&
          Catch::Contains("[0, 0, 220] in its declaration if those were metres"));
  CHECK(doubts_at(0, 0, 220) == "");
  CHECK(doubts_at(0, 0, 0) == "");
  CHECK(doubts_at(0.01, -0.02, 0) == "");
}

TEST_CASE("plausible jobs: a clamp in the air") {
  Job job = with_axes();
  job.robot.links.resize(7);
  for (int k = 0; k < 7; ++k) job.robot.links[k].name = fmt::format("l{}", k);
  job.robot.links[3].boxes = {{{0, 0, 0}, {0, 0, 0}, {0.4, 0.4, 0.4}}};
  job.robot.links[3].capsules = {{{0, 0, 0}, {1, 0, 0}, 0.1}};
  const auto with = [&](const char* link, Vector3d place) {
    Routing& routing = job.dresspacks[0].routing;
    routing.base_clamp = Clamp{link, place, {1, 0, 0}, {}, {"job.yaml", 9}};
    routing.free_length = 1;
    return doubts_of(job);
  };
  CHECK(with("l3", {0.5, 0, 0.59}) == "");
  CHECK(with("l3", {0, 0, 0.69}) == "");
  CHECK_THAT(with("l3", {0.1, -0.02, -1.17}),
             Catch::StartsWith(
                 "job.yaml:9: warning: routing.base_clamp.position_m lies 0.97 m from all shapes of l3 (limit 0.5)") &&
                 Catch::Contains("position_m: [0.1, -0.02, -0.117] if a decimal point slipped"));
  CHECK(with("l2", {0, 0, 1}) == "");  // without shapes
  CHECK(with("l6", {0, 0.3, 0.3}) == "");
  CHECK_THAT(with("l6", {0, 0.72, -0.24}),
             Catch::Contains("lies 0.759 m from all shapes of l6") && Catch::Contains("robot.links.7.boxes"));
  job.dresspacks[0].routing.longest_bracket = 0.8;
  CHECK(with("l6", {0, 0.72, -0.24}) == "");
  job.dresspacks.push_back(job.dresspacks[0]);
  CHECK_THAT(with("l3", {0.1, -0.02, -1.17}),
             Catch::Contains("dresspacks.1.routing.base_clamp.position_m lies 0.97 m"));
  job.dresspacks.pop_back();
  job.robot.links[3].meshes.emplace_back();  // meshes are not read in this check
  CHECK(with("l3", {0, 0, 2.9}) == "");
}

TEST_CASE("plausible steps: one target in radians among others, one place in metres among others") {
  const auto words = [](std::vector<MotionStep> steps) {
    Motion motion;
    motion.steps = std::move(steps);
    std::string all;
    for (const Warning& warning : plausibility_of_steps(motion)) all += warning.words + "\n";
    return all;
  };
  const MotionStep home = move_to({0, -15, 15, 0, 60, 0}), turned = move_to({1.05, -0.09, 0.17, 0.70, 1.05, -0.79});
  CHECK_THAT(
      words({home, turned}),
      Catch::Contains("all angles of this target are below 3.15 deg (limit: those of other targets reach 60 deg)") &&
          Catch::Contains("[60.16, -5.157, 9.74, 40.11, 60.16, -45.26] if those were radians"));
  CHECK(words({home, move_to({0, 0, 0, 0, 0, 0})}) == "");             // the zero pose
  CHECK(words({home, move_to({0.1, -0.2, 0.3, 0, 0.1, 0.2})}) == "");  // its adjustment
  CHECK(words({home, move_to({0, -1.2, 1.2, 0, 0, 0})}) == "");        // two axes
  CHECK(words({home, turned, move_to({1.1, -0.1, 0.2, 0.7, 1, -0.8}), move_to({1.2, -0.1, 0.2, 0.7, 1, -0.8})}) ==
        "");  // most of the program is there
  CHECK_THAT(
      words({turned, home, turned}),
      Catch::Contains("[60.16, -5.157, 9.74, 40.11, 60.16, -45.26] if those were radians"));  // a target counts once
  const auto place = [](double x, double y, double z, const char* object = "table") {
    MotionStep step;
    step.position = {x / 1e3, y / 1e3, z / 1e3}, step.work_object = object;
    return step;
  };
  CHECK_THAT(words({place(0.1, 0.1, 0.4), place(100, 100, 150), place(100, 900, 400)}),
             Catch::Contains(
                 "this target lies 0.4 mm from the origin of its frame (limit: others lie up to 900 mm from theirs)") &&
                 Catch::Contains("[100, 100, 400] if those were metres"));
  CHECK(words({place(0, 0, 0), place(100, 100, 150), place(100, 900, 400)}) == "");
  CHECK(words({place(0.01, -0.02, 0.03), place(100, 100, 150), place(100, 900, 400)}) == "");
  CHECK(words({place(0, 0, 3), place(100, 100, 150), place(100, 900, 400)}) == "");
  CHECK(words({place(1, 2, 3, "pin"), place(100, 100, 150), place(100, 900, 400)}) == "");  // another object
}
