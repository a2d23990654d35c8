// Two dresspacks on one robot, from a job file to the ranking and the report.
#include <algorithm>
#include <sstream>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;

namespace {

/// A robot with one axis along x that turns to and fro.
const std::string robot = R"(robot:
  name: spindle
  source: made for the tests
  joints:
    - {name: spindle, origin_m: [0, 0, 1], axis: [1, 0, 0], lower_deg: -400, upper_deg: 400, speed_deg_per_s: 90,
       acceleration_deg_per_s2: 300}
  links: [{name: bench}, {name: spindle}]
motion:
  name: turn
  steps: [{text: start, joints_deg: [0]}, {text: turn, joints_deg: [40]}, {text: back, joints_deg: [0]}]
)";
const std::string settings =
    R"(simulation: {segments: 16, sample_rate_Hz: 50, periodic_tolerance_mm: 1.0e-3, most_repeats: 30}
strain: {slip: stick}
)";

std::string hose(double diameter, const std::string& components) {
  return "{name: hose, source: made for the tests, diameter_mm: " + std::to_string(diameter) +
         ", mass_kg_per_m: 1.5, bending_stiffness_Nm2: 2, torsional_stiffness_Nm2: 2, axial_stiffness_N: "
         "1e5, "
         "damping_time_ms: 40, damping_source: made for the tests, components: [" +
         components + "]}";
}
const std::string thick = hose(40,
                               "{name: cable, count: 2, radius_mm: 5, helix_radius_mm: 10, components: "
                               "[{name: wire, count: 6, radius_mm: 0.1, "
                               "helix_radius_mm: 2, lay_angle_deg: 15, material: copper}]}");
const std::string thin =
    hose(20, "{name: core, count: 4, radius_mm: 0.1, helix_radius_mm: 4, lay_angle_deg: 20, material: copper}");

/// Returns a routing along the axis, at the lateral distance `beside`.
std::string routing(double length, double beside) {
  const std::string y = std::to_string(beside);
  return "{free_length_m: " + std::to_string(length) + ", base_clamp: {link: bench, position_m: [0, " + y +
         ", 1], direction: [1, 0, 0]}, tool_clamp: {link: spindle, position_m: [1, " + y +
         ", 0], direction: [1, 0, 0]}}";
}

std::string job_of(const std::string& dresspacks) { return robot + dresspacks + settings; }

/// Returns the damage of the worst wire of each dresspack of a job.
std::vector<double> damage_of(const Scratch& scratch, const std::string& job) {
  for (const auto& [program, files] : {std::pair<std::string, std::string>{"sim", ".yaml -o " + job + ".motion.h5"},
                                       {"strain", ".motion.h5 -o " + job + ".strain.h5"},
                                       {"fatigue", ".strain.h5 -o " + job + ".life.h5"}}) {
    must_run(scratch, "dresslife-" + program, job + files);
  }
  const pipeline::FileReader life(scratch / (job + ".life.h5"), pipeline::life_format());
  return life.read<double>("/dresspack/damage");
}

}  // namespace

TEST_CASE("two dresspacks far apart live as long as each alone") {
  Scratch scratch;
  const std::string here = routing(1.1, 0), there = routing(1.15, 0.6);
  scratch.write("both.yaml", job_of("dresspacks:\n  - {name: hose, dresspack: " + thick + ", routing: " + here +
                                    "}\n  - {name: cable, dresspack: " + thin + ", routing: " + there + "}\n"));
  scratch.write("first.yaml", job_of("dresspack: " + thick + "\nrouting: " + here + "\n"));
  scratch.write("second.yaml", job_of("dresspack: " + thin + "\nrouting: " + there + "\n"));
  const auto both = damage_of(scratch, "both"), first = damage_of(scratch, "first"),
             second = damage_of(scratch, "second");
  REQUIRE(both.size() == 2);
  REQUIRE(first.size() == 1);
  // Repeats end when their begins agree to 1 um, of bends of centimetres. Damage grows with the 2nd to 8th power of this.
  const double alike = 1e-3;
  CHECK(both[0] == Approx(first[0]).epsilon(alike));
  CHECK(both[1] == Approx(second[0]).epsilon(alike));
  CHECK(both[0] > 0);
  CHECK(both[1] > 0);
}

