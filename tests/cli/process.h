// Runs the project's programs as a user's shell does and captures their output.
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
  std::string out;
  std::string err;  ///< each warning in one line: where it is wrapped depends on the length of a path in it
};

using pipeline::count_of;
using pipeline::edited;
using pipeline::replaced_all;
using pipeline::Scratch;

inline std::string content(const fs::path& file) { return pipeline::bytes_of(file); }

/// Runs a line of shell in the scratch folder. Returns its exit status and its output.
Outcome run_shell(const Scratch& scratch, const std::string& line);

/// Runs `program arguments` from this build in the scratch folder. Arguments are shell words.
Outcome run(const Scratch& scratch, const std::string& program, const std::string& arguments);

/// Runs `program arguments` as run() does and requires exit status 0. Otherwise the test fails and prints the output.
Outcome must_run(const Scratch& scratch, const std::string& program, const std::string& arguments);

/// Returns the output with each warning in one line.
inline std::string unwrapped(const std::string& output) { return replaced_all(output, "\n    ", " "); }

/// Number of repetitions of a random test: `times`, multiplied by DRESSLIFE_FAULTS if it is set (scripts/faults).
inline int rounds(int times) {
  const char* const factor = std::getenv("DRESSLIFE_FAULTS");
  return times * (factor ? std::max(1, std::atoi(factor)) : 1);
}

/// Returns a file's text after its first line, the mark of ownership.
inline std::string unmarked_content(const fs::path& file) { return std::string(pipeline::without_mark(content(file))); }

/// Writes job.yaml: a fast job without a robot. A short cable hangs between two clamps, one of which swings for one second.
void write_small_job(const Scratch& scratch);

/// Writes the dresspack of the small job to hose.yaml. Precondition: write_small_job() has written job.yaml.
void write_small_hose(const Scratch& scratch);

/// A dresspack of a thin, flexible hose with enough wires for a life.
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
