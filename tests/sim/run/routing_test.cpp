// Routing of a job: clamps, rings, retraction, delivered shape, pre-twist, a free end; each from YAML to samples.
#include "sim/run/routing.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "pipeline/base/constants.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

/// Returns a job with a spindle 1 m above the floor that turns about `joint_axis`. The clamps lie along x.
std::string job_text(const std::string& routing, const std::string& more = "",
                     const std::string& joint_axis = "[1, 0, 0]", const std::string& dresspack = "",
                     int segments = 40) {
  return "robot:\n"
         "  name: spindle\n"
         "  source: made for the tests\n"
         "  joints:\n"
         "    - {name: spindle, origin_m: [0, 0, 1], axis: " +
         joint_axis +
         ", lower_deg: -400, upper_deg: 400, speed_deg_per_s: 60,\n"
         "       acceleration_deg_per_s2: 120}\n"
         "  links: [{name: bench}, {name: spindle}]\n"
         "motion:\n"
         "  name: turn\n"
         "  steps: [{text: start, joints_deg: [0]}, {text: turn, joints_deg: [40]}, {text: back, joints_deg: "
         "[0]}]\n"
         "dresspack: {name: hose, source: made for the tests, diameter_mm: 40, mass_kg_per_m: 1.5,\n"
         "  bending_stiffness_Nm2: 2, torsional_stiffness_Nm2: 1.6, axial_stiffness_N: 1e5, damping_time_ms: "
         "20,\n"
         "  damping_source: made for the tests, friction_coefficient: 0.3" +
         dresspack + "}\nrouting:\n" + routing + "simulation: {segments: " + std::to_string(segments) +
         ", sample_rate_Hz: 50" + more + "}\n";
}

const std::string ends =
    "  free_length_m: 1.3\n"
    "  base_clamp: {link: bench, position_m: [0, 0, 1], direction: [1, 0, 0]}\n"
    "  tool_clamp: {link: spindle, position_m: [1.1, 0, 0], direction: [1, 0, 0]}\n";

struct Row {
  double time;
  RodState state;
  std::vector<Frame> clamps;
  std::vector<double> travel;
  Energy energy;
  std::vector<std::string> obstacles;
  std::vector<double> largest_force;
};

struct Run {
  std::unique_ptr<Simulation> simulation;
  std::vector<Row> rows;
  RunSummary summary;

  const Check& check(const std::string& name) const {
    for (const Check& one : summary.checks)
      if (one.name == name) return one;
    throw std::logic_error("no check " + name);
  }
};

Run run(const std::string& text, const std::filesystem::path& folder = {}) {
  const pipeline::Scratch scratch;
  const auto file = (folder.empty() ? std::filesystem::path(scratch / "job.yaml") : folder / "job.yaml");
  std::ofstream(file) << text;
  Run result{std::make_unique<Simulation>(pipeline::read_job(file)), {}, {}};
  result.summary = result.simulation->run({[&](const Sample& s) {
                                             result.rows.push_back({s.time, s.state, s.clamps, s.travel, s.energy,
                                                                    s.touch.obstacles(), s.touch.largest_force()});
                                           },
                                           [&](int) { result.rows.clear(); }});
  return result;
}

/// Returns the largest difference of positions [m] and quaternions.
double furthest(const RodState& a, const RodState& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    most = std::max(
        {most, (a.position[i] - b.position[i]).norm(), (a.orientation[i].coeffs() - b.orientation[i].coeffs()).norm()});
  return most;
}

double twist_of(const Rod& rod, const RodState& state, const Span& span) {
  double twist = 0;
  for (int j = span.first_link; j <= span.last_link(); ++j) twist += rod.link_state(state, j).turn.z();
  return twist;
}

std::string message_of(const std::string& text) {
  return pipeline::message_of([&] { run(text); });
}

}  // namespace