TEST_CASE("the relative life of a rated cable is the same beside another dresspack") {
  Scratch scratch;
  const std::string rated =
      thin.substr(0, thin.size() - 1) +
      ", ratings: [{rig: {kind: torsion, twist_deg_per_m: 360}, cycles: 1e+6, source: data sheet}]}";
  const std::string there = routing(1.15, 0.6);
  scratch.write("both.yaml",
                job_of("dresspacks:\n  - {name: hose, dresspack: " + thick + ", routing: " + routing(1.1, 0) +
                       "}\n  - {name: cable, dresspack: " + rated + ", routing: " + there + "}\n"));
  scratch.write("alone.yaml", job_of("dresspack: " + rated + "\nrouting: " + there + "\n"));
  const auto per_hour = [&](const std::string& job) {
    must_run(scratch, "dresslife", "run " + job + ".yaml --quiet");
    std::istringstream lines(content(scratch / ("runs/" + job + "/ranking.csv")));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
      rows.push_back({""});
      bool quoted = false;
      for (const char letter : line)
        if (letter == '"')
          quoted = !quoted;
        else if (letter == ',' && !quoted)
          rows.back().emplace_back();
        else
          rows.back().back() += letter;
    }
    REQUIRE(rows.size() == 2);
    const auto column = std::find(rows[0].begin(), rows[0].end(), "rated_cycles_per_hour") - rows[0].begin();
    return std::stod(rows[1].at(static_cast<std::size_t>(column)));
  };
  const double alone = per_hour("alone");
  CHECK(alone > 0);
  CHECK(per_hour("both") == Approx(alone).epsilon(1e-3));  // tolerance of the damages above
}

TEST_CASE("a study of two dresspacks ranks by the worse and reports which it is") {
  Scratch scratch;
  scratch.write("job.yaml",
                job_of("dresspacks:\n  - {name: hose, dresspack: " + thick + ", routing: " + routing(1.1, 0) +
                       "}\n  - {name: cable, dresspack: " + thin + ", routing: " + routing(1.15, 0.6) + "}\n"));
  scratch.write("study.yaml", "base: job.yaml\nvary: {dresspacks.2.routing.free_length_m: [1.15, 1.3]}\n");
  const Outcome outcome = must_run(scratch, "dresslife", "run study.yaml");
  INFO(outcome.err << outcome.out);
  const std::string ranking = content(scratch / "runs/study/ranking.csv");
  const std::size_t line = ranking.find('\n');
  CHECK(ranking.substr(0, line).find(",worst_dresspack,") != std::string::npos);
  const pipeline::FileReader life(scratch / "runs/study/free_length_m=1.15/life.h5", pipeline::life_format());
  const std::string worst = life.text_attribute("worst_dresspack");
  const auto damage = life.read<double>("/dresspack/damage");
  CHECK(worst == (damage[0] > damage[1] ? "hose" : "cable"));
  CHECK(ranking.find("," + worst + ",") != std::string::npos);
  CHECK(outcome.out.find(worst + "/") != std::string::npos);  // the path of the wire that breaks first
  // The picture of each job shows both dresspacks, with one segment marked. Each segment has two strokes.
  const std::string report = content(scratch / "runs/study/report.html");
  std::size_t strokes = 0;
  for (std::size_t at = report.find("<line class=\"hose"); at != std::string::npos;
       at = report.find("<line class=\"hose", at + 1))
    ++strokes;
  CHECK(strokes == 2 * 2 * 2 * 16);
  CHECK(report.find("Life by dresspack</h3>") != std::string::npos);
  CHECK(report.find("<td>cable, smallest bend radius</td>") != std::string::npos);
}
