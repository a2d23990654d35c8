#include "pipeline/study/shards.h"

#include <set>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Returns jobs with three different simulations in turn. The last job cannot run.
StudyState standing_of_jobs(std::size_t count) {
  StudyState standing;
  standing.study.name = "study";
  standing.study.keep = Keep::lives;
  for (std::size_t k = 0; k < count; ++k) {
    standing.study.jobs.push_back({fmt::format("job{}", k), nullptr, k + 1 == count ? "cannot run" : ""});
    JobState state;
    state.recipes[0] = fmt::format("sim{}", k % 3);
    standing.states.push_back(state);
  }
  return standing;
}

TEST_CASE("shards: together they have every job once, whatever is done, with like simulations side by side") {
  for (const std::size_t jobs : {1u, 2u, 7u, 30u})
    for (const int count : {1, 2, 3, 5, 8}) {
      std::set<std::string> seen;
      std::size_t sum = 0, simulations = 0, most = 0;
      for (int index = 1; index <= count; ++index) {
        StudyState standing = standing_of_jobs(jobs);
        if (index % 2 == 0) standing.states[0].next = stage_count;
        keep_shard(standing, {index, count});
        CHECK(standing.places.shard == fmt::format("{}_of_{}", index, count));
        CHECK(standing.study.keep == Keep::lives);
        REQUIRE(standing.study.jobs.size() == standing.states.size());
        std::set<std::string> here;
        for (std::size_t k = 0; k < standing.states.size(); ++k) {
          seen.insert(standing.study.jobs[k].name);
          here.insert(standing.states[k].recipes[0]);
        }
        sum += standing.states.size();
        simulations += here.size();
        most = std::max(most, standing.states.size());
      }
      CHECK(seen.size() == jobs);
      CHECK(sum == jobs);
      CHECK(simulations <= 3 + static_cast<std::size_t>(count) - 1);  // a cut splits at most one
      CHECK(most == (jobs + static_cast<std::size_t>(count) - 1) / static_cast<std::size_t>(count));
    }
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
  for (const char* text :
       {"", "2", "2/", "/8", "0/8", "9/8", "-1/8", "2/8/9", "2 / 8", "2/99999999", "a/b"}) {
    INFO(text);
    CHECK_THROWS_WITH(shard_from(text, "--shard"), Catch::Contains("is no shard") && Catch::Contains("K/N"));
  }
}

}  // namespace
}  // namespace dresslife::pipeline
