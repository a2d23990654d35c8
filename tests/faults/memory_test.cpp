// The memory that a stage predicts for its job against the memory that it uses, and the refusal of jobs that do not fit.
#include <sys/resource.h>

#include <iostream>

#include "pipeline/stage/memory.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

/// The peak memory of a program [MB], and its exit status.
struct Peak {
  int status;
  double megabytes;
};
Peak peak_of(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  const pid_t process = ::fork();
  if (process == 0) {
    const std::string line =
        "cd '" + scratch.folder().string() + "' && exec '" DRESSLIFE_BIN_DIR "/" + program + "' " + arguments;
    ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  struct rusage used {};
  ::wait4(process, &status, 0, &used);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, static_cast<double>(used.ru_maxrss) / 1024};
}

/// Returns the memory that a stage predicts for its job [MB]. The stage is allowed nearly none, so it only refuses.
double told(const Scratch& scratch, const std::string& program, const std::string& arguments) {
  const Outcome outcome = run(scratch, program, arguments + " --job-memory 1");
  INFO(program << ' ' << arguments << ": " << outcome.err);
  REQUIRE(outcome.status == 1);
  const std::string before = ": error: takes about ";
  const std::size_t at = outcome.err.find(before);
  REQUIRE(at != std::string::npos);
  CHECK(outcome.err.find("(--job-memory allows 1 MB); ") != std::string::npos);
  return std::stod(outcome.err.substr(at + before.size()));
}

/// Writes poses of a minute of swinging instead of a second.
void write_long_poses(const Scratch& scratch) {
  std::ostringstream poses;
  for (int i = 0; i <= 1200; ++i) {
    const double t = 0.05 * i, u = 0.5 - 0.5 * std::cos(0.7 * t) * std::cos(2.9 * t);
    poses << t << ",0,0,1, 0.7071067811865476,0,0.7071067811865476,0, " << 0.8 - 0.1 * u << ',' << 0.05 * u
          << ",1, 0.7071067811865476,0,0.7071067811865476,0\n";
  }
  scratch.write("poses.csv", poses.str());
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which use memory of their own
TEST_CASE("what a job says it takes is what it takes, within a factor") {
  std::string rubbing;  // friction of cables in the hose and of wires in cables
  for (const std::string part : {"1", "1.components.1"})
    rubbing += "--set dresspack.components." + part + ".friction_coefficient=0.2 --set dresspack.components." + part +
               ".radial_line_load_N_per_m=100 ";
  const std::vector<std::string> jobs{
      "",
      "--set simulation.sample_rate_Hz=200 --set simulation.segments=60",
      "--set simulation.sample_rate_Hz=200 --set simulation.segments=40 --set strain.slip=friction " + rubbing,
      "--set simulation.sample_rate_Hz=200 --set strain.slip=free --set strain.surface_fibres=8",
  };
  for (const std::string& sets : jobs) {
    const Scratch scratch;
    write_small_job(scratch);
    write_long_poses(scratch);
    for (const auto& [program, line] : std::vector<std::pair<std::string, std::string>>{
             {"dresslife-sim", "job.yaml -o motion.h5 --quiet " + sets},
             {"dresslife-strain", "motion.h5 --job job.yaml -o strain.h5 --quiet " + sets},
             {"dresslife-fatigue", "strain.h5 --job job.yaml -o life.h5 --quiet " + sets}}) {
      const double estimate = told(scratch, program, line);
      const Peak peak = peak_of(scratch, program, line);
      INFO(program << ' ' << line);
      REQUIRE(peak.status == 0);
      std::cout << program << ' ' << sets << ": says " << estimate << " MB, took " << peak.megabytes << " MB\n";
      CHECK(estimate < dresslife::pipeline::memory_factor * peak.megabytes);
      CHECK(peak.megabytes < dresslife::pipeline::memory_factor * estimate);
    }
  }
}
#endif

TEST_CASE("a job that does not fit is refused before it begins, with the key to change") {
  const Scratch scratch;
  write_small_job(scratch);
  const Outcome sim = run(scratch, "dresslife-sim", "job.yaml -o motion.h5 --job-memory 3");
  CHECK(sim.status == 1);
  CHECK(sim.err.starts_with("job.yaml: error: takes about "));
  CHECK(sim.err.find("(--job-memory allows 3 MB); choose ") != std::string::npos);
  CHECK(sim.err.ends_with(", or allow more\n"));
  CHECK_FALSE(fs::exists(scratch / "motion.h5"));
  must_run(scratch, "dresslife-sim", "job.yaml -o motion.h5");
  const Outcome strain = run(scratch, "dresslife-strain", "motion.h5 -o strain.h5 --job-memory 3");
  CHECK(strain.err.find("choose ") != std::string::npos);
  CHECK_FALSE(fs::exists(scratch / "strain.h5"));
}

TEST_CASE("a study's logs print what each stage takes, and a job that does not fit fails alone") {
  const Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {small: {}, large: {simulation.segments: 2000}}\n");
  const Outcome outcome = run(scratch, "dresslife", "run study.yaml --job-memory 90");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == 1);
  const std::string log = content(scratch / "runs/study/small/log");
  std::size_t notes = 0;
  for (std::size_t at = 0; (at = log.find("note: takes about ", at)) != std::string::npos; ++at) ++notes;
  CHECK(notes == 3);
  CHECK(outcome.out.find("large/job.yaml: error: takes about ") != std::string::npos);
  CHECK(outcome.out.find("fewer simulation.segments") != std::string::npos);
}

TEST_CASE("more than can be numbered or held is refused before time is spent on it") {
  const Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife-sim", "job.yaml -o motion.h5 --quiet");
  const auto refused = [&](const std::string& program, const std::string& arguments, const std::string& words) {
    const Outcome outcome = run(scratch, program, arguments + " -o out.h5 --job-time 30");
    INFO(program << ' ' << arguments << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK_FALSE(fs::exists(scratch / "out.h5"));
  };
  // A thousand strands of a thousand ropes of a thousand wires, too thin to touch: 1e9 wires in 12 segments.
  const std::string wires = "{name: wire, count: 1000, radius_mm: 1e-9, helix_radius_mm: 1e-5, material: copper}";
  const std::string ropes =
      "{name: rope, count: 1000, radius_mm: 2e-5, helix_radius_mm: 0.01, components: [" + wires + "]}";
  const auto strands = [&](int count) {
    return "[{name: strand, count: " + std::to_string(count) + ", radius_mm: 0.011, helix_radius_mm: 4, components: [" +
           ropes + "]}]";
  };
  refused("dresslife-strain", "motion.h5 --job job.yaml --set 'dresspack.components=" + strands(1000) + "'",
          "has 1.2e+10 sites, fibres of wires in segments (strain.h5 numbers at most 4294967294); choose fewer");
  // A tenth of these wires can be numbered, but not stored.
  refused("dresslife-strain",
          "motion.h5 --job job.yaml --job-memory 4000 --set 'dresspack.components=" + strands(100) + "'",
          " of it (--job-memory allows 4000 MB); choose fewer of them (dresspack.components), ");
  for (const char* repeats : {"2147483647", "2147483648", "3000000000"})
    refused("dresslife-sim",
            std::string("job.yaml --set 'motion={steps: [{repeat: ") + repeats + ", steps: [{dwell_s: 1}]}]}'",
            "motion.steps[1].repeat is ");
  refused("dresslife-sim", "job.yaml --set simulation.segments=3000000000",
          "simulation.segments is 3000000000 (must be ");
}
