#include "pipeline/study/shards.h"

#include <set>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Returns variants with three different simulations in turn, each with another metal.
std::vector<Variant> variants_of(std::size_t count) {
  std::vector<Variant> variants;
  for (std::size_t k = 0; k < count; ++k) {
    const auto change = [](const std::string& path, std::size_t value) {
      return Change{path, scalar(std::to_string(value)), {}};
    };
    variants.push_back(
        {fmt::format("job{}", k), {change("routing.free_length_m", k % 3), change("fatigue.scale", k)}, {}});
  }
  return variants;
}

TEST_CASE("shards: together they have every job once, with like simulations side by side") {
  for (const std::size_t jobs : {1u, 2u, 7u, 30u})
    for (const int count : {1, 2, 3, 5, 8}) {
      std::set<std::size_t> seen;
      std::size_t sum = 0, simulations = 0, most = 0;
      for (int index = 1; index <= count; ++index) {
        const std::vector<std::size_t> part = part_of(variants_of(jobs), {index, count});
        CHECK(std::is_sorted(part.begin(), part.end()));
        std::set<std::size_t> here;
        for (const std::size_t k : part) seen.insert(k), here.insert(k % 3);
        sum += part.size();
        simulations += here.size();
        most = std::max(most, part.size());
      }
      CHECK(seen.size() == jobs);
      CHECK(sum == jobs);
      CHECK(simulations <= 3 + static_cast<std::size_t>(count) - 1);  // a cut splits at most one
      CHECK(most == (jobs + static_cast<std::size_t>(count) - 1) / static_cast<std::size_t>(count));
    }
}

TEST_CASE("shards: only the jobs of a shard are read, as in the whole study") {
  Scratch scratch;
  scratch.write("job.yaml", sample_job);
  scratch.write("study.yaml",
                "base: job.yaml\njobs: {soft: {}, hard: {dresspack.bending_stiffness_Nm2: none}}\n"
                "vary: {strain.slip: [free, stick]}\n");
  const Study whole = read_study(scratch / "study.yaml");
  REQUIRE(whole.jobs.size() == 4);
  std::size_t k = 0;
  for (const int index : {1, 2, 3})
    for (const StudyJob& job : read_study(scratch / "study.yaml", {}, Shard{index, 3}).jobs) {
      const StudyJob& same = whole.jobs.at(k++);
      CHECK(job.name == same.name);
      CHECK(job.values == same.values);
      CHECK(job.failure == same.failure);
      REQUIRE((job.job == nullptr) == (same.job == nullptr));
      if (job.job) CHECK(job_text(*job.job) == job_text(*same.job));
    }
  CHECK(k == whole.jobs.size());
  scratch.write("study.yaml", "base: job.yaml\njobs: {a b: {}, c: {}, a_b: {}}\n");
  CHECK_THROWS_WITH(read_study(scratch / "study.yaml", {}, Shard{2, 3}), Catch::Contains("two jobs are named 'a_b'"));
}

/// Returns jobs; the last one cannot run.
StudyState standing_of_jobs(std::size_t count) {
  StudyState standing;
  for (std::size_t k = 0; k < count; ++k)
    standing.study.jobs.push_back({fmt::format("job{}", k), nullptr, k + 1 == count ? "cannot run" : ""});
  standing.states.resize(count);
  return standing;
}

TEST_CASE("shards: as many as keep each within what may be started, of the jobs that can run") {
  CHECK(shards_needed(standing_of_jobs(11), 30) == 1);
  CHECK(shards_needed(standing_of_jobs(12), 30) == 2);
  CHECK(shards_needed(standing_of_jobs(11), 3) == 10);
  StudyState mostly_done = standing_of_jobs(101);
  for (std::size_t k = 0; k < 90; ++k) mostly_done.states[k].next = stage_count;
  CHECK(shards_needed(mostly_done, 30) == 1);
}

TEST_CASE("shards: words that are none are refused") {
  CHECK(shard_from("2/8", "--shard").name() == "2_of_8");
  CHECK(shard_from("8/8", "--shard").index == 8);
  for (const char* text : {"", "2", "2/", "/8", "0/8", "9/8", "-1/8", "2/8/9", "2 / 8", "2/99999999", "a/b"}) {
    INFO(text);
    CHECK_THROWS_WITH(shard_from(text, "--shard"), Catch::Contains("is no shard") && Catch::Contains("K/N"));
  }
}

}  // namespace
}  // namespace dresslife::pipeline
