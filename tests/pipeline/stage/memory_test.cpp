#include "pipeline/stage/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include "pipeline/base/limits.h"
#include "pipeline/base/progress.h"
#include "pipeline/files/files.h"
#include "pipeline/stage/stage.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {

TEST_CASE("memory: needs add up, and the largest that a key can change is named") {
  constexpr double megabyte = 1 << 20;
  MemoryNeed need;
  CHECK(need.largest() == "");
  need.add(30 * megabyte, "the program");
  need.add(5 * megabyte, "histories of 3 segments", "fewer segments");
  need.add(7.5 * megabyte, "sites", "fewer wires");
  CHECK(need.megabytes() == 42.5);
  CHECK(need.largest() == "sites 8 MB");
  CHECK(need.remedy() == "fewer wires");
}

TEST_CASE("memory: a file's buffers are its data, or the library's cache where that is smaller") {
  const Format format{"f",
                      1,
                      "p",
                      "t",
                      {{"/few", Type::f64, {"row", "2"}, "m", ""},
                       {"/many", Type::f64, {"sample", "row"}, "m", ""},
                       {"/packed", Type::f64, {"sample"}, "m", "", false, false, false, 3},
                       {"/absent", Type::f64, {"other"}, "m", ""}},
                      {}};
  const double few = 100 * 2 * 8;
  CHECK(file_buffers(format, {{"row", 100}}) == 2 * few);  // without samples
  const double cache = 1 << 20, on_its_way = 2 << 16, packed = 3 * 131'072;
  CHECK(file_buffers(format, {{"row", 100}, {"sample", 1'000'000}}) == 2 * few + cache + on_its_way + packed);
}

TEST_CASE("memory: the free memory of the machine is known and is not more than its memory") {
  const std::optional<double> free = free_memory_mb();
  if (!free) return;
  CHECK(*free > 0);
  CHECK(*free <=
        static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20));
}

TEST_CASE("memory: a job runs that is within the limit and what is free, and no other") {
  StageCall call;
  call.input = "motion.h5";
  const auto refusal = [&](double megabytes) {
    MemoryNeed need;
    need.add(megabytes * (1 << 20), "sites", "fewer wires");
    Progress quiet("stage", true);
    return message_of([&] { require_memory(call, need, quiet); });
  };
  CHECK(refusal(1) == "");
  if (const std::optional<double> free = free_memory_mb())  // a hundred times the free memory is never available
    CHECK_THAT(refusal(100 * *free), Catch::StartsWith("motion.h5: error: takes about") &&
                                         Catch::Contains("are free") && Catch::Contains("choose fewer wires"));
  call.limits.megabytes = 1;  // a smaller need would limit this test program itself
  CHECK_THAT(refusal(1.5), Catch::Contains("--job-memory allows 1 MB") && Catch::Contains("or allow more"));
}

TEST_CASE("memory: a limit of so many megabytes that their bytes exceed 64 bits does not limit") {
  struct rlimit before {
  }, after{};
  REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
  limit_memory(std::uint64_t{1} << 44);
  REQUIRE(::getrlimit(RLIMIT_AS, &after) == 0);
  ::setrlimit(RLIMIT_AS, &before);
  CHECK(after.rlim_cur == before.rlim_cur);
}

}  // namespace dresslife::pipeline
