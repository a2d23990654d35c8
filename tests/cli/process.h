// Runs our programs as a user's shell does and keeps what they say.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "pipeline/base/ownership.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::tests {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string out, err;
};

using pipeline::count_of;
using pipeline::edited;
using pipeline::replaced_all;
using pipeline::Scratch;

inline std::string content(const fs::path& file) { return pipeline::bytes_of(file); }

/// Runs a line of shell in the scratch folder.
inline Outcome run_shell(const Scratch& scratch, const std::string& line) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  const std::string command = "cd '" + scratch.folder().string() + "' && { " + line + "\n} >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

/// Runs `program arguments` from our build in the scratch folder. Arguments are shell words.
inline Outcome run(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  return run_shell(scratch, "'" DRESSLIFE_BIN_DIR "/" + program + "' " + arguments);
}

/// The same for a program that must succeed: any other exit status ends the test with the program's output.
inline Outcome must_run(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  const Outcome outcome = run(scratch, program, arguments);
  INFO(program << ' ' << arguments << '\n' << outcome.out << outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome;
}

/// How often a test repeats what it draws by lot: `times`, or more in the long form of the faults
/// (scripts/faults).
inline int rounds(int times) {
  const char* const factor = std::getenv("DRESSLIFE_FAULTS");
  return times * (factor ? std::max(1, std::atoi(factor)) : 1);
}

/// A file's text after the line of its mark.
inline std::string unmarked_content(const fs::path& file) {
  return std::string(pipeline::without_mark(content(file)));
}

/// A quick job without a robot: a short cable between two clamps, one of which swings to and fro for a
/// second.
inline void write_small_job(const Scratch& scratch) {
  std::ostringstream poses;
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.05 * i, u = 0.5 - 0.5 * std::cos(2 * 3.141592653589793 * t);
    poses << t << ",0,0,1, 0.7071067811865476,0,0.7071067811865476,0, " << 0.8 - 0.1 * u << ',' << 0.05 * u
          << ",1, 0.7071067811865476,0,0.7071067811865476,0\n";
  }
  scratch.write("poses.csv", poses.str());
  scratch.write("job.yaml", R"(motion: {clamp_poses: poses.csv}
dresspack:
  name: test hose
  source: made for the tests
  diameter_mm: 40
  mass_kg_per_m: 1.5
  bending_stiffness_Nm2: 2
  torsional_stiffness_Nm2: 2
  axial_stiffness_N: 50000
  damping_time_ms: 20
  damping_source: made for the tests
  components:
    - name: cable
      count: 2
      radius_mm: 5
      helix_radius_mm: 10
      components:
        - {name: wire, count: 6, radius_mm: 0.1, helix_radius_mm: 2, lay_angle_deg: 15, material: copper}
routing:
  free_length_m: 0.9
simulation:
  segments: 12
  sample_rate_Hz: 50
strain: {slip: stick}
)");
}

/// The dresspack of the small job as a file, hose.yaml.
inline void write_small_hose(const Scratch& scratch) {
  const std::string job = content(scratch / "job.yaml");
  const std::size_t begin = job.find("dresspack:\n") + 11, end = job.find("routing:\n");
  std::string hose;
  std::istringstream lines(job.substr(begin, end - begin));
  for (std::string line; std::getline(lines, line);) hose += line.substr(2) + "\n";
  scratch.write("hose.yaml", hose);
}

/// A dresspack: a thin hose that bends easily, and wires enough to have a life.
inline constexpr const char* thin_hose = R"(name: thin hose
source: made for the tests
diameter_mm: 12
inner_diameter_mm: 10.2
mass_kg_per_m: 0.2
bending_stiffness_Nm2: 0.5
torsional_stiffness_Nm2: 0.5
axial_stiffness_N: 50000
damping_time_ms: 20
damping_source: made for the tests
least_bend_radius_mm: 60
components:
  - name: cable
    count: 2
    radius_mm: 2
    helix_radius_mm: 3
    slack_percent: 1
    components:
      - {name: wire, count: 6, radius_mm: 0.1, helix_radius_mm: 1, lay_angle_deg: 15, material: copper}
)";

}  // namespace dresslife::tests
