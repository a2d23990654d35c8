#include "pipeline/resolve/plausible_job.h"

#include <numbers>

#include "pipeline/resolve/radians.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double degree = std::numbers::pi / 180;

MotionStep move_to(std::vector<double> degrees) {
  MotionStep step;
  for (const double angle : degrees) step.joints.push_back(angle * degree);
  return step;
}

std::size_t doubts(std::vector<MotionStep> steps) {
  Motion motion;
  motion.steps = std::move(steps);
  return plausibility_of_steps(motion).size();
}

}  // namespace

TEST_CASE("plausible steps: angles that are all below a turn in radians and yet move") {
  CHECK(doubts({}) == 0);
  CHECK(doubts({move_to({1, 2}), move_to({1.2, 2})}) == 1);
  CHECK(doubts({move_to({100, 2}), move_to({100.05, 2})}) == doubts({move_to({1, 2}), move_to({1.05, 2})}));  // it stands
  CHECK(doubts({move_to({1, -6.2}), move_to({3, 2})}) == 1);
  CHECK(doubts({move_to({1, -6.3}), move_to({3, 2})}) == 0);
  CHECK(doubts({move_to({1, 2}), move_to({6.3, 2})}) == 0);
  MotionStep block;
  block.repeat = 2, block.steps = {move_to({90, 0})};
  CHECK(doubts({move_to({1, 2}), move_to({3, 2}), block}) == 0);  // also what a block holds
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
    for (const Warning& warning : radians_in(parse_yaml(text, "job.yaml"), "routing"))
      words.push_back(warning.line());
    return words;
  };
  const auto vector = lines("mounting_pose_deg: [0, -1.5708, 0.7854, 0]\n");
  REQUIRE(vector.size() == 1);
  CHECK_THAT(vector[0],
             Catch::Contains("job.yaml:1:1: ") &&
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
}

TEST_CASE("plausible jobs: a sample rate that misses the swing, a gate that hides cycles") {
  const auto doubts_of = [](double rate, double gate, bool prescribed) {
    Job job;
    job.simulation.sample_rate = rate, job.strain.gate = gate;
    if (prescribed) job.motion.rig.emplace();
    return plausibility_warnings(job).size();
  };
  CHECK(doubts_of(5, 5e-4, false) == 0);
  CHECK(doubts_of(4.9, 5e-4, false) == 1);
  CHECK(doubts_of(4.9, 5e-4, true) == 0);
  CHECK(doubts_of(5, 5.1e-4, true) == 1);
  CHECK(doubts_of(1, 0.1, false) == 2);
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
  CHECK_THAT(words_of({0, -0.17, 0.17, 0, 1.05, 0}, 64),
             Catch::Contains("no angle of routing.mounting_pose_deg, [0, -0.17, 0.17, 0, 1.05, 0], is larger than 1.05 deg") &&
                 Catch::Contains("routing.mounting_pose_deg: [0, -9.74, 9.74, 0, 60.16, 0] if those were radians"));
  CHECK(words_of({0, -10, 10, 0, 60, 0}, 64) == "");
  CHECK(words_of({0, -5, 5, 0, 2, 0}, 64) == "");       // whole degrees
  CHECK(words_of({0, -9.74, 9.74, 0, 60.16, 0}, 64) == "");
  CHECK(words_of({}, 8) == "");                          // 0.25 m
  CHECK_THAT(words_of({}, 4), Catch::Contains("simulation.segments is 4: a segment is 0.5 m long (limit 0.26 m") &&
                                  Catch::Contains("Remedy: simulation.segments: 64"));
}
