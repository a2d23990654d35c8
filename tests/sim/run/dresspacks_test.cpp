// Several dresspacks on one robot: far apart each moves as it would alone, and near each other they touch.
#include <algorithm>

#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/motion_file.h"
#include "sim/run/mounting.h"
#include "sim/run/routing.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

RodProperties hose_of(int segments, double length, double diameter, double stiffness) {
  RodProperties p;
  p.segments = segments;
  p.length = length;
  p.mass_per_length = 1000 * diameter * diameter;
  p.diameter = diameter;
  p.bending_stiffness = stiffness;
  p.torsional_stiffness = 0.8 * stiffness;
  p.axial_stiffness = 1e5;
  p.damping_time = 0.01;
  return p;
}

/// Returns a job with a spindle about x, 1 m above the floor. Both dresspacks lie along x.
std::string job_text(const std::string& dresspacks, const std::string& more = "") {
  return "robot:\n"
         "  name: spindle\n"
         "  source: made for the tests\n"
         "  joints:\n"
         "    - {name: spindle, origin_m: [0, 0, 1], axis: [1, 0, 0], lower_deg: -400, upper_deg: 400, "
         "speed_deg_per_s: 60,\n"
         "       acceleration_deg_per_s2: 120}\n"
         "  links: [{name: bench}, {name: spindle}]\n"
         "motion:\n"
         "  name: turn\n"
         "  steps: [{text: start, joints_deg: [0]}, {text: turn, joints_deg: [40]}, {text: back, joints_deg: "
         "[0]}]\n" +
         dresspacks + "simulation: {segments: 24, sample_rate_Hz: 50" + more + "}\n";
}

std::string hose_text(int diameter, double friction) {
  return fmt::format(
      "{{name: hose, source: made for the tests, diameter_mm: {}, mass_kg_per_m: 1.5,"
      " bending_stiffness_Nm2: 2, torsional_stiffness_Nm2: 1.6, axial_stiffness_N: 1e5, damping_time_ms: 20,"
      " damping_source: made for the tests, friction_coefficient: {}}}",
      diameter, friction);
}

/// Returns a routing along x at height `z` and lateral position `y`.
std::string routing_text(double length, double y, double z = 1) {
  return fmt::format(
      "{{free_length_m: {}, base_clamp: {{link: bench, position_m: [0, {}, {}], direction: [1, 0, 0]}}, "
      "tool_clamp: {{link: spindle, position_m: [1.1, {}, {}], direction: [1, 0, 0]}}}}",
      length, y, z, y, z - 1);
}

std::string item(const std::string& name, const std::string& hose, const std::string& routing) {
  return fmt::format("  - name: {}\n    dresspack: {}\n    routing: {}\n", name, hose, routing);
}

struct Run {
  std::unique_ptr<Simulation> simulation;
  std::vector<RodState> states;
  RunSummary summary;
};

Run run(const std::string& text) {
  const pipeline::Job job = pipeline::job_from(pipeline::parse_yaml(text, "job.yaml"));
  Run result{std::make_unique<Simulation>(job), {}, {}};
  result.summary = result.simulation->run(
      {[&](const Sample& s) { result.states.push_back(s.state); }, [&](int) { result.states.clear(); }});
  return result;
}

std::string message_of(const std::string& text) {
  return pipeline::message_of([&] { run(text); });
}

}  // namespace

