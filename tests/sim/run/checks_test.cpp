#include "sim/run/checks.h"

#include "pipeline/base/constants.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

const Check& find(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& check : checks)
    if (check.name == name) return check;
  throw std::logic_error("no check " + name);
}

TEST_CASE("checks: an evenly bent and twisted chain has one radius and one twist") {
  pipeline::Job job = simple_job();
  const Simulation simulation(job);
  const Rod& rod = simulation.rod();
  // Every link turns by its compliance length times the same curvature and twist.
  const Vector3 rate(1 / 0.35, 0, -2);
  RodState state = rod.straight(Frame{});
  Quaternion q = Quaternion::Identity();
  for (int j = 0; j < rod.links(); ++j) {
    q = q * rotation(rate * rod.bending_length(j));
    (j < rod.segments() ? state.orientation[j] : state.clamps.tool.orientation) = q;
  }
  MotionChecks checks(rod, {limits_of(job.dresspacks[0].dresspack)});
  checks.see(state, {}, 0.5);
  const std::vector<Check> table = checks.table();
  const Check& radius = find(table, "smallest bend radius");
  CHECK(radius.value == Approx(0.35));
  CHECK(radius.limit == Approx(0.4));  // ten diameters
  CHECK(radius.warning);
  CHECK(radius.time == 0.5);
  CHECK((!radius.line || *radius.line == Approx(1 / 0.35)));  // at a clamp: its neighbours lead to the same bend
  const Check& twist = find(table, "largest twist");
  CHECK(twist.value == Approx(-2));
  CHECK_FALSE(twist.warning);
  CHECK(twist.limit == Approx(pi));
  CHECK(find(table, "largest net twist").value == Approx(-2 * job.dresspacks[0].routing.free_length));
  CHECK(find(table, "net twist left by a repeat").value == 0);
}

TEST_CASE("checks: a maker's own limits count more than the usual ones") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].dresspack.least_bend_radius = 0.15;
  job.dresspacks[0].dresspack.most_twist = 0.5;
  job.simulation.most_repeats = 1;
  const RunSummary summary = Simulation(job).run({[](const Sample&) {}});
  const Check& radius = find(summary.checks, "smallest bend radius");
  CHECK(radius.limit == 0.15);
  CHECK(radius.warning == (radius.value < 0.15));
  const Check& twist = find(summary.checks, "largest twist");  // the motion turns by 2 rad over 1 m
  CHECK(twist.limit == 0.5);
  CHECK(twist.warning);
}

TEST_CASE("checks: every step counts, with its time, place and value") {
  pipeline::Job job = simple_job();
  job.simulation.sample_rate = 200;  // every step is a sample
  job.simulation.most_repeats = 1;
  job.robot.links[0].capsules = {{{0.45, -1, 0.85}, {0.45, 1, 0.85}, 0.1}};  // a bar that the hose touches
  const Simulation simulation(job);
  const Rod& rod = simulation.rod();
  double curvature = 0, when = 0, where = 0, depth = 0, tension = -1e9, twist = 0;
  const RunSummary summary = simulation.run({[&](const Sample& s) {
    depth = std::max(depth, s.max_depth);
    for (const double pull : rod.tensions(s.state)) tension = std::max(tension, pull);
    for (int j = 0; j < rod.links(); ++j) {
      const Vector3 turn = rod.link_state(s.state, j).turn / rod.bending_length(j);
      twist = std::max(twist, std::abs(turn.z()));
      if (turn.head<2>().norm() <= curvature) continue;
      curvature = turn.head<2>().norm();
      when = s.time;
      where = j * rod.segment_length();
    }
  }});
  const Check& radius = find(summary.checks, "smallest bend radius");
  CHECK(radius.value == Approx(1 / curvature));
  CHECK(radius.time == Approx(when));
  CHECK(radius.position == Approx(where));
  CHECK(std::abs(find(summary.checks, "largest twist").value) == Approx(twist));
  CHECK(find(summary.checks, "largest tension").value == Approx(tension));
  CHECK(find(summary.checks, "deepest contact").value == depth);
  CHECK(find(summary.checks, "largest contact force").value > 0);
}

TEST_CASE("checks: too short and too long are reported with their moment") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  // The tool clamp swings about an axis at 50 mm from the base clamp.
  job.robot.joints[0].axis = {0, 0, 1};
  job.robot.joints[0].origin = {0.05, 0, 1};
  job.motion.steps = {move_to(pi / 2), move_to(-pi / 2, "sweep")};
  job.dresspacks[0].routing.free_length = 0.96;  // largest distance from the base clamp, at angle 0: 0.95 m
  job.dresspacks[0].dresspack.least_bend_radius =
      0.03;  // far below the radius that occurs: the only warning is about slack
  const Simulation simulation(job);
  const RunSummary summary = simulation.run({[](const Sample&) {}});
  const Check& little = find(summary.checks, "least slack, length too short");
  CHECK(little.value == Approx(0.01).epsilon(0.01));  // one step is 1e-5 m
  CHECK(little.warning);
  CHECK_FALSE(find(summary.checks, "least slack, length too long").warning);
  CHECK(find(summary.checks, "most slack").value == Approx(0.96 - std::hypot(0.05, 0.9)));
  bool told = false;
  std::string lines;
  for (const pipeline::Warning& warning : warnings_of(simulation, summary)) {
    const std::string line = warning.line();
    lines += line + "\n";
    told |=
        warning.kind == pipeline::WarningKind::slack &&
        line.starts_with("warning: least slack, length too short: 10.0 mm (limit 19.2 mm) at ") &&
        line.find("'sweep'. Likely cause: the clamps are 0.950 m apart") != std::string::npos &&
        line.find("Remedy: routing.free_length_m: 0.970 (bend radius at rest ") != std::string::npos;  // 0.95 / 0.98
  }
  CAPTURE(lines);
  CHECK(told);

  job.dresspacks[0].routing.free_length = 1.6;
  job.simulation.floor = false;
  CHECK(find(Simulation(job).run({[](const Sample&) {}}).checks, "least slack, length too long").warning);
}

}  // namespace
}  // namespace dresslife::sim