TEST_CASE("routing: a clamp in the middle is held where the job says and parts the dresspack in two") {
  const Run both = run(job_text(
      ends + "  clamps: [{link: spindle, position_m: [0.5, 0, 0], direction: [1, 0, 0], at_length_m: 0.65}]\n"));
  const Rod& rod = both.simulation->rod();
  REQUIRE(rod.spans().size() == 2);
  CHECK(rod.spans()[0].segments() == 20);
  CHECK(both.simulation->description().clamp_segment == std::vector<int>{0, 20, 40});
  // Both clamps of the second span, and one clamp of the first span, turn with the spindle.
  for (const Row& row : both.rows) {
    REQUIRE(row.clamps.size() == 3);
    CHECK((row.clamps[1].position - Vector3(0.5, 0, 1)).norm() < 1e-12);
  }
  const double free_of_twist = 1e-3;  // [rad]: settling ends at 0.01 mm/s, not completely at rest
  CHECK(std::abs(twist_of(rod, both.rows[0].state, rod.spans()[0])) < free_of_twist);
  CHECK(std::abs(twist_of(rod, both.rows[0].state, rod.spans()[1])) < free_of_twist);
  double most = 0;
  for (const Row& row : both.rows) {
    most = std::max(most, std::abs(twist_of(rod, row.state, rod.spans()[0])));
    CHECK(std::abs(twist_of(rod, row.state, rod.spans()[1])) < 0.1);
  }
  CHECK(most > 0.3);  // of 0.7 rad; the rest becomes bending to the side
  // The first span as a dresspack alone.
  const Run first =
      run(job_text("  free_length_m: 0.65\n"
                   "  base_clamp: {link: bench, position_m: [0, 0, 1], direction: [1, 0, 0]}\n"
                   "  tool_clamp: {link: spindle, position_m: [0.5, 0, 0], direction: [1, 0, 0]}\n",
                   "", "[1, 0, 0]", "", 20));
  REQUIRE(first.rows.size() == both.rows.size());
  double apart = 0;
  for (size_t k = 0; k < first.rows.size(); ++k)
    for (int i = 0; i < 20; ++i)
      apart = std::max(apart, (first.rows[k].state.position[i] - both.rows[k].state.position[i]).norm());
  const double alike =
      2e-4;  // [m]: settling ends when both spans are slower than 0.01 mm/s; their rest is not a single point
  CHECK(apart < alike);
}

TEST_CASE("routing: a span that is too short or pulled tight is named") {
  const std::string short_span = message_of(job_text(
      ends + "  clamps: [{link: spindle, position_m: [0.5, 0, 0], direction: [1, 0, 0], at_length_m: 0.45}]\n"));
  CHECK_THAT(short_span, Catch::Contains("dresspack is 50.0 mm too short at ") &&
                             Catch::Contains("its length between the base clamp and clamp 1 is 0.45"));
}

TEST_CASE("routing: pre-twist is what it says on top of a mounting free of twist") {
  std::string straight = ends;
  straight.replace(straight.find("1.3"), 3, "1.1");  // straight, so that bending takes no part of the rotation
  const std::string once = ", most_repeats: 1";
  const Run twisted = run(job_text(straight + "  pre_twist_deg: 400\n", once));
  const Rod& rod = twisted.simulation->rod();
  const double sag = 0.01;  // its weight still bends it, which takes up twist as writhe
  CHECK(twist_of(rod, twisted.rows[0].state, rod.spans()[0]) == Approx(400 * pi / 180).epsilon(sag));
  CHECK(std::abs(twist_of(rod, run(job_text(straight, once)).rows[0].state, rod.spans()[0])) < 1e-3);
}

