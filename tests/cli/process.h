// Runs our programs as a user's shell does and keeps what they say.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "pipeline/base/ownership.h"

namespace dresslife::tests {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string out, err;
};

/// A folder of its own for one test, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (fs::temp_directory_path() / "dresslife-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  fs::path operator/(const std::string& name) const { return folder_ / name; }
  const fs::path& folder() const { return folder_; }
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

 private:
  fs::path folder_;
};

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Runs `program arguments` from our build in the scratch folder. Arguments are shell words.
inline Outcome run(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  const std::string command = "cd '" + scratch.folder().string() + "' && '" DRESSLIFE_BIN_DIR "/" + program +
                              "' " + arguments + " >'" + out.string() + "' 2>'" + err.string() +
                              "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
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

/// Runs a line of shell in the scratch folder.
inline Outcome run_shell(const Scratch& scratch, const std::string& line) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  const std::string command = "cd '" + scratch.folder().string() + "' && { " + line + "\n} >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
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
