// What the study runner costs itself: ten thousand jobs whose stages compute nothing but do all that a stage
// does around it (job, receipt, checksums, files synced), so that all time is ours, Ninja's and the operating
// system's.
//
// graph_10k_s: to read the study, expand it and write settings and build graph, the first time.
// overhead_ms_per_job: wall time per job of running it, three stages as processes, two at a time.
// noop_10k_s: to find that nothing is left to do: reading, expanding, comparing.
// gather_10k_s: to read the root attributes of all life files and rank them.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "pipeline/files/digest.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/ranking.h"
#include "pipeline/whole_file.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/sample_life.h"

namespace {

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

constexpr int side = 100, jobs = side * side;  // two varied keys

/// A folder that lives as long as this.
struct Folder {
  fs::path path = fs::temp_directory_path() / fmt::format("dresslife-bench-{}", ::getpid());
  Folder() { fs::create_directories(path / "programs"); }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& text) const {
    write_text_if_changed(path / name, text);
    return path / name;
  }
};

template <class Action>
double seconds(const Action& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string values(double first, double step) {
  std::string text;
  for (int k = 0; k < side; ++k) text += fmt::format("{}{}", k ? ", " : "", first + step * k);
  return "[" + text + "]";
}

/// Stages that compute nothing: all plumbing of the real ones.
void write_stages(const Folder& folder) {
  for (const char* stage : {"sim", "strain", "fatigue"})
    fs::copy_file(DRESSLIFE_FAKE_STAGE, folder.path / "programs" / (std::string("dresslife-") + stage));
}

}  // namespace

int main() {
  const Folder folder;
  write_stages(folder);
  folder.write("job.yaml", sample_job);
  const fs::path file = folder.write(
      "many.yaml",
      fmt::format("base: job.yaml\nvary:\n  dresspack.bending_stiffness_Nm2: {}\n  simulation.segments: {}\n",
                  values(2, 0.01), values(20, 1)));
  const StudyPlaces places{folder.path / "runs/many", folder.path / "programs"};
  Study study;
  std::vector<JobState> states;
  const auto graph = [&] {
    study = read_study(file);
    states = states_of(study, places);
    write_build_graph(study, places, states);
  };
  std::printf("graph_10k_s %.3f\n", seconds(graph));
  BuildResult built;
  const double running = seconds([&] {
    built = run_build_graph(places, 2, {});
    close_run(study, places, built, states);
  });
  if (built.executed != 3 * jobs) return 1;
  std::printf("overhead_ms_per_job %.3f\n", 1e3 * running / jobs);
  const double nothing = seconds(graph);
  if (!std::all_of(states.begin(), states.end(), [](const JobState& state) { return state.done(); }))
    return 1;
  std::printf("noop_10k_s %.3f\n", nothing);
  std::vector<JobResult> results;
  for (const StudyJob& job : study.jobs) results.push_back({job.name, places.life(job.name), job.failure});
  std::string csv;
  const double gathering = seconds([&] { csv = ranking_csv(read_ranking(results)); });
  if (std::count(csv.begin(), csv.end(), '\n') != jobs + 1) return 1;
  std::printf("gather_10k_s %.3f\n", gathering);
}
