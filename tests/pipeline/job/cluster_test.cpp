#include "pipeline/job/cluster.h"

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

TEST_CASE("cluster: the shipped one, in SI units") {
  const Cluster slurm = read_cluster(DRESSLIFE_SOURCE_DIR "/config/clusters/slurm.yaml");
  CHECK(slurm.launcher.starts_with("srun "));
  CHECK(slurm.memory == 2e9);
  CHECK(slurm.most_stages == 40000);
}

TEST_CASE("cluster: what is wrong is reported with its place") {
  const Scratch scratch;
  const auto refused = [&](const std::string& text) {
    return message_of([&] { read_cluster(scratch.write("own.yaml", text)); });
  };
  const std::string whole = "name: a\nsource: b\nlauncher: srun\n";
  CHECK(refused(whole) == "");
  CHECK(refused("name: a\nsource: b\n").find("launcher") != std::string::npos);
  CHECK(refused(whole + "tasks: 0\n").find("own.yaml:4:8: error: tasks is 0") != std::string::npos);
  CHECK(refused(whole + "memory_GB: 2\n").find("memory_MB") != std::string::npos);
  CHECK(refused(whole + "options: \"--time=1\\n#SBATCH --x\"\n").find("several lines") != std::string::npos);
  CHECK(refused("- a\n").find("holds no cluster") != std::string::npos);
}

}  // namespace
}  // namespace dresslife::pipeline