TEST_CASE("routing: a hose laid in the shape in which it was delivered is free of load") {
  // An arc of radius 0.8 m, upward from the base clamp, toward the clamp's x axis. Without gravity there is no force.
  const double curvature = 1.25, length = 1.0, angle = curvature * length;
  const double x = std::sin(angle) / curvature, z = (1 - std::cos(angle)) / curvature;
  const auto routing = [&](const std::string& roll) {
    return fmt::format(
        "  free_length_m: {}\n"
        "  base_clamp: {{link: bench, position_m: [0, 0, 1], direction: [1, 0, 0]{}}}\n"
        "  tool_clamp: {{link: bench, position_m: [{:.15g}, 0, {:.15g}], direction: [{:.15g}, 0, "
        "{:.15g}]}}\n",
        length, roll, x, 1 + z, std::cos(angle), std::sin(angle));
  };
  const std::string weightless = ", gravity_m_per_s2: [0, 0, 0], contact: false, most_repeats: 1";
  const Run delivered = run(job_text(routing(""), weightless, "[1, 0, 0]", ", rest_curvature_1_per_m: 1.25"));
  // Error of chords against an arc: (0.025 curvature)^2/24 of the length, times EA in a hose without slack.
  const double chords = 1e-2;  // [J] against 1.56 J of the straight hose
  CHECK(delivered.rows[0].energy.elastic < chords);
  const Run turned =
      run(job_text(routing(", roll_deg: 180"), weightless, "[1, 0, 0]", ", rest_curvature_1_per_m: 1.25"));
  // Bent against its delivered shape: EI (2 curvature)^2/2 per length, unless it escapes sideways.
  CHECK(turned.rows[0].energy.elastic > 50 * delivered.rows[0].energy.elastic);
  const Run straight = run(job_text(routing(""), weightless));
  CHECK(straight.rows[0].energy.elastic == Approx(0.5 * 2 * curvature * curvature * length).epsilon(0.01));
}

TEST_CASE("routing: a retraction unit lets the hose out and takes it back and says when its stroke is used up") {
  // The spindle turns about y and moves the tool clamp: at 0 the distance is 1.3 m, 0.1 m more than the hose's length.
  const auto routing = [](double stroke) {
    return fmt::format(
        "  free_length_m: 1.2\n"
        "  base_clamp: {{link: bench, position_m: [0, 0, 1.4], direction: [1, 0, 0]}}\n"
        "  tool_clamp: {{link: spindle, position_m: [1.3, 0, 0.4], direction: [1, 0, 0]}}\n"
        "  retraction: {{force_N: 15, spring_N_per_m: 50, stroke_m: {}, damping_Ns_per_m: 20, mass_kg: "
        "0.8}}\n",
        stroke);
  };
  const Run roomy = run(job_text(routing(0.6), "", "[0, 1, 0]"));
  double least = 1, most = 0;
  for (const Row& row : roomy.rows) {
    REQUIRE(row.travel.size() == 1);
    least = std::min(least, row.travel[0]), most = std::max(most, row.travel[0]);
    CHECK((row.clamps[0].position - Vector3(row.travel[0], 0, 1.4)).norm() < 1e-12);
  }
  CHECK(most > least + 0.05);
  CHECK(roomy.check("travel of the retraction unit").value == Approx(most).epsilon(0.02));
  CHECK_FALSE(roomy.check("travel of the retraction unit").warning);
  // At rest the spring holds the hose.
  const Row& rest = roomy.rows.front();
  CHECK(rest.state.link_force[0].x() == Approx(15 + 50 * rest.travel[0]).margin(0.5));
  const Run tight = run(job_text(routing(most - 0.01), "", "[0, 1, 0]"));
  CHECK(tight.check("travel of the retraction unit").warning);
  bool told = false;
  for (const pipeline::Warning& warning : warnings_of(*tight.simulation, tight.summary))
    told |= warning.words.starts_with("travel of the retraction unit") &&
            warning.words.find("program step") != std::string::npos;
  CHECK(told);
}

