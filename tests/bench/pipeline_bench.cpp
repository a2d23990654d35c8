// Cost of the study runner itself: ten thousand jobs whose stages compute nothing but do all other work of a stage (job, receipt,
// checksums, synced files). All time is spent by the runner, Ninja and the operating system.
//
// expand_10k_s: first reading and expansion of the study.
// graph_10k_s: the same, and writing of settings and build graph.
// overhead_ms_per_job: wall time per job of a run, three stages as processes, two at a time.
// noop_10k_s: check that all files and results are unchanged and no work remains.
// gather_10k_s: ranking of all jobs from their receipts and life files.
// study_10k_mb: the runner's peak memory over all of these.
//
// ..._processor_...: processor time of the same work, which depends little on other work of the machine: the runner's own, and
// in a run also that of all stages and Ninja.
//
// bench_pipeline SIDE: uses SIDE x SIDE jobs, with figures scaled to ten thousand.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "pipeline/base/digest.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study_state.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/sample_life.h"

namespace {

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

/// A temporary folder with the lifetime of this object.
struct Folder {
  fs::path path = fs::temp_directory_path() / fmt::format("dresslife-bench-{}", ::getpid());
  Folder() { fs::create_directories(path / "programs"); }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return path / name;
  }
};

template <class Action>
double seconds(const Action& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Returns the processor time of this process (RUSAGE_SELF) or of its ended children (RUSAGE_CHILDREN) [s].
double processor_seconds_of(int who) {
  struct rusage used {};
  ::getrusage(who, &used);
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

template <class Action>
double processor_seconds(int who, const Action& action) {
  const double before = processor_seconds_of(who);
  action();
  return processor_seconds_of(who) - before;
}

std::string values(int side, double first, double step) {
  std::string text;
  for (int k = 0; k < side; ++k) text += fmt::format("{}{}", k ? ", " : "", first + step * k);
  return "[" + text + "]";
}

/// Writes stages that compute nothing but do all file handling of the real ones.
void write_stages(const Folder& folder) {
  for (const char* stage : {"sim", "strain", "fatigue"})
    fs::copy_file(DRESSLIFE_FAKE_STAGE, folder.path / "programs" / (std::string("dresslife-") + stage));
}

}  // namespace

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::max(1, std::atoi(argv[1])) : 100, jobs = side * side;  // two varied keys
  const double scale = 10'000.0 / jobs;
  const Folder folder;
  write_stages(folder);
  folder.write("job.yaml", sample_job);
  const std::string text =
      fmt::format("base: job.yaml\nvary:\n  dresspack.bending_stiffness_Nm2: {}\n  simulation.segments: {}\n",
                  values(side, 2, 0.01), values(side, 20, 1));
  const StudyRequest request{folder.write("many.yaml", text), {}, folder.path / "runs", folder.path / "programs"};
  StudyState standing;
  double expanding = 0;
  const auto graph = [&] {
    standing = {};
    expanding = seconds([&] { standing = expanded(request); });
    write_build_graph(standing.study, standing.places, standing.states);
  };
  double wall = 0;
  double processor = processor_seconds(RUSAGE_SELF, [&] { wall = seconds(graph); });
  std::printf("expand_10k_s %.3f\n", scale * expanding);
  std::printf("graph_10k_s %.3f\ngraph_10k_processor_s %.3f\n", scale * wall, scale * processor);
  BuildResult built;
  processor = processor_seconds(RUSAGE_CHILDREN, [&] {
    wall = seconds([&] {
      built = run_build_graph(standing.places, 2, {});
      close_run(standing.study, standing.places, built, standing.states, standing.digests);
    });
  });
  if (built.executed != 3 * jobs) return 1;
  std::printf("overhead_ms_per_job %.3f\n", 1e3 * wall / jobs);
  std::printf("overhead_processor_ms_per_job %.3f\n", 1e3 * processor / jobs);
  processor = processor_seconds(RUSAGE_SELF, [&] { wall = seconds(graph); });
  if (!standing.all_done()) return 1;
  std::printf("noop_10k_s %.3f\nnoop_10k_processor_s %.3f\n", scale * wall, scale * processor);
  std::string csv;
  const double gathering =
      seconds([&] { csv = ranking_csv(ranking_of(standing.study, standing.places, standing.states)); });
  if (std::count(csv.begin(), csv.end(), '\n') != jobs + 1) return 1;
  std::printf("gather_10k_s %.3f\n", scale * gathering);
  struct rusage used {};
  ::getrusage(RUSAGE_SELF, &used);
  std::printf("study_10k_mb %.1f\n", used.ru_maxrss / 1024.0);
}
