// The bounds of every percentile of life in random jobs: glued <= as it is <= free, over the same samples.
// DRESSLIFE_JOBS=200 and DRESSLIFE_SEED=2 run more jobs and other jobs.
// fatigue/measurements.md has the results of more jobs.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>
#include "tests/catch.h"

#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

int number_in(const char* variable, int otherwise) {
  const char* const given = std::getenv(variable);
  return given ? std::atoi(given) : otherwise;
}

constexpr double allowed = 0.01;  // of a life, by which a bound may be on the wrong side

/// Returns the cells of ranking.csv by column, one map per row. Precondition: no cell read here is quoted.
std::vector<std::map<std::string, std::string>> ranking(const fs::path& file) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells{""};
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    }
    return cells;
  };
  std::istringstream lines(content(file));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> columns = cells_of(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    REQUIRE(cells.size() == columns.size());
    rows.emplace_back();
    for (std::size_t k = 0; k < cells.size(); ++k) rows.back()[columns[k]] = cells[k];
  }
  return rows;
}

/// Two loose cables in a hose, each with four conductors of twelve wires.
const std::string hose_job = R"(motion: {deformation: calm.csv}
dresspack:
  name: hose
  source: made for the tests
  diameter_mm: 40
  inner_diameter_mm: 34
  mass_kg_per_m: 1
  bending_stiffness_Nm2: 2
  torsional_stiffness_Nm2: 2
  axial_stiffness_N: 1.0e+5
  damping_time_ms: 20
  damping_source: made for the tests
  components:
    - name: cable
      count: 2
      radius_mm: 5
      helix_radius_mm: 10
      components:
        - name: conductor
          count: 4
          radius_mm: 1.2
          helix_radius_mm: 2.5
          lay_angle_deg: 12
          hand: left
          components:
            - {name: wire, count: 12, radius_mm: 0.1, helix_radius_mm: 0.8, lay_angle_deg: 6, material: copper_halved}
routing: {free_length_m: 1}
simulation: {segments: 12}
strain: {gate: 1.0e-5}
)";

/// Returns swings of the hose: bends to either side with a phase that varies along it, and twists.
std::string swings(double curvature, double twist, double phase) {
  std::string text = "t_s,position_m,kappa_1_1_per_m,kappa_2_1_per_m,twist_rad_per_m,elongation\n";
  constexpr int samples = 25, places = 5;
  for (int k = 0; k < samples; ++k)
    for (int place = 0; place < places; ++place) {
      const double t = 0.4 * k, s = 0.25 * place, turn = 2 * M_PI * k / (samples - 1);
      text += fmt::format("{},{},{},{},{},0\n", t, s, curvature * std::sin(turn) * (1 - 0.5 * s),
                          curvature * (1 + 0.4 * std::cos(2 * turn + phase)) * s,
                          twist * std::sin(turn + phase) - twist * std::sin(phase));
    }
  return text;
}

struct Exceptions {
  int jobs = 0, compared = 0, beyond = 0;
  double worst = 0;
  std::string list;
};

void compare(const fs::path& file, Exceptions& found) {
  for (auto row : ranking(file)) {
    INFO(row["job"] << ": " << row["message"]);
    REQUIRE(row["status"] == "done");
    ++found.jobs;
    for (const std::string share : {"p10", "p50", "p90"}) {
      const double life = std::stod(row["life_hours_" + share]),
                   glued = std::stod(row["life_hours_" + share + "_all_glued"]),
                   free = std::stod(row["life_hours_" + share + "_all_free"]);
      for (const auto& [low, high, bound] : {std::tuple{glued, life, "glued"}, std::tuple{life, free, "free"}}) {
        ++found.compared;
        const double by = std::isinf(high) ? 0 : low / high - 1;
        if (!(by > allowed)) continue;
        ++found.beyond;
        found.worst = std::max(found.worst, by);
        found.list += fmt::format("{} {} {}: {} .. {} .. {}\n", row["job"], share, bound, glued, life, free);
      }
    }
  }
}

}  // namespace