TEST_CASE("routing: a dresspack with a free end hangs and rings down as its damping says") {
  // Moved down and stopped: the motion afterwards is the decay test by which damping is measured.
  const Run hung =
      run(job_text("  free_length_m: 0.8\n"
                   "  base_clamp: {link: spindle, position_m: [0, 0, 0], direction: [0, 0, -1]}\n"
                   "  tool_end: free\n"
                   "  tool_mass_kg: 2\n",
                   ", most_repeats: 1", "[1, 0, 0]"));
  const Rod& rod = hung.simulation->rod();
  const RodState& start = hung.rows.front().state;
  CHECK((rod.tip(start) - Vector3(0, 0, 0.2)).norm() < 1e-3);  // 1 m above the floor, 0.8 m long, stretched by 0.2 mm
  CHECK((hung.rows.front().clamps.back().position - rod.tip(start)).norm() < 1e-12);
  double aside = 0;
  for (const Row& row : hung.rows) aside = std::max(aside, std::abs(rod.tip(row.state).y()));
  CHECK(aside > 0.1);
  CHECK_THROWS_AS(hung.check("least slack, length too short"), std::logic_error);
}

TEST_CASE("routing: a dresspack is led by a ring that the job describes") {
  const Run led =
      run(job_text(ends + "  rings: [{link: bench, position_m: [0.5, 0, 1.1], direction: [1, 0, 0], radius_mm: 24, "
                          "friction_coefficient: 0.2, width_mm: 20}]\n"));
  const Rod& rod = led.simulation->rod();
  CHECK(rod.spans().size() == 1);
  for (const Row& row : led.rows) {
    const SpanAxis axis(row.state, rod.spans()[0]);
    const Vector3 near = axis.at(axis.nearest({0.5, 0, 1.1}, 18)).position;
    CHECK((near - Vector3(0.5, 0, 1.1)).norm() < 0.005);  // 4 mm clear, and a millimetre of overlap
  }
  const Row& last = led.rows.back();
  const auto ring = std::find(last.obstacles.begin(), last.obstacles.end(), "ring 1");
  REQUIRE(ring != last.obstacles.end());
  double force = 0;
  for (int i = 0; i < rod.segments(); ++i)
    force = std::max(force, last.largest_force[i * last.obstacles.size() + (ring - last.obstacles.begin())]);
  CHECK(force > 1);
  // Slack: the length minus the distance over the ring, in which the hose may be off-centre by the 4 mm.
  const double way = std::hypot(0.5, 0.1) + std::hypot(0.6, 0.1) - 2 * 0.004;
  CHECK(led.check("least slack, length too short").value == Approx(1.3 - way));
}

TEST_CASE("routing: boxes and meshes of links and of the cell are obstacles from the job file on") {
  const pipeline::Scratch scratch;
  std::ofstream(scratch / "post.obj") << "v -0.05 -0.5 0\nv 0.05 -0.5 0\nv 0.05 0.5 0\nv -0.05 0.5 0\n"
                                         "v -0.05 -0.5 0.85\nv 0.05 -0.5 0.85\nv 0.05 0.5 0.85\nv -0.05 0.5 0.85\n"
                                         "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\n"
                                         "f 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
  const auto lowest = [&](const std::string& cell, const std::string& link) {
    std::string text = job_text(ends, ", most_repeats: 1", "[1, 0, 0]", "", 24);
    text.replace(text.find("{name: bench}"), 13, "{name: bench" + link + "}");
    const Run done = run(text + cell, (scratch / "job.yaml").parent_path());
    std::vector<double> pressed(done.rows.back().obstacles.size(), 0.0);
    for (size_t k = 0; k < done.rows.back().largest_force.size(); ++k)
      pressed[k % pressed.size()] = std::max(pressed[k % pressed.size()], done.rows.back().largest_force[k]);
    double z = 1;
    for (const Vector3& x : done.rows[0].state.position) z = std::min(z, x.z());
    return std::tuple(z, pressed, done.rows.back().obstacles, done.check("deepest contact").value);
  };
  const auto [free_z, nothing, names, none] = lowest("", "");
  CHECK(free_z < 0.86);
  CHECK(*std::max_element(nothing.begin(), nothing.end()) == 0);
  const double deepest = 1e-3;
  const std::vector<std::pair<std::string, std::string>> shapes = {
      {"cell: {boxes: [{position_m: [0.55, 0, 0.425], sides_m: [0.1, 1, 0.85]}]}\n", ""},
      {"cell: {meshes: [{file: post.obj, position_m: [0.55, 0, 0]}]}\n", ""},
      {"cell: {capsules: [{from_m: [0.55, -1, 0.55], to_m: [0.55, 1, 0.55], radius_mm: 300}]}\n", ""},
      {"", ", boxes: [{position_m: [0.55, 0, 0.425], sides_m: [0.1, 1, 0.85]}]"},
      {"", ", meshes: [{file: post.obj, position_m: [0.55, 0, 0]}]"}};
  for (const auto& [cell, link] : shapes) {
    CAPTURE(cell, link);
    const auto [z, pressed, obstacles, depth] = lowest(cell, link);
    CHECK(z > free_z + 0.05);  // it lies over an edge at 0.85 m
    const auto at = std::find(obstacles.begin(), obstacles.end(), cell.empty() ? "bench" : "cell") - obstacles.begin();
    CHECK(pressed[at] > 1);
    CHECK(depth < deepest);
  }
}

