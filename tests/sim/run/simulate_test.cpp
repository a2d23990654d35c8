#include "sim/run/simulate.h"

#include <fstream>
#include <optional>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

/// [m] Contact corrects speeds only, so the hose may penetrate a little: less than the wall of a real hose yields.
constexpr double deepest_overlap = 1e-3;

struct Row {
  double time, depth;
  int step, contacts;
  RodState state;
  Pose pose;
  Energy energy;
  std::vector<double> tension;
};

std::vector<Row> run(const Simulation& simulation) {
  std::vector<Row> rows;
  simulation.run({[&](const Sample& s) {
                    rows.push_back({s.time, s.max_depth, s.step, s.contacts, s.state, s.pose, s.energy, s.tension});
                  },
                  [&](int) { rows.clear(); }});
  return rows;
}

/// Returns the sum of all links' rotations about the tangent [rad].
double net_twist(const Rod& rod, const RodState& state) {
  double twist = 0;
  for (int link = 0; link < rod.links(); ++link) twist += rod.link_state(state, link).turn.z();
  return twist;
}

double largest_distance(const RodState& a, const RodState& b) {
  double distance = 0;
  for (size_t i = 0; i < a.position.size(); ++i) distance = std::max(distance, (a.position[i] - b.position[i]).norm());
  return distance;
}

TEST_CASE("simulate: samples lie on the grid, from 0 until the motion has ended") {
  pipeline::Job job = simple_job();
  job.simulation.sample_rate = 40;
  const Simulation simulation(job);
  const std::vector<Row> rows = run(simulation);
  const double duration = simulation.path().duration();
  REQUIRE(static_cast<int>(rows.size()) == simulation.description().samples);
  for (size_t k = 0; k < rows.size(); ++k) {
    CHECK(rows[k].time == static_cast<double>(k) / 40);
    CHECK(rows[k].step == simulation.path().step(rows[k].time));
    CHECK(rows[k].tension.size() == 20);
  }
  CHECK(rows.back().time >= duration);
  CHECK(rows.back().time < duration + 1 / 40.0);
  CHECK(simulation.description().step_texts == std::vector<std::string>{"start", "turn", "dwell 3", "back"});
  CHECK(simulation.description().link_names == std::vector<std::string>{"bench", "spindle"});
  CHECK(rows.front().step == 1);  // the first line only states the robot's start
  CHECK(rows.back().step == 3);
}

TEST_CASE("simulate: a run ends where its sink has had enough work") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  const Simulation simulation(job);
  double all = 0;
  const auto ended = [&](double most) {
    all = 0;
    int samples = 0;
    RunSinks sinks{[&](const Sample&) { ++samples; }};
    sinks.goes_on = [&](double work, bool) { return (all += work) <= most; };
    const RunSummary summary = simulation.run(sinks);
    CHECK(summary.stopped_at.has_value() == (samples < simulation.description().samples));
    return summary.stopped_at;
  };
  CHECK_FALSE(ended(1e12));
  const double whole = all;
  CHECK(whole >= 20.0 * simulation.path().duration() / job.simulation.time_step);  // 20 segments in each step
  const std::optional<double> early = ended(whole / 2);
  REQUIRE(early);
  CHECK(*early > 0);
  CHECK(*early < simulation.path().duration());
  // The limit is checked once per sample: at most the work of one interval between two samples is added.
  CHECK(all < whole / 2 + 2 * whole / (simulation.description().samples - 1));
}

TEST_CASE("simulate: a hose in its equilibrium stays there while the robot stands") {
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0), dwell_for(3)};
  const std::vector<Row> rows = run(Simulation(job));
  // The equilibrium's residual is 1e-8 of the forces. Settling ends at 1 mm/s, far above the remaining motion.
  constexpr double still = 1e-6;
  for (const Row& row : rows) CHECK(largest_distance(row.state, rows.front().state) < still);
  // The hose sags: its middle is lower than its ends by more than a tenth of the chord.
  CHECK(rows.front().state.position[10].z() < 0.9);
  CHECK(rows.back().energy.kinetic < still * still);
}

