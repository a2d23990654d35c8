#include "pipeline/base/threads.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <numeric>
#include <vector>

#include "pipeline/base/errors.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

/// Sets the environment variable for a test and restores it afterwards.
class Setting {
 public:
  explicit Setting(const char* value) {
    if (const char* old = std::getenv(name)) before_ = old, was_set_ = true;
    value ? ::setenv(name, value, 1) : ::unsetenv(name);
  }
  ~Setting() { was_set_ ? ::setenv(name, before_.c_str(), 1) : ::unsetenv(name); }

 private:
  static constexpr const char* name = "DRESSLIFE_THREADS";
  std::string before_;
  bool was_set_ = false;
};

TEST_CASE("threads: as many as the environment says, else some") {
  {
    const Setting three("3");
    CHECK(thread_count() == 3);
  }
  {
    const Setting unset(nullptr);
    CHECK(thread_count() >= 1);
  }
  for (const char* wrong : {"", "0", "-2", "two", "2x", "99999"}) {
    const Setting setting(wrong);
    CHECK_THROWS_WITH(thread_count(), Catch::Contains("DRESSLIFE_THREADS: error: is '" + std::string(wrong) +
                                                      "' (must be a whole number, 1 .. 1024); set it to"));
  }
}

TEST_CASE("threads: every part once, and the failure of the lowest part is thrown") {
  for (const std::size_t parts : {0, 1, 2, 7}) {
    std::vector<int> calls(parts, 0);
    in_parallel(parts, [&](std::size_t part) { ++calls[part]; });
    CHECK(calls == std::vector<int>(parts, 1));
  }
  std::vector<int> finished(4, 0);
  const auto work = [&](std::size_t part) {
    if (part % 2 == 1) throw InputError({}, "part " + std::to_string(part), "repair it");
    finished[part] = 1;
  };
  CHECK_THROWS_WITH(in_parallel(4, work), Catch::Contains("part 1"));
  CHECK(finished == std::vector<int>{1, 0, 1, 0});
}

TEST_CASE("threads: in order, everything is worked on once and used in its turn, no more than so many ahead") {
  for (const std::size_t threads : {1, 2, 3, 8})
    for (const std::size_t count : {0, 1, 5, 200})
      for (const std::size_t ahead : {1, 2, 7}) {
        std::vector<int> worked(count, 0);
        std::vector<std::size_t> used, place(ahead);
        std::atomic<std::size_t> in_use = 0;
        std::atomic<bool> too_far = false;
        in_order(
            threads, count, ahead,
            [&](std::size_t part, std::size_t k) {
              if (part >= threads || k >= in_use + ahead) too_far = true;
              ++worked[k];
              place[k % ahead] = k;
            },
            [&](std::size_t k) {
              used.push_back(place[k % ahead]);
              ++in_use;
            });
        CHECK(worked == std::vector<int>(count, 1));
        std::vector<std::size_t> all(count);
        std::iota(all.begin(), all.end(), std::size_t{0});
        CHECK(used == all);
        CHECK_FALSE(too_far);
      }
}

TEST_CASE("threads: in order, a failure is thrown when its turn comes") {
  for (const std::size_t threads : {1, 2, 5}) {
    std::vector<std::size_t> used;
    const auto use = [&](std::size_t k) { used.push_back(k); };
    const auto fail_from = [&](std::size_t first) {
      return [first](std::size_t, std::size_t k) {
        if (k >= first) throw InputError({}, "number " + std::to_string(k), "repair it");
      };
    };
    CHECK_THROWS_WITH(in_order(threads, 50, 4, fail_from(7), use), Catch::Contains("number 7"));
    CHECK(used == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6});
    const auto refuse = [](std::size_t k) {
      if (k == 3) throw InputError({}, "use 3", "repair it");
    };
    CHECK_THROWS_WITH(in_order(threads, 50, 4, fail_from(99), refuse), Catch::Contains("use 3"));
  }
}

#ifndef __SANITIZE_ADDRESS__  // which needs more address space than a limit would leave
TEST_CASE("threads: where the system gives none, the caller's own does all the work") {
  const pid_t child = ::fork();
  if (child == 0) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t room = 20 << 20;  // two stacks of 8 MB
    const struct rlimit limit { pages * 4096 + room, pages * 4096 + room };
    ::setrlimit(RLIMIT_AS, &limit);
    std::vector<std::atomic<int>> calls(40);
    std::mutex gate;
    gate.lock();  // no thread ends, so none makes room for the next
    in_parallel(calls.size(), [&](std::size_t part) {
      if (part == 0) gate.unlock();
      gate.lock();
      gate.unlock();
      ++calls[part];
    });
    std::size_t used = 0;
    in_order(
        40, 100, 8, [](std::size_t, std::size_t) {}, [&](std::size_t k) { used += k == used; });
    const bool all = std::all_of(calls.begin(), calls.end(), [](const auto& count) { return count == 1; });
    ::_exit(all && used == 100 && beside<int>([] { return 7; }).get() == 7 ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
}
#endif

TEST_CASE("threads: work beside gives its result and its failure") {
  for (const char* threads : {"1", "2"}) {
    const Setting setting(threads);
    CHECK(beside<int>([] { return 7; }).get() == 7);
    CHECK_THROWS_WITH(beside<int>([]() -> int { throw InputError({}, "it fails", "repair it"); }).get(),
                      Catch::Contains("it fails"));
  }
}

}  // namespace
}  // namespace dresslife::pipeline
