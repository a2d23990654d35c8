#include "sim/run/periodic.h"

#include <thread>

#include "pipeline/base/constants.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

/// States at the begin of every repeat except the first one, and at the end; and the last repeat's samples.
struct Run {
  std::vector<RodState> begin;
  RodState end;
  std::vector<double> times, net_twist;
  RunSummary summary;
};

Run run(const Simulation& simulation) {
  Run r;
  r.summary = simulation.run({[&](const Sample& s) {
                                if (s.time == 0) r.begin.push_back(s.state);
                                r.times.push_back(s.time);
                                r.net_twist.push_back(s.net_twist);
                                r.end = s.state;
                              },
                              [&](int repeat) {
                                CHECK(repeat == static_cast<int>(r.begin.size()) + 2);
                                r.times.clear();
                                r.net_twist.clear();
                              }});
  return r;
}

TEST_CASE("periodic: the distance of two states is what a point of the surface moves") {
  const Rod rod(Simulation(simple_job()).rod());
  const RodState a = rod.straight(Frame{});
  CHECK(state_distance(rod, a, a) == 0);
  RodState b = a;
  b.position[7] += Vector3(0.003, 0, 0.004);
  CHECK(state_distance(rod, a, b) == Approx(0.005));
  b = a;
  b.orientation[3] = b.orientation[3] * rotation({0, 0, 0.1});  // 0.04 m thick: its surface moves by 2 mm
  CHECK(state_distance(rod, a, b) == Approx(0.002));
  b = a;
  b.velocity[0].y() = 0.02;
  CHECK(state_distance(rod, a, b) == Approx(0.002));
  b = a;  // a retraction unit that is pulled out further, and one that moves
  b.travel[0].way = 0.003;
  CHECK(state_distance(rod, a, b) == Approx(0.003));
  b.travel[0].speed = 0.01;
  CHECK(state_distance(rod, a, b) == Approx(0.004));
}

TEST_CASE("periodic: a motion returns when its joints do, not when its clamps look alike") {
  pipeline::Job job = simple_job();
  CHECK(returns(RobotPath(job)));
  job.motion.steps.back() = move_to(2 * pi);
  CHECK_FALSE(returns(RobotPath(job)));
}

TEST_CASE("periodic: a motion is repeated until two repeats begin alike, and the last counts") {
  pipeline::Job job = simple_job();  // the motion ends when the tool is back, while the hose still swings
  job.simulation.periodic_tolerance = 1e-4;
  const Simulation simulation(job);
  const Run r = run(simulation);
  REQUIRE(r.summary.periodic);
  REQUIRE(r.summary.repeats > 1);
  REQUIRE(r.begin.size() == static_cast<size_t>(r.summary.repeats - 1));
  CHECK(r.summary.distance == state_distance(simulation.rod(), r.begin.back(), r.end));
  CHECK(r.summary.distance <= 1e-4);
  for (size_t k = 0; k + 1 < r.begin.size(); ++k)
    CHECK(state_distance(simulation.rod(), r.begin[k], r.begin[k + 1]) > 1e-4);
  CHECK(static_cast<int>(r.times.size()) == simulation.description().samples);
  CHECK(r.times.front() == 0);
  CHECK_THAT(repeats_note(r.summary),
             Catch::Contains(fmt::format("note: the motion is periodic after {} repeats", r.summary.repeats)));
}

TEST_CASE("periodic: what never becomes periodic is run as often as allowed, and warned of") {
  pipeline::Job job = simple_job();
  job.simulation.periodic_tolerance = 1e-18;
  job.simulation.most_repeats = 2;
  const Simulation simulation(job);
  const Run r = run(simulation);
  CHECK_FALSE(r.summary.periodic);
  CHECK(r.summary.repeats == 2);
  CHECK_THAT(warnings_of(simulation, r.summary).front().line(),
             Catch::StartsWith("warning: after 2 repeats the motion still begins ") &&
                 Catch::Contains("simulation.periodic_tolerance_mm"));
}