TEST_CASE("two dresspacks far apart move as each does in a world of its own") {
  const RodProperties p = hose_of(20, 1.2, 0.06, 5), q = hose_of(13, 0.7, 0.02, 0.2);
  const Rod both({p, q}, {0, 1}), first(p), second(q);
  const auto clamps_of = [](double t, double y) {
    const double s = std::sin(3 * t + y);
    Frame base = rolled(planar_frame(0.1 * s, 0.2 * s, 0.4 * s), 0.8 * s), tool = base;
    tool.position.x() += 0.5;
    base.position.y() += y, tool.position.y() += y;
    return ClampFrames{base, tool};
  };
  const Equilibrium a = find_equilibrium(first, clamps_of(0, 0)), b = find_equilibrium(second, clamps_of(0, 2));
  REQUIRE(a.status == EquilibriumStatus::converged);
  REQUIRE(b.status == EquilibriumStatus::converged);
  WorldSettings settings;
  settings.self_contact = true;
  World whole(both, settings, joined(both, {a.state, b.state})), one(first, settings, a.state),
      other(second, settings, b.state);
  for (int k = 1; k <= 400; ++k) {
    const double t = 0.005 * k;
    const ClampFrames of_a = clamps_of(t, 0), of_b = clamps_of(t, 2);
    REQUIRE(whole.advance({of_a.base, of_b.tool, {of_a.tool, of_b.base}}).finite);
    one.advance(of_a);
    other.advance(of_b);
  }
  const double rounding = 1e-12;  // equal operations; only the order of the bodies in the world differs
  CHECK(furthest(whole.state(), 0, one.state()) < rounding);
  CHECK(furthest(whole.state(), 20, other.state()) < rounding);
  CHECK(both.dresspacks() == 2);
  CHECK(both.first_span(1) == 1);
  CHECK(both.first_span(2) == 2);
  CHECK(both.link_arc(21) == 0);
  CHECK(clamp_segments(both) == std::vector<int>{0, 20, 20, 33});
  CHECK(listed_clamps(both, whole.state().clamps).size() == 4);
}

TEST_CASE("a dresspack laid across another is held by it and takes from it what it gives") {
  // Both are without weight and so taut that they are straight. The clamps of the second, above, move down until it would lie
  // 0.2 m below the first.
  RodProperties p = hose_of(24, 1.05, 0.04, 1), q = hose_of(30, 1.1, 0.025, 0.3);
  p.gravity.setZero(), q.gravity.setZero();
  const Rod both({p, q}, {0, 1}), first(p), second(q);
  const ClampFrames along{planar_frame(-0.5, 0, 0), planar_frame(0.5, 0, 0)};
  const Quaternion quarter(Eigen::AngleAxisd(pi / 2, Vector3::UnitZ()));
  const auto across = [&](double z) {
    Frame base = planar_frame(0, 0, 0);
    base.orientation = quarter * base.orientation;
    Frame tool = base;
    base.position = {0.03, -0.5, z}, tool.position = {0.03, 0.5, z};
    return ClampFrames{base, tool};
  };
  const double above = 0.4, below = -0.2;
  const Equilibrium a = find_equilibrium(first, along), b = find_equilibrium(second, across(above));
  REQUIRE(a.status == EquilibriumStatus::converged);
  REQUIRE(b.status == EquilibriumStatus::converged);
  WorldSettings settings;
  settings.self_contact = true;
  settings.frictions = {0.4, 0.1};
  World world(both, settings, joined(both, {a.state, b.state}));
  const auto momentum = [&](int dresspack) {
    Vector3 sum = Vector3::Zero();
    const Span& span = both.spans()[dresspack];
    for (int i = 0; i < span.segments(); ++i) sum += span.segment_mass * world.state().velocity[span.first_segment + i];
    return sum;
  };
  const auto pull = [&](int dresspack) {
    const Span& span = both.spans()[dresspack];
    return Vector3(world.state().link_force[span.last_link()] - world.state().link_force[span.first_link]);
  };
  const double h = settings.time_step;
  double unexplained = 0, difference = 0, hardest = 0, depth = 0, exchanged = 0;
  for (int k = 1; k <= 600; ++k) {
    const ClampFrames now = across(above + (below - above) * smooth(k * h / 2.5));
    const Vector3 before[] = {momentum(0), momentum(1)};
    const StepReport report = world.advance({along.base, now.tool, {along.tool, now.base}});
    REQUIRE(report.finite);
    depth = std::max(depth, report.max_depth);
    Vector3 given = Vector3::Zero();  // impulse on the first by the contacts
    for (const Contact& contact : world.contacts()) {
      REQUIRE(contact.obstacle == hose_obstacle);
      CHECK(contact.friction == 0.1);  // the smaller of both coefficients
      CHECK((contact.segment < 24 && contact.other >= 24));
      given += contact.normal_force * contact.normal + contact.friction_force;
      hardest = std::max(hardest, contact.normal_force);
    }
    const Vector3 to_first = momentum(0) - before[0] - h * pull(0), to_second = momentum(1) - before[1] - h * pull(1);
    unexplained = std::max(unexplained, (to_first + to_second).norm());
    difference = std::max(difference, (to_first - h * given).norm());
    exchanged = std::max(exchanged, to_first.norm());
  }
  INFO("unexplained " << unexplained << " of " << exchanged << " N s, hardest " << hardest << " N, deepest " << depth);
  const double rounding = 1e-11;  // [N s] as in self_contact_test.cpp
  CHECK(unexplained < rounding);
  CHECK(difference < rounding);
  CHECK(hardest > 1);
  CHECK(depth < 1e-3);
  // The second still rests on the first, although its ends are 0.2 m lower.
  double crossing_first = 0, crossing_second = 0, near_first = 1, near_second = 1;
  for (int i = 0; i < both.segments(); ++i) {
    const Vector3& x = world.state().position[i];
    const bool is_first = i < 24;
    const double away = is_first ? std::abs(x.x() - 0.03) : std::abs(x.y());
    double& near = is_first ? near_first : near_second;
    if (away < near) near = away, (is_first ? crossing_first : crossing_second) = x.z();
  }
  CHECK(crossing_second > crossing_first + 0.02);
  CHECK(crossing_first < -0.01);
}

