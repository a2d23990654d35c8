// Studies in a queue: a real Slurm on one node, started by the test.

#include "tests/faults/slurm.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"

using namespace dresslife::tests;

namespace {

constexpr int long_enough_s = 120;

void write_cluster(const Scratch& scratch, const std::string& name, int tasks, int most_stages) {
  scratch.write(
      name,
      fmt::format("name: test\nsource: made for the tests\ntasks: {}\nmemory_MB: 256\nmost_stages: {}\n"
                  "launcher: srun --quiet --ntasks=1 --cpus-per-task=1 --exact\nsubmit: timeout 20 sbatch --parsable\n",
                  tasks, most_stages));
}

/// Returns the last number after "job " in the output of a submission.
std::string job_of(const Outcome& outcome) {
  const std::size_t at = outcome.out.rfind("job ");
  if (outcome.status != 0 || at == std::string::npos) return "";
  return std::to_string(std::atol(outcome.out.c_str() + at + 4));
}

/// Installs dresslife with stages that compute nothing in the scratch folder.
void install_fake_stages(const Scratch& scratch) {
  fs::create_directories(scratch / "bin");
  fs::create_directories(scratch / "share/dresslife");
  fs::create_directory_symlink(DRESSLIFE_SOURCE_DIR "/config", scratch / "share/dresslife/config");
  fs::copy_file(DRESSLIFE_BIN_DIR "/dresslife", scratch / "bin/dresslife");
  for (const char* stage : {"sim", "strain", "fatigue"})
    fs::copy_file(DRESSLIFE_FAKE_STAGE, scratch / "bin" / (std::string("dresslife-") + stage));
}

}  // namespace