TEST_CASE("periodic: a motion that does not return runs once, also if its time step is chosen") {
  pipeline::Job job = simple_job();
  job.motion.steps.pop_back();
  job.simulation.choose_time_step = true;
  const RunSummary summary = Simulation(job).run({[](const Sample&) {}});
  REQUIRE(std::abs(summary.time_step - first_step(job.simulation.sample_rate)) > 1e-4);  // a second run with this step
  CHECK(summary.repeats == 1);
  CHECK(repeats_note(summary).empty());
}

TEST_CASE("periodic: one that only rests is led in, then found periodic at once") {
  pipeline::Job job = simple_job();
  job.motion.steps.push_back(dwell_for(20));
  const Run r = run(Simulation(job));
  CHECK(r.summary.repeats == 2);
  CHECK(r.begin.size() == 1);
}

TEST_CASE("periodic: what the lead-in cannot do is reported by the motion itself") {
  pipeline::Job job = simple_job();  // wound once around a post, for which the hose is too short
  job.robot.joints[0].axis = {0, 0, 1};
  job.robot.links[0].capsules = {{{0, 0, 0}, {0, 0, 2}, 0.25}};
  job.dresspacks[0].routing.base_clamp = pipeline::Clamp{"bench", {-1, 0.35, 1}, {1, 0, 0}, {}, {}};
  job.dresspacks[0].routing.tool_clamp = pipeline::Clamp{"spindle", {0, 0.35, 0}, {1, 0, 0}, {}, {}};
  job.dresspacks[0].routing.free_length = 1.5;
  job.motion.steps = {move_to(0), move_to(-12, "wind up"), move_to(0, "home")};
  job.simulation.floor = false;
  const Simulation simulation(job);
  CHECK_THROWS_WITH(simulation.run({[](const Sample&) {}}),
                    Catch::Contains("pulled tight") && Catch::Contains("wind up"));
}

TEST_CASE("periodic: the repeat that leads in leaves the result that exact repeats give") {
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0, "start"), move_to(2, "turn"), dwell_for(0.52), move_to(0, "back")};
  job.motion.steps[1].duration = job.motion.steps[3].duration = 2;  // 4.52 s: a whole number of samples
  constexpr double forgotten = 1e-6;                                // [m]
  job.simulation.periodic_tolerance = forgotten;
  job.simulation.most_repeats = 40;
  const Run led = run(Simulation(job));
  REQUIRE(led.summary.periodic);
  pipeline::MotionStep block;  // forty repeats as one motion that runs only once, without a preceding repeat
  block.repeat = 40;
  block.steps.assign(job.motion.steps.begin() + 1, job.motion.steps.end());
  job.motion.steps = {move_to(0, "start"), block};
  job.simulation.most_repeats = 1;
  const Simulation simulation(job);
  const Run exact = run(simulation);
  CHECK(state_distance(simulation.rod(), led.end, exact.end) <
        10 * forgotten);  // a repeat reduces a difference to 1/10
}

TEST_CASE("periodic: a motion that does not return is run once") {
  pipeline::Job job = simple_job();
  job.motion.steps.back() = move_to(1);
  const Run r = run(Simulation(job));
  CHECK(r.summary.repeats == 1);
  CHECK_FALSE(r.summary.returns);
}

TEST_CASE("periodic: a wrist that turns by whole turns winds the hose and unwinds it") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].dresspack.bending_stiffness =
      20;  // nearly straight, does not loop: all of the wrist's rotation becomes twist
  job.dresspacks[0].dresspack.torsional_stiffness = 4;
  job.dresspacks[0].routing.free_length = 0.905;
  job.motion.steps = {move_to(0), move_to(2 * pi, "one turn"), move_to(-2 * pi, "and back"), move_to(0, "home"),
                      dwell_for(1)};
  const Simulation simulation(job);
  const Run r = run(simulation);
  const auto [least, most] = std::minmax_element(r.net_twist.begin(), r.net_twist.end());
  constexpr double sagging = 0.02;  // share of a turn that becomes bending of the slightly sagging hose
  CHECK(*most - *least == Approx(4 * pi).epsilon(sagging));
  const auto left = std::find_if(r.summary.checks.begin(), r.summary.checks.end(),
                                 [](const Check& c) { return c.name == "net twist left by a repeat"; });
  REQUIRE(left != r.summary.checks.end());
  CHECK(left->value == r.net_twist.back() - r.net_twist.front());
  // There is no friction that holds twist. Both ends of a periodic repeat agree to the tolerance's rotation of the surface.
  const double tolerance = job.simulation.periodic_tolerance / (job.dresspacks[0].dresspack.diameter / 2);
  CHECK(std::abs(left->value) < tolerance);
}