TEST_CASE("dresspacks of a job far apart move as in jobs of their own") {
  const std::string thick = hose_text(40, 0.3), thin = hose_text(20, 0.2);
  const std::string here = routing_text(1.3, 0), there = routing_text(1.2, 0.6);
  const std::string once = ", most_repeats: 1";
  const Run both = run(job_text("dresspacks:\n" + item("hose", thick, here) + item("dress cable", thin, there), once));
  const Run first = run(job_text("dresspack: " + thick + "\nrouting: " + here + "\n", once));
  const Run second = run(job_text("dresspack: " + thin + "\nrouting: " + there + "\n", once));
  REQUIRE(both.states.size() == first.states.size());
  double apart = 0, span = 0;
  for (size_t k = 0; k < both.states.size(); ++k)
    for (int i = 0; i < 24; ++i) {
      apart = std::max(apart, (both.states[k].position[i] - first.states[k].position[i]).norm());
      apart = std::max(apart, (both.states[k].position[24 + i] - second.states[k].position[i]).norm());
      span = std::max(span, (both.states[k].position[24 + i] - both.states[0].position[24 + i]).norm());
    }
  const double alike =
      2e-4;  // [m]: settling ends when all dresspacks are slower than 0.01 mm/s; their rest is not a single point
  CHECK(apart < alike);
  CHECK(span > 0.1);
  CHECK(both.simulation->description().dresspacks == std::vector<std::string>{"hose", "dress cable"});
  CHECK(both.simulation->description().dresspack[23] == 0);
  CHECK(both.simulation->description().dresspack[24] == 1);
  // The checks of each dresspack are those of its own job.
  const auto value = [](const Run& of, const std::string& name, int dresspack) {
    for (const Check& check : of.summary.checks)
      if (check.name == name && check.dresspack == dresspack) return check.value;
    throw std::logic_error("no check " + name);
  };
  for (const char* name : {"smallest bend radius", "largest tension", "most slack", "largest net twist"}) {
    CAPTURE(name);
    const double rest = 2e-2;  // of the value: the rest of settling, as above
    CHECK(value(both, name, 0) == Approx(value(first, name, 0)).epsilon(rest));
    CHECK(value(both, name, 1) == Approx(value(second, name, 0)).epsilon(rest));
  }
  CHECK(value(both, "most slack", 0) == Approx(0.2).epsilon(1e-6));
}

TEST_CASE("dresspacks of a job that would hang through each other are mounted side by side") {
  // The second is clamped 30 mm beside the first, closer than the sum of their radii at the clamps, and is longer: it hangs
  // around the first.
  const std::string beside = "dresspacks:\n" + item("hose", hose_text(40, 0.3), routing_text(1.3, 0)) +
                             item("dress cable", hose_text(20, 0.2), routing_text(1.3, 0.032, 1.0));
  const Run both = run(job_text(beside, ", most_repeats: 1"));
  double least = 1;
  for (const RodState& state : both.states)
    for (int i = 0; i < 24; ++i)
      for (int j = 24; j < 48; ++j) least = std::min(least, (state.position[i] - state.position[j]).norm());
  CHECK(least > 0.029);
  // An impossible arrangement is reported: both in the same place.
  const std::string message =
      message_of(job_text("dresspacks:\n" + item("hose", hose_text(40, 0.3), routing_text(1.3, 0)) +
                          item("dress cable", hose_text(20, 0.2), routing_text(1.3, 0))));
  CHECK_THAT(message, Catch::Contains("error: dresspack 'dress cable' runs ") &&
                          Catch::Contains(" mm deep through dresspack 'hose' in the mounting pose"));
}