TEST_CASE("routing: what a job says of it is echoed and reads back") {
  const pipeline::Scratch scratch;
  const std::string hung =
      "  free_length_m: 1.3\n"
      "  base_clamp: {link: bench, position_m: [0, 0, 1], direction: [1, 0, 0]}\n"
      "  clamps: [{link: bench, position_m: [0.5, 0, 1], direction: [1, 0, 0], at_length_m: 0.6, roll_deg: "
      "20}]\n"
      "  rings: [{link: bench, position_m: [0.3, 0, 1], direction: [1, 0, 0], radius_mm: 25, at_length_m: "
      "0.4}]\n"
      "  retraction: {force_N: 20, stroke_m: 0.3}\n"
      "  tool_end: free\n"
      "  tool_mass_kg: 1.5\n";
  std::ofstream(scratch / "job.yaml") << job_text(hung, "", "[1, 0, 0]", ", rest_curvature_1_per_m: 0.5");
  const pipeline::Job job = pipeline::read_job(scratch / "job.yaml");
  CHECK(job.dresspacks[0].routing.clamps[0].clamp.roll == 20 * pi / 180);
  CHECK(job.dresspacks[0].routing.rings[0].radius == 25 * 1e-3);
  CHECK(job.dresspacks[0].routing.retraction->mass == 1);
  CHECK(job.dresspacks[0].dresspack.rest_curvature == 0.5);
  const std::string text = pipeline::job_text(job);
  CHECK(pipeline::job_text(pipeline::job_from(pipeline::parse_yaml(text, "echo"))) == text);
  const Rod rod = rod_of(job);
  REQUIRE(rod.spans().size() == 2);
  CHECK(rod.spans()[0].segments() == 18);  // its share of 40 segments over 1.3 m
  CHECK(rod.spans()[0].properties.slider->force == 20);
  CHECK(rod.spans()[1].properties.tip_mass == 1.5);
  REQUIRE(routed_rings(job).size() == 1);
  CHECK(routed_rings(job)[0].span == 0);
}

TEST_CASE("routing: the guided example rests on the forearm and in its ring") {
  const pipeline::Job job = pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_guided.yaml",
                                               {"simulation.most_repeats=1", "simulation.segments=40"});
  const Simulation simulation(job);
  std::vector<std::string> names;
  std::vector<double> force;
  double depth = 0;
  simulation.run({[&](const Sample& s) {
    names = s.touch.obstacles(), force = s.touch.largest_force();
    depth = std::max(depth, s.max_depth);
  }});
  const auto hardest = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    double most = 0;
    for (size_t k = at; k < force.size(); k += names.size()) most = std::max(most, force[k]);
    return most;
  };
  CHECK(hardest("link_4") > 1);
  CHECK(hardest("ring 1") > 10);
  CHECK(depth < 1e-3);
}