TEST_CASE("periodic: the same bits alone and beside other jobs in other threads") {
  pipeline::Job first = simple_job(), second = simple_job();
  first.robot.links[0].capsules = {{{0.45, -1, 0.85}, {0.45, 1, 0.85}, 0.1}};  // the hose touches a bar
  second.simulation.segments = 31;
  const Run alone = run(Simulation(first));
  Run beside;
  std::thread other([&] {
    for (int k = 0; k < 3; ++k) Simulation(second).run({[](const Sample&) {}});
  });
  std::thread again([&] {
    const Simulation simulation(first);
    beside.summary = simulation.run({[&](const Sample& s) { beside.end = s.state; }});
  });
  other.join();
  again.join();
  CHECK(beside.summary.repeats == alone.summary.repeats);
  CHECK(beside.end.position == alone.end.position);
  CHECK(beside.end.velocity == alone.end.velocity);
}

/// Returns a job whose hose swings in a loop of twenty rounds.
pipeline::Job job_of_loop() {
  pipeline::Job job = simple_job();
  pipeline::MotionStep loop;
  loop.repeat = 20;
  loop.steps = {move_to(2, "turn"), move_to(-1), move_to(1)};
  job.motion.steps = {move_to(0, "start"), loop, move_to(-2), move_to(0)};
  job.dresspacks[0].dresspack.damping_time = 0.1;
  job.robot.joints[0].axis = {0, 0, 1};
  job.robot.joints[0].origin = {0.05, 0, 1};
  job.dresspacks[0].routing.free_length = 1.3;
  job.simulation.most_repeats = 2;
  return job;
}

TEST_CASE("periodic: a lead-in without the later rounds of a loop ends where all rounds end") {
  pipeline::Job job = job_of_loop();
  const double tolerance = job.simulation.periodic_tolerance;
  std::vector<RodState> begin;                    // of the repeat after the lead-in
  std::vector<int> steps;                         // of the lead-in
  for (const double same : {tolerance, 1e-12}) {  // of the second no round is left out
    job.simulation.periodic_tolerance = same;
    steps.push_back(0);
    RunSinks sinks{[&](const Sample& sample) {
      if (sample.time == 0) begin.push_back(sample.state);
    }};
    sinks.goes_on = [&](double, bool leads_in) {
      steps.back() += leads_in ? 1 : 0;
      return true;
    };
    Simulation(job).run(sinks);
  }
  REQUIRE(begin.size() == 2);
  CHECK(steps[0] < steps[1] / 3);
  CHECK(state_distance(Simulation(job).rod(), begin[0], begin[1]) < tolerance);
}

TEST_CASE("periodic: checks without the later rounds of a loop are those of all rounds") {
  const Simulation simulation(job_of_loop());
  std::vector<std::vector<Check>> checks;
  std::vector<int> samples;
  for (const Wanted wanted : {Wanted::everything, Wanted::checks}) {
    int count = 0;
    double last = 0;
    RunSinks sinks{[&](const Sample& sample) {
      CHECK(sample.time >= last);
      last = sample.time;
      ++count;
    }};
    sinks.begin = [&](int) { count = 0, last = 0; };
    sinks.wanted = wanted;
    checks.push_back(simulation.run(sinks).checks);
    samples.push_back(count);
    CHECK(last == Approx(simulation.path().duration()).margin(0.05));
  }
  CHECK(samples[1] < samples[0] / 3);
  REQUIRE(checks[0].size() == checks[1].size());
  for (std::size_t k = 0; k < checks[0].size(); ++k) {
    INFO(checks[0][k].name);
    CHECK(checks[0][k].name == checks[1][k].name);
    if (checks[0][k].name == "smallest bend radius" || checks[0][k].name == "largest twist")
      CHECK(checks[1][k].value ==
            Approx(checks[0][k].value).epsilon(0.01));  // states of two rounds differ by up to 1 mm
  }
}

}  // namespace
}  // namespace dresslife::sim
