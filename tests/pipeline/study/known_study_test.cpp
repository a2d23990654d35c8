// Remembered studies, and the changes that invalidate them.
#include "pipeline/study/known_study.h"

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
    remember(request_, standing);
    const BuildResult built = run_build_graph(standing.places, 2, {});
    close_run(standing.study, standing.places, built, standing.states, standing.digests);
    return built.executed;
  }
  StudyState standing() const { return standing_of(request_); }
  StudyRequest& request() { return request_; }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
  StudyRequest request_;
};

void check_same(const StudyState& one, const StudyState& other) {
  CHECK(one.study.name == other.study.name);
  REQUIRE(one.states.size() == other.states.size());
  for (std::size_t k = 0; k < one.states.size(); ++k) {
    CHECK(one.study.jobs[k].name == other.study.jobs[k].name);
    CHECK(one.states[k].recipes == other.states[k].recipes);
    CHECK(one.states[k].settings == other.states[k].settings);
    CHECK(one.states[k].words().line() == other.states[k].words().line());
    CHECK(one.states[k].results == other.states[k].results);
  }
}

}  // namespace

TEST_CASE("known study: the note equals the expansion of the study and its states") {
  Bench bench;
  CHECK_FALSE(bench.standing().remembered);  // before the first run
  CHECK(bench.run() == 6);
  const StudyState known = bench.standing();
  REQUIRE(known.remembered);
  CHECK(known.all_done());
  check_same(known, expanded(bench.request()));
  fs::remove(known.places.life(known.study.jobs[1].name));
  const StudyState broken = bench.standing();
  CHECK(broken.remembered);
  CHECK_FALSE(broken.all_done());
  check_same(broken, expanded(bench.request()));
}

TEST_CASE("known study: its jobs are read back as the study expands them") {
  Bench bench;
  bench.scratch().write("study.yaml", "base: job.yaml\njobs: {one: {}, same: {}, other: {simulation.segments: 30}}\n");
  bench.run();
  StudyState known = bench.standing();
  REQUIRE(known.remembered);
  REQUIRE_FALSE(known.study.jobs.front().job);
  read_jobs(known);
  const StudyState made_again = expanded(bench.request());
  REQUIRE(known.study.jobs.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(job_text(*known.study.jobs[k].job) == job_text(*made_again.study.jobs[k].job));
  CHECK(known.study.jobs[0].job == known.study.jobs[1].job);  // the same recipes
  CHECK(known.study.jobs[0].job != known.study.jobs[2].job);
}

TEST_CASE("known study: jobs with ratings are remembered, too, and say so") {
  Bench bench;
  bench.run();
  CHECK_FALSE(bench.standing().rated);
  const auto rating = [](const char* twist) {
    return fmt::format(
        "dresspack.ratings: [{{rig: {{kind: torsion, twist_deg_per_m: {}}}, cycles: 1e+6, source: data sheet}}]",
        twist);
  };
  bench.scratch().write(
      "study.yaml", fmt::format("base: job.yaml\njobs:\n  a: {{{0}}}\n  b: {{{1}}}\n  c: {{{0}, routing.free_length_m: "
                                "1.3}}\n  d: {{{1}, strain.slip: stick}}\n  e: {{}}\n",
                                rating("360"), rating("180")));
  bench.run();
  const StudyState known = bench.standing();
  REQUIRE(known.remembered);
  CHECK(known.rated);
  const StudyState made_again = expanded(bench.request());
  check_same(known, made_again);
  // a and b have the same recipes: no stage reads the ratings of a cable with wires.
  CHECK(known.states[0].recipes == known.states[1].recipes);
  const RatedStudy read = rated_study(with_dresspacks(known)), expected = rated_study(made_again.study);
  REQUIRE(expected.cables.size() == 4);
  CHECK(expected.rigs.jobs.size() == 3);
  REQUIRE(read.cables.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(read.cables[k].job == made_again.study.jobs[k].name);
    CHECK(read.cables[k].job == expected.cables[k].job);
    CHECK(read.cables[k].rig_job == expected.cables[k].rig_job);
    CHECK(read.cables[k].rig == expected.cables[k].rig);
  }
  CHECK(read.cables[0].rig_job != read.cables[1].rig_job);
  CHECK(read.cables[0].rig_job == read.cables[2].rig_job);
}

TEST_CASE("known study: a touched file changes nothing, a changed one all that depends on it") {
  Bench bench;
  bench.run();
  const Scratch& scratch = bench.scratch();
  const std::vector<std::string> files{"study.yaml", "job.yaml", "config/materials/own.yaml"};
  for (const std::string& file : files) {
    fs::last_write_time(scratch / file, fs::file_time_type::clock::now() + std::chrono::hours(24));
    CHECK(bench.standing().remembered);
  }
  // A changed material runs only the fatigue stages of both jobs, whatever the file's date.
  const auto before = fs::last_write_time(scratch / files[2]);
  scratch.write(files[2],
                "from: copper\nname: own\nwalker_exponent: 0.4\n");  // the forces of cables do not depend on it
  fs::last_write_time(scratch / files[2], before);
  const StudyState changed = bench.standing();
  CHECK_FALSE(changed.remembered);
  for (const JobState& state : changed.states) CHECK(state.next == 2);
  CHECK(bench.run() == 2);
  CHECK(bench.standing().remembered);
}

TEST_CASE("known study: a note that could expand to something else is not used") {
  const auto forgets = [](const std::string& what, const std::function<void(Bench&)>& change) {
    INFO(what);
    Bench bench;
    bench.run();
    REQUIRE(bench.standing().remembered);
    change(bench);
    CHECK_FALSE(bench.standing().remembered);
  };
  forgets("another setting", [](Bench& bench) { bench.request().sets = {"simulation.contact=true"}; });
  forgets("a comment", [](Bench& bench) {
    bench.scratch().write("study.yaml", bytes_of(bench.scratch() / "study.yaml") + "# more\n");
  });
  forgets("an entry nearer to the job", [](Bench& bench) {  // the search did not find it there before
    bench.scratch().write("materials/own.yaml", "from: copper\nname: own\nfatigue_ductility: 0.5\n");
  });
  forgets("a stage",
          [](Bench& bench) { std::ofstream(bench.scratch() / "programs/dresslife-fatigue", std::ios::app) << "more"; });
  forgets("a job's settings", [](Bench& bench) { bench.scratch().write("runs/study/segments=20/job.yaml", "mine\n"); });
  forgets("its own bytes", [](Bench& bench) {
    std::string bytes = bytes_of(bench.scratch() / "runs/study/.stage/study");
    bytes[bytes.size() / 2] ^= 1;
    bench.scratch().write("runs/study/.stage/study", bytes);
  });
  forgets("another catalogue", [](Bench&) { ::setenv("DRESSLIFE_CONFIG", DRESSLIFE_SOURCE_DIR "/config/", 1); });
  ::unsetenv("DRESSLIFE_CONFIG");
  forgets("a job that cannot be run", [](Bench& bench) {
    bench.scratch().write("study.yaml", "base: job.yaml\nvary: {simulation.segments: [20, -1]}\n");
    bench.run();
  });
}

TEST_CASE("known study: receipts contain the values of the life files, bit by bit") {
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