namespace {

/// Returns `ends` with a bend relief at each of its clamps and at one in between.
std::string with_reliefs(const std::string& base, const std::string& between, const std::string& tool) {
  return "  free_length_m: 1.3\n"
         "  base_clamp: {link: bench, position_m: [0, 0, 1], direction: [1, 0, 0]" +
         base +
         "}\n"
         "  clamps: [{link: bench, position_m: [0.5, 0, 1], direction: [1, 0, 0], at_length_m: 0.65" +
         between +
         "}]\n"
         "  tool_clamp: {link: spindle, position_m: [1.1, 0, 0], direction: [1, 0, 0]" +
         tool + "}\n";
}
std::string relief_text(const std::string& length, const std::string& stiffness) {
  return ", bend_relief: {length_mm: " + length + ", bending_stiffness_Nm2: " + stiffness + "}";
}

}  // namespace

TEST_CASE("routing: bend reliefs stiffen the links beside their clamps, on both sides of one in between") {
  const pipeline::Scratch scratch;
  const auto job_of = [&](const std::string& routing) {
    std::ofstream(scratch / "job.yaml") << job_text(routing);
    return pipeline::read_job(scratch / "job.yaml");
  };
  const pipeline::Job job = job_of(with_reliefs(relief_text("130", "6"), relief_text("97.5", "10"), ""));
  const std::string text = pipeline::job_text(job);
  CHECK(pipeline::job_text(pipeline::job_from(pipeline::parse_yaml(text, "echo"))) == text);
  const Rod rod = rod_of(job), bare = rod_of(job_of(with_reliefs("", "", "")));
  REQUIRE(rod.links() == 42);  // two spans of 20 segments of 32.5 mm
  const auto factor = [&](int link) { return rod.turn_stiffness(link)[0] / bare.turn_stiffness(link)[0]; };
  const double half_covered = 1 / (0.5 + 0.5 * 2 / (2 + 6.0)), half_between = 1 / (0.5 + 0.5 * 2 / (2 + 10.0));
  for (int link = 0; link < 4; ++link) CHECK(factor(link) == Approx(4));  // (2 + 6)/2
  CHECK(factor(4) == Approx(half_covered));
  for (int link = 5; link < 17; ++link) CHECK(factor(link) == 1);
  for (const int link : {17, 24}) CHECK(factor(link) == Approx(half_between));
  for (int link = 18; link < 24; ++link) CHECK(factor(link) == Approx(6));
  for (int link = 25; link < 42; ++link) CHECK(factor(link) == 1);
  for (int link = 0; link < 42; ++link) CHECK(rod.turn_stiffness(link)[2] == bare.turn_stiffness(link)[2]);
}

TEST_CASE("routing: a bend relief lessens the bend, and changes no bit without length or stiffness") {
  const auto routing = [](const std::string& relief) {
    return "  free_length_m: 1.3\n"
           "  base_clamp: {link: bench, position_m: [0, 0, 1], direction: [1, 0, 0.8]" +
           relief +
           "}\n"
           "  tool_clamp: {link: spindle, position_m: [1.1, 0, 0], direction: [1, 0, 0]" +
           relief + "}\n";
  };
  const auto same = [](const Run& a, const Run& b) {
    if (a.rows.size() != b.rows.size()) return false;
    for (std::size_t t = 0; t < a.rows.size(); ++t)
      if (furthest(a.rows[t].state, b.rows[t].state) != 0) return false;
    return true;
  };
  const Run bare = run(job_text(routing(""))), stiff = run(job_text(routing(relief_text("150", "2"))));
  CHECK(same(bare, run(job_text(routing(relief_text("0", "2"))))));
  CHECK(same(bare, run(job_text(routing(relief_text("150", "0"))))));
  CHECK(!same(bare, stiff));
  // Double stiffness beside the clamps: the bends there become smaller, and the rest moves to the middle without relief.
  const auto bend = [](const Run& of, int link) {
    double most = 0;
    const Rod& rod = of.simulation->rod();
    for (const Row& row : of.rows) most = std::max(most, rod.curvature(rod.turn(row.state, link), link));
    return most;
  };
  for (const int clamp : {0, 40}) CHECK(bend(stiff, clamp) < 0.85 * bend(bare, clamp));
  CHECK(bend(stiff, 20) > bend(bare, 20));
}