TEST_CASE("simulate: the weight hangs on the two clamps") {
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0), dwell_for(0.2)};
  job.dresspacks[0].routing.base_clamp->direction = {0, 0, -1};
  job.dresspacks[0].routing.tool_clamp->direction = {0, 0, 1};  // a hanging loop: each end carries half of the weight
  job.dresspacks[0].routing.free_length = 2;
  const Row last = run(Simulation(job)).back();
  const double weight = 2 * 1.5 * 9.81;
  // At the centre of an end segment the tension is smaller than at the clamp by half of a segment's weight.
  CHECK(last.tension.front() == Approx(weight / 2 * 0.95).epsilon(0.01));
  CHECK(last.tension.back() == Approx(last.tension.front()).epsilon(1e-4));
}

TEST_CASE("simulate: the tool clamp is mounted free of twist, or as the routing says") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].dresspack.bending_stiffness = 20;  // nearly straight, so all of the roll becomes twist
  job.dresspacks[0].routing.free_length = 0.905;
  const Simulation free(job);
  constexpr double no_twist = 1e-6;  // the equilibrium's residual
  CHECK(std::abs(net_twist(free.rod(), free.start())) < no_twist);
  job.dresspacks[0].routing.tool_clamp->roll = 0.5;
  const Simulation rolled_by(job);
  CHECK(net_twist(rolled_by.rod(), rolled_by.start()) == Approx(0.5).epsilon(0.02));
}

TEST_CASE("simulate: whole turns between the mounting pose and the first waypoint stay in the hose") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].dresspack.bending_stiffness = 20;  // does not loop
  job.dresspacks[0].routing.free_length = 0.905;
  job.dresspacks[0].routing.mounting_pose = {-3 * pi};
  const Simulation simulation(job);
  CHECK(net_twist(simulation.rod(), simulation.start()) == Approx(3 * pi).epsilon(0.02));
}

TEST_CASE("simulate: twice the same job gives the same bits") {
  const std::vector<Row> a = run(Simulation(simple_job())), b = run(Simulation(simple_job()));
  REQUIRE(a.size() == b.size());
  for (size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].state.position == b[k].state.position);
    CHECK(a[k].energy.elastic == b[k].energy.elastic);
  }
}

TEST_CASE("simulate: recorded clamp poses move the hose as the robot does") {
  const pipeline::Job job = simple_job();
  const Simulation driven(job);
  const pipeline::Scratch scratch;
  const auto file = scratch / "recorded.csv";
  {
    std::ofstream csv(file);
    const int rows = 200;
    for (int k = 0; k <= rows; ++k) {
      const double t = driven.path().duration() * k / rows;
      csv << fmt::format("{}", t);
      const ClampFrames clamps = driven.path().at(t).clamps;
      for (const Frame& f : {clamps.base, clamps.tool})
        csv << fmt::format(",{},{},{},{},{},{},{}", f.position.x(), f.position.y(), f.position.z(), f.orientation.w(),
                           f.orientation.x(), f.orientation.y(), f.orientation.z());
      csv << "\n";
    }
  }
  pipeline::Job recorded = job;
  recorded.robot = {};
  recorded.motion = {};
  recorded.motion.clamp_poses = file;
  recorded.dresspacks[0].routing.base_clamp.reset();
  recorded.dresspacks[0].routing.tool_clamp.reset();
  const std::vector<Row> a = run(driven), b = run(Simulation(recorded));
  REQUIRE(a.size() == b.size());
  // Rows 10 ms apart. The motion's jerk jumps by 30 rad/s3; a cubic spline has an error of h^3/6 of it: 5e-6 rad.
  constexpr double spline_error = 2e-5;
  for (size_t k = 0; k < a.size(); ++k) CHECK(largest_distance(a[k].state, b[k].state) < spline_error);
  CHECK(b.front().pose.links.empty());
}

TEST_CASE("simulate: a dresspack that is too short is refused with time, line and length") {
  pipeline::Job job = simple_job();
  job.robot.joints[0].axis = {0, 0, 1};  // the tool clamp swings about the base clamp's axis
  job.dresspacks[0].routing.base_clamp->position = {0.3, 0, 1};
  CHECK_THROWS_WITH(
      Simulation(job),
      Catch::StartsWith("job.yaml:8:3: error: dresspack is ") && Catch::Contains(" mm too short at 1.") &&
          Catch::Contains("s, program step 3 'dwell 3' (routing.free_length_m is 1, the "
                          "clamps are 1.0") &&
          Catch::EndsWith(
              "; give it more free length, with slack to bend, or move a clamp (dresslife preview shows it)"));
}