TEST_CASE("Slurm: a submitted study outlives its node, passes on how stages end, and runs as shards") {
  Scratch scratch;
  const Slurm slurm(scratch);
  if (!slurm.why_not().empty()) {
    WARN("skipped, as no Slurm runs here: " << slurm.why_not());
    return;
  }
  const auto logs = [&] { return content(scratch / "runs/study/submit.log") + slurm.logs(); };

  // Stages that compute nothing. One waits, and meanwhile the node goes down. One fails.
  install_fake_stages(scratch);
  write_cluster(scratch, "cluster.yaml", std::min(2, Slurm::cpus()), 40000);
  scratch.write("job.yaml", dresslife::pipeline::sample_job);
  // Without a motion there is no page.
  scratch.write("study.yaml", "base: job.yaml\nkeep: lives\nvary: {simulation.segments: [20, 21, 22]}\n");
  const fs::path study = scratch / "runs/study";
  scratch.write("runs/study/segments=21/wait-strain", "");
  scratch.write("runs/study/segments=22/fail-strain", "");
  const auto calls = [&](const std::string& job) { return content(study / job / "calls"); };
  const std::string submit = "bin/dresslife submit study.yaml --cluster cluster.yaml";
  const Outcome first = slurm.shell(submit);
  const std::string job = job_of(first);
  INFO(first.out << first.err);
  REQUIRE(!job.empty());
  CHECK(first.out.find("submit.log") != std::string::npos);
  const bool begun = within(long_enough_s, [&] {
    return calls("segments=20") == "sim\nstrain\nfatigue\n" && calls("segments=21") == "sim\nstrain\n" &&
           calls("segments=22") == "sim\nstrain\n";
  });
  INFO(logs());
  REQUIRE(begun);

  REQUIRE(slurm.set_node("DOWN"));
  REQUIRE(within(long_enough_s, [&] { return slurm.node_is("down") && Slurm::no_steps(); }));
  CHECK(slurm.state(job).starts_with("PENDING"));
  CHECK(calls("segments=21") == "sim\nstrain\n");
  fs::remove(study / "segments=21/wait-strain");
  REQUIRE(slurm.set_node("RESUME"));
  REQUIRE(within(long_enough_s, [&] { return slurm.state(job).starts_with("FAILED"); }));
  CHECK(slurm.state(job) == "FAILED 1:0\n");  // dresslife's exit status: a job of the study failed
  CHECK(calls("segments=20") == "sim\nstrain\nfatigue\n");
  CHECK(calls("segments=21") == "sim\nstrain\nstrain\nfatigue\n");
  CHECK(calls("segments=22") == "sim\nstrain\nstrain\n");
  const Outcome status = slurm.shell("bin/dresslife status study.yaml");
  CHECK(status.out.find("2 of 3 jobs done") != std::string::npos);
  CHECK(status.out.find("strain broke") != std::string::npos);
  CHECK(content(study / "ranking.csv").find("segments=21") != std::string::npos);

  // After the correction the study continues. When it is done, there is nothing to submit.
  fs::remove(study / "segments=22/fail-strain");
  const std::string again = job_of(slurm.shell(submit));
  REQUIRE(!again.empty());
  REQUIRE(within(long_enough_s, [&] { return slurm.state(again).starts_with("COMPLETED"); }));
  CHECK(calls("segments=20") == "sim\nstrain\nfatigue\n");
  CHECK(calls("segments=22") == "sim\nstrain\nstrain\nstrain\nfatigue\n");
  CHECK(slurm.shell(submit).out.find("nothing to do") != std::string::npos);

  // The real stages. There are more of them than an allocation may start, so each job is a shard with its own allocation.
  write_small_job(scratch);
  write_cluster(scratch, "small.yaml", 1, 3);
  scratch.write(
      "shards.yaml",
      "base: job.yaml\njobs: {soft: {dresspack.bending_stiffness_Nm2: 2}, usual: {}, other: {motion.clamp_poses: other.csv}}\n");
  scratch.write("other.csv", replaced_all(content(scratch / "poses.csv"), "0.05,", "0.06,"));
  const Outcome whole = must_run(scratch, "dresslife", "run shards.yaml -o whole --quiet");
  CHECK_THAT(must_run(scratch, "dresslife", "submit shards.yaml --only-write --cluster small.yaml -o written").out,
             Catch::Contains("--array=1-3 ") && Catch::Contains("--dependency=afterany:NUMBER "));
  const Outcome array = slurm.shell("'" DRESSLIFE_BIN_DIR "/dresslife' submit shards.yaml --cluster small.yaml");
  INFO(array.out << array.err);
  CHECK(array.out.find(" of 3 shards") != std::string::npos);
  const std::string ranks = job_of(array);
  REQUIRE(!ranks.empty());
  const bool ranked = within(long_enough_s, [&] { return slurm.state(ranks).starts_with("COMPLETED"); });
  INFO(content(scratch / "runs/shards/submit.log"));
  REQUIRE(ranked);
  for (const char* shard : {"1_of_3", "2_of_3", "3_of_3"}) {
    const std::string graph = content(scratch / "runs/shards/.stage" / (std::string("shard_") + shard) / "build.ninja");
    CHECK(graph.find(": fatigue ") != std::string::npos);
    CHECK(graph.find(": fatigue ") == graph.rfind(": fatigue "));
  }
  CHECK(content(scratch / "runs/shards/ranking.csv") == content(scratch / "whole/shards/ranking.csv"));

  // The plan of a fleet uses these results.
  scratch.write(
      "duties.yaml",
      "study: shards.yaml\nduties:\n  - {name: one, programs: [{job: soft, percent_of_time: 0.1}]}\n"
      "  - {name: two, programs: [{job: usual, percent_of_time: 0.1}, {job: other, percent_of_time: 0.1}]}\n");
  scratch.write("fleet.csv", "name,duty,installed\na,one,2026-11-20\nb,two,2026-11-20\n");
  const auto plan = [&](const std::string& out) {
    must_run(scratch, "dresslife",
             "plan fleet.csv --duties duties.yaml --today 2026-11-23 --windows 2026-12-21 --quiet -o " + out);
    return content(scratch / out / "shards/plan_fleet.csv");
  };
  CHECK(plan("runs") == plan("whole"));
}
