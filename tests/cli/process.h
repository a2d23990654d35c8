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
Outcome run_shell(const Scratch& scratch, const std::string& line);

/// Runs `program arguments` from our build in the scratch folder. Arguments are shell words.
Outcome run(const Scratch& scratch, const std::string& program, const std::string& arguments);

/// The same for a program that must succeed: any other exit status ends the test with the program's output.
Outcome must_run(const Scratch& scratch, const std::string& program, const std::string& arguments);

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

/// A quick job without a robot: a short cable between two clamps, one of which swings to and fro for a second.
void write_small_job(const Scratch& scratch);

/// The dresspack of the small job as a file, hose.yaml.
void write_small_hose(const Scratch& scratch);

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