TEST_CASE("bounds of p10, p50 and p90 lie on both sides of them in random jobs") {
  const int seed = number_in("DRESSLIFE_SEED", 1), jobs = number_in("DRESSLIFE_JOBS", 12);
  const int hose_jobs = jobs / 2, rig_jobs = jobs - hose_jobs;
  CAPTURE(seed);
  Scratch scratch;
  scratch.write("calm.csv", swings(1.2, 0.5, 0.3));
  scratch.write("bent.csv", swings(4, 0, 1.1));
  scratch.write("twisted.csv", swings(1, 4, 2));
  scratch.write("hose.yaml", hose_job);
  const std::string cable = "dresspack.components.1.", conductor = cable + "components.1.",
                    wire = conductor + "components.1.";
  const auto inside = [&](const std::string& core, const std::string& strand) {
    return "    " + core + "lay_angle_deg: !uniform [4, 18]\n    " + core +
           "friction_coefficient: !uniform [0.05, 0.8]\n    " + core +
           "radial_line_load_N_per_m: !uniform [5, 2000]\n    " + strand + "lay_angle_deg: !uniform [2, 12]\n    " +
           strand + "friction_coefficient: !uniform [0.05, 0.8]\n    " + strand +
           "radial_line_load_N_per_m: !uniform [1, 200]\n    " + strand +
           "material: !choice [copper, copper_halved, copper_hard_drawn]\n    strain.surface_fibres: !choice [0, 1]\n"
           "    fatigue.mean_stress: !choice [none, swt]\n    fatigue.scatter_log10: !uniform [0.05, 0.4]\n";
  };
  scratch.write("hoses.yaml",
                fmt::format("base: hose.yaml\nsample:\n  jobs: {}\n  seed: {}\n  keys:\n"
                            "    motion.deformation: !choice [calm.csv, bent.csv, twisted.csv]\n    {}slack_percent: "
                            "!uniform [0.1, 3]\n{}",
                            hose_jobs, seed, cable, inside(conductor, wire)));
  scratch.write(
      "rigs.yaml",
      fmt::format("base: rig.yaml\nsample:\n  jobs: {}\n  seed: {}\n  keys:\n    motion.rig: !choice [{}]\n{}",
                  rig_jobs, seed,
                  "{kind: torsion, twist_deg_per_m: 90}, {kind: rolling_flex, radius_diameters: 8, travel_m: 1}, "
                  "{kind: tick_tock, radius_diameters: 6}, {kind: two_pulley, pulley_diameter_mm: 150}",
                  inside(conductor, wire)));
  const std::size_t parts = hose_job.find("    - name: cable");
  const std::string held_cable = hose_job.substr(parts, hose_job.find("routing:") - parts);
  std::string rig =
      "motion: {rig: {kind: torsion, twist_deg_per_m: 90}}\ndresspack:\n  name: cable\n  source: made for the tests\n"
      "  cable_alone: true\n  diameter_mm: 10\n  components:\n" +
      held_cable;
  rig.replace(rig.find("      count: 2\n"), 15, "");
  rig.replace(rig.find("helix_radius_mm: 10"), 19, "helix_radius_mm: 0");
  scratch.write("rig.yaml", rig);

  Exceptions found;
  for (const std::string study : {"hoses", "rigs"}) {
    must_run(scratch, "dresslife", "run " + study + ".yaml --quiet");
    compare(scratch / ("runs/" + study + "/ranking.csv"), found);
  }
  CHECK(found.jobs == hose_jobs + rig_jobs);
  CHECK(found.compared == 6 * found.jobs);
  WARN("seed " << seed << ": " << found.beyond << " of " << found.compared
               << " bounds lie on the wrong side by more than " << 100 * allowed << " %, by " << 100 * found.worst
               << " % at worst\n"
               << found.list);
  CHECK(found.beyond == 0);
}