TEST_CASE("messages and warnings name the dresspack among several") {
  const std::string hose = item("hose", hose_text(40, 0.3), routing_text(1.3, 0));
  const std::string too_short =
      message_of(job_text("dresspacks:\n" + hose + item("dress cable", hose_text(20, 0.2), routing_text(1, 0.6))));
  CHECK_THAT(too_short, Catch::Contains("job.yaml:17:14: error: dresspack 'dress cable' is 174.1 mm too short at "));
  const Run both = run(job_text(
      "dresspacks:\n" + hose + item("dress cable", hose_text(60, 0.2), routing_text(2.4, 0.6)), ", most_repeats: 1"));
  std::string told;
  for (const pipeline::Warning& warning : warnings_of(*both.simulation, both.summary)) told += warning.line() + "\n";
  CHECK_THAT(told, Catch::Contains("warning: dress cable, smallest bend radius: ") &&
                       Catch::Contains("warning: dress cable, least slack, length too long: ") &&
                       !Catch::Contains("warning: hose, least slack"));
}

TEST_CASE("a retraction unit and a ring belong to their dresspack") {
  const std::string unit =
      "{free_length_m: 1.2, base_clamp: {link: bench, position_m: [0, 0.6, 1], direction: [1, 0, 0]}, "
      "tool_clamp: {link: spindle, position_m: [1.25, 0.6, 0], direction: [1, 0, 0]}, "
      "retraction: {force_N: 10, spring_N_per_m: 40, stroke_m: 0.5, damping_Ns_per_m: 20}, "
      "rings: [{link: bench, position_m: [0.7, 0.6, 1.02], direction: [1, 0, 0], radius_mm: 24, width_mm: "
      "20}]}";
  const std::string text = job_text("dresspacks:\n" + item("hose", hose_text(40, 0.3), routing_text(1.3, 0)) +
                                        item("drawn", hose_text(20, 0.2), unit),
                                    ", most_repeats: 1");
  const pipeline::Scratch scratch;
  const pipeline::Job job = pipeline::job_from(pipeline::parse_yaml(text, "job.yaml"));
  REQUIRE(routed_rings(job).size() == 1);
  CHECK(routed_rings(job)[0].span == 1);
  const Simulation simulation(job);
  {
    pipeline::FileWriter file(scratch / "motion.h5", pipeline::motion_format());
    MotionFile motion(file, simulation.description());
    double drawn = 0;
    const RunSummary summary = simulation.run({[&](const Sample& sample) {
      motion.add(sample);
      REQUIRE(sample.travel.size() == 2);
      CHECK(sample.travel[0] == 0);
      drawn = std::max(drawn, sample.travel[1]);
      const SpanAxis axis(sample.state, simulation.rod().spans()[1]);
      const Vector3 centre(0.7, 0.6, 1.02);
      CHECK((axis.at(axis.nearest(centre, 12)).position - centre).norm() < 0.016);  // 14 mm clear
    }});
    CHECK(drawn > 0.05);
    motion.finish(summary, [&](double time) { return simulation.path().step(time); });
    for (const char* text_attribute : {"job", "history", "input_sha256"}) file.attribute(text_attribute, "");
    file.commit();
  }
  const pipeline::FileReader file(scratch / "motion.h5", pipeline::motion_format());
  CHECK(pipeline::dresspack_names(file) == std::vector<std::string>{"hose", "drawn"});
  CHECK(file.length("dresspack") == 2);
  const auto spans = pipeline::motion_spans(file);
  REQUIRE(spans.size() == 2);
  CHECK(spans[1].dresspack == 1);
  CHECK(spans[1].first_segment == 24);
  CHECK(spans[1].segments == 24);
  CHECK(spans[1].base_clamp == 2);
  CHECK(spans[1].tool_clamp == 3);
  const auto of_check = file.read<std::int32_t>("/check/dresspack");
  CHECK(std::count(of_check.begin(), of_check.end(), 1) ==
        std::count(of_check.begin(), of_check.end(), 0) + 1);  // the travel
}
