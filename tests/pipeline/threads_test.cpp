#include "pipeline/threads.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <vector>

#include "pipeline/errors.h"

namespace dresslife::pipeline {
namespace {

/// The environment variable as a test wants it, put back afterwards.
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

}  // namespace
}  // namespace dresslife::pipeline