TEST_CASE("routing: what cannot be is refused with its place and a remedy") {
  const std::string ring = "link: bench, position_m: [0.5, 0, 1], direction: [1, 0, 0]";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {ends + "  clamps: [{link: arm, position_m: [0.5, 0, 1], direction: [1, 0, 0], at_length_m: 0.6}]\n",
       "routing.clamps[1].link 'arm' is not a link of the robot; one of: bench, spindle"},
      {ends + "  clamps: [{link: bench, position_m: [0.5, 0, 1], direction: [1, 0, 0], at_length_m: 1.4}]\n",
       "routing.clamps[1].at_length_m is 1.4 (must lie between 0 and 1.3, the clamps before and after it); "
       "list the "
       "clamps in their order along the dresspack"},
      {ends + "  rings: [{" + ring + ", radius_mm: 20}]\n",
       "routing.rings[1].radius_mm is 20 (the dresspack's own radius is 20 mm); take a wider ring"},
      {ends + "  rings: [{" + ring + ", radius_mm: 25, at_length_m: 2}]\n", "routing.rings[1].at_length_m is 2"},
      {ends + "  rings: [{link: bench, position_m: [500, 0, 1000], direction: [1, 0, 0], radius_mm: 25}]\n",
       "routing.rings[1].position_m is 1118 m away from the frame of bench (at most 30); give it in metres"},
      {ends +
           "  clamps: [{link: bench, position_m: [0.5, 0, 1], direction: [1, 0, 0], at_length_m: 0.6}]\n  "
           "rings: [{" +
           ring + ", radius_mm: 25}]\n",
       "a ring beside routing.clamps has no at_length_m"},
      {ends + "  tool_end: free\n",
       "routing.tool_clamp is given although routing.tool_end is free; keep one of the two"},
      {ends + "  tool_mass_kg: 1\n",
       "routing.tool_mass_kg is given although the tool end is clamped; add tool_end: free"},
      {ends + "  retraction: {force_N: 10, stroke_m: 0}\n", "routing.retraction.stroke_m is 0 (must be > 0 m)"},
      {with_reliefs(relief_text("326", "1"), "", ""),
       "bend_relief.length_mm is 326 (at most 325, half the dresspack between this clamp and the next)"},
      {with_reliefs("", "", relief_text("-1", "1")),
       "routing.tool_clamp.bend_relief.length_mm is -1 (must be >= 0 mm)"},
      {with_reliefs(relief_text("100", "-1"), "", ""), "routing.base_clamp.bend_relief.bending_stiffness_Nm2 is -1"},
      {with_reliefs(", bend_relief: {length_mm: 100}", "", ""),
       "routing.base_clamp.bend_relief.bending_stiffness_Nm2 is missing"},
      {with_reliefs("", ", bend_relief: {bending_stiffness_Nm2: 100}", ""), "bend_relief.length_mm is missing"},
  };
  for (const auto& [routing, words] : cases) {
    const std::string message = message_of(job_text(routing));
    CAPTURE(routing, message);
    CHECK_THAT(message, Catch::Contains("job.yaml:") && Catch::Contains(": error: ") && Catch::Contains(words));
  }
}