TEST_CASE("simulate: a dresspack that winds itself taut stops the run") {
  pipeline::Job job = simple_job();
  // The tool clamp moves around a post of 0.5 m diameter, 0.35 m from its axis. Two rounds need 3.5 m.
  job.robot.joints[0].axis = {0, 0, 1};
  job.robot.joints[0].origin = {0, 0, 1};
  job.robot.links[0].capsules = {{{0, 0, 0}, {0, 0, 2}, 0.25}};
  job.dresspacks[0].routing.base_clamp = pipeline::Clamp{"bench", {-1, 0.35, 1}, {1, 0, 0}, {}, {}};
  job.dresspacks[0].routing.tool_clamp = pipeline::Clamp{"spindle", {0, 0.35, 0}, {1, 0, 0}, {}, {}};
  job.dresspacks[0].routing.free_length = 1.5;
  job.motion.steps = {move_to(0), move_to(-12, "wind up")};
  job.simulation.floor = false;
  const Simulation simulation(job);
  int samples = 0;
  CHECK_THROWS_WITH(simulation.run({[&](const Sample&) { ++samples; }}),
                    Catch::Contains("job.yaml:8:3: error: dresspack is pulled tight at ") &&
                        Catch::Contains("program step 2 'wind up': ") && Catch::Contains("mm are missing"));
  CHECK(samples > 10);
  job.cell.capsules = {{{0, 0, 1}, {0, 0, 3}, 0.25}};  // the same post beside the robot
  job.robot.links[0].capsules.clear();
  CHECK_THROWS_WITH(Simulation(job).run({[](const Sample&) {}}),
                    Catch::Contains("winding it around the robot or an obstacle of the cell"));
}

TEST_CASE("simulate: a state that is not finite stops the run") {
  const pipeline::Scratch scratch;
  pipeline::Job job = simple_job();
  job.robot = {};
  job.motion = {};
  job.motion.clamp_poses = scratch.write("far.csv",
                                         "0,0,0,1,0.7071068,0,0.7071068,0,0.9,0,1,0.7071068,0,0.7071068,0\n"
                                         "1,1e300,0,1,0.7071068,0,0.7071068,0,1e300,0,1,0.7071068,0,0.7071068,0\n");
  const Simulation simulation(job);
  CHECK_THROWS_WITH(simulation.run({[](const Sample&) {}}),
                    "job.yaml: error: the simulation broke down at 0.005 s, program step 1 'clamp poses of "
                    "far.csv' (the state is not finite); choose a smaller simulation.time_step_ms, "
                    "or check the dresspack's stiffness and mass");
}

TEST_CASE("simulate: a hose hangs over a robot link without sinking in") {
  pipeline::Job job = simple_job();
  job.robot.links[0].capsules = {{{0.45, -1, 0.85}, {0.45, 1, 0.85}, 0.1}};  // a bar across, below the clamps
  // Without the bar the hose would hang more than 0.1 m below the clamps, which is below the bar.
  const std::vector<Row> rows = run(Simulation(job));
  int touching = 0;
  for (const Row& row : rows) {
    touching += row.contacts > 0;
    CHECK(row.depth < deepest_overlap);
    for (const Vector3& centre : row.state.position)
      CHECK(std::hypot(centre.x() - 0.45, centre.z() - 0.85) > 0.1 + 0.02 - deepest_overlap);
  }
  CHECK(touching == static_cast<int>(rows.size()) - 1);  // all but the first sample, which is before the first step
}

TEST_CASE("simulate: a slack hose lies on the floor") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].routing.free_length = 3;
  job.simulation.segments = 30;
  for (const Row& row : run(Simulation(job))) {
    CHECK(row.depth < deepest_overlap);
    for (const Vector3& centre : row.state.position) CHECK(centre.z() > 0.02 - deepest_overlap);
  }
  job.simulation.floor = false;
  CHECK(run(Simulation(job)).front().state.position[15].z() < 0);
}

TEST_CASE("simulate: a clamp inside the robot is refused") {
  pipeline::Job job = simple_job();
  job.robot.links[0].capsules = {{{0.3, 0, 1}, {0.6, 0, 1}, 0.3}};
  CHECK_THROWS_WITH(Simulation(job),
                    Catch::StartsWith("job.yaml:8:3: error: dresspack runs ") &&
                        Catch::Contains(" mm deep through " + job.robot.links[0].name + " in the mounting pose, 0."));
}

}  // namespace
