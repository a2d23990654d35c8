// Clamps in one plane with the arm: the hose rests on both sides.

#include "sim/run/other_side.h"

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"

namespace dresslife::sim {
namespace {

/// The program easy, in which a hose keeps the side on which it was mounted: a longer hose without the sleeves of the shipped job,
/// which keep it in the plane of the arm.
pipeline::Job job_of(const std::string& side, std::vector<std::string> more = {}) {
  std::vector<std::string> sets{
      "motion=easy",
      "simulation.segments=24",
      "routing.side=" + side,
      "routing.base_clamp={link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}",
      "routing.tool_clamp={link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}",
      "routing.free_length_m=2.035"};
  sets.insert(sets.end(), more.begin(), more.end());
  return pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", sets);
}

/// Returns the mean position to the left of the plane of the arm [m].
double to_left(const RodState& state) {
  double sum = 0;
  for (const Vector3& x : state.position) sum += x.y();
  return sum / static_cast<double>(state.position.size());
}

std::vector<pipeline::Warning> warnings_of_sides(const pipeline::Job& job) {
  const Simulation simulation(job);
  Ends ends{simulation.start(), {}};
  simulation.run({[&](const Sample& sample) { ends.end = sample.state; }});
  return other_side_warnings(job, job.simulation.time_step, ends);
}

TEST_CASE(
    "a hose is mounted on the side that the job states, for any number of segments, and on the left without a side") {
  for (const std::string segments : {"21", "24", "32"}) {
    INFO(segments);
    const std::vector<std::string> mesh{"simulation.segments=" + segments};
    const double left = to_left(Simulation(job_of("left", mesh)).start()),
                 right = to_left(Simulation(job_of("right", mesh)).start()),
                 either = to_left(Simulation(job_of("either", mesh)).start());
    constexpr double mirrored = 1e-3;  // [m], both come to rest with a speed of 1e-5 m/s
    CHECK(left > 0.06);                // its diameter
    CHECK(left == Approx(-right).margin(mirrored));
    CHECK(either == Approx(left).margin(mirrored));
  }
}

TEST_CASE("clamps that are built some millimetres beside the plane of the arm leave the side as it is") {
  for (const std::string y : {"-0.005", "0.005"}) {
    INFO(y);
    CHECK(to_left(Simulation(job_of("either", {"routing.base_clamp.position_m=[-0.1, " + y + ", 0.45]"})).start()) >
          0.06);
  }
}

TEST_CASE("a motion that differs between the two sides causes a warning, unless the job states the side") {
  const std::vector<pipeline::Warning> warnings = warnings_of_sides(job_of("either"));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].kind == pipeline::WarningKind::side);
  CHECK(warnings[0].remedy == std::vector<pipeline::KeyValue>{{"routing.side", "left"}});
  CHECK_THAT(warnings[0].words, Catch::Contains("moves differently in each") && Catch::Contains("on the left"));
  CHECK(warnings_of_sides(job_of("left")).empty());
}

TEST_CASE("a side without gravity is refused") {
  CHECK_THROWS_WITH(Simulation(job_of("left", {"simulation.gravity_m_per_s2=[0, 0, 0]"})),
                    Catch::Contains("has no left and no right side") && Catch::Contains("leave routing.side out"));
}

TEST_CASE("no warning of sides: the hose has one shape, or the motion forgets the other one") {
  CHECK(warnings_of_sides(job_of("either", {"routing.free_length_m=1.95"})).empty());
  CHECK(warnings_of_sides(job_of("either", {"motion=spot_robot_2"})).empty());
}

}  // namespace
}  // namespace dresslife::sim
