// The states of a study after changes of its files.
#include "pipeline/study/study_state.h"

#include <functional>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/relative_life.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

namespace fs = std::filesystem;

/// A study of two jobs that take a material and a motion from files, run with stages that compute nothing.
class Bench {
 public:
  Bench() {
    fs::create_directories(scratch_ / "programs");
    for (const char* stage : {"sim", "strain", "fatigue"})
      fs::copy_file(DRESSLIFE_FAKE_STAGE, scratch_ / "programs" / (std::string("dresslife-") + stage));
    std::string job = sample_job;
    job.replace(job.find("material: copper}"), 17, "material: own}");
    scratch_.write("job.yaml", job);
    scratch_.write("config/materials/own.yaml", "from: copper\nname: own\n");
    scratch_.write("study.yaml", "base: job.yaml\nvary: {simulation.segments: [20, 30]}\n");
    request_ = {scratch_ / "study.yaml", {}, scratch_ / "runs", scratch_ / "programs"};
  }
  /// Runs the study as `dresslife run` does. Returns the number of stages that ran.
  int run() {
    StudyState standing = expanded(request_);
    write_build_graph(standing.study, standing.places, standing.states);
    const BuildResult built = run_build_graph(standing.places, 2, {});
    close_run(standing.study, standing.places, built, standing.states, standing.digests);
    return built.executed;
  }
  StudyState standing() const { return expanded(request_); }
  StudyRequest& request() { return request_; }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
  StudyRequest request_;
};

}  // namespace

TEST_CASE("study state: a touched file changes nothing, a changed one all that depends on it") {
  Bench bench;
  bench.run();
  const Scratch& scratch = bench.scratch();
  const std::vector<std::string> files{"study.yaml", "job.yaml", "config/materials/own.yaml"};
  for (const std::string& file : files) {
    fs::last_write_time(scratch / file, fs::file_time_type::clock::now() + std::chrono::hours(24));
    CHECK(bench.standing().all_done());
  }
  // A changed material runs only the fatigue stages of both jobs, whatever the file's date.
  const auto before = fs::last_write_time(scratch / files[2]);
  scratch.write(files[2],
                "from: copper\nname: own\nwalker_exponent: 0.4\n");  // the forces of cables do not depend on it
  fs::last_write_time(scratch / files[2], before);
  const StudyState changed = bench.standing();
  for (const JobState& state : changed.states) CHECK(state.next == 2);
  CHECK(bench.run() == 2);
  CHECK(bench.standing().all_done());
}

TEST_CASE("study state: receipts contain the values of the life files, bit by bit") {
  Bench bench;
  bench.run();
  const StudyState known = bench.standing();
  std::vector<RankingRow> by_receipts = ranking_of(known.study, known.places, known.states);
  std::vector<JobState> without_results = known.states;
  for (JobState& state : without_results) state.results.clear();
  CHECK(ranking_csv(by_receipts) == ranking_csv(ranking_of(known.study, known.places, without_results)));
  // A receipt with a changed bit is invalid.
  const fs::path receipt = known.places.job(known.study.jobs[0].name) / ".stage/fatigue.receipt";
  const std::string bytes = bytes_of(receipt);
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::string turned = bytes;
    turned[at] = static_cast<char>(turned[at] ^ 4);
    std::ofstream(receipt, std::ios::binary) << turned;
    CHECK_FALSE(read_receipt(receipt));
  }
  std::ofstream(receipt, std::ios::binary) << bytes;
  CHECK(read_receipt(receipt));
}
