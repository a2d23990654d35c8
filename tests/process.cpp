#include "tests/cli/process.h"

namespace dresslife::tests {

Outcome run_shell(const Scratch& scratch, const std::string& line) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  const std::string command = "cd '" + scratch.folder().string() + "' && { " + line + "\n} >'" + out.string() +
                              "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), unwrapped(content(err))};
}

Outcome run(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  return run_shell(scratch, "'" DRESSLIFE_BIN_DIR "/" + program + "' " + arguments);
}

Outcome must_run(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  const Outcome outcome = run(scratch, program, arguments);
  INFO(program << ' ' << arguments << '\n' << outcome.out << outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome;
}

void write_small_job(const Scratch& scratch) {
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

void write_small_hose(const Scratch& scratch) {
  const std::string job = content(scratch / "job.yaml");
  const std::size_t begin = job.find("dresspack:\n") + 11, end = job.find("routing:\n");
  std::string hose;
  std::istringstream lines(job.substr(begin, end - begin));
  for (std::string line; std::getline(lines, line);) hose += line.substr(2) + "\n";
  scratch.write("hose.yaml", hose);
}

}  // namespace dresslife::tests
