#include "pipeline/stage/memory.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Answer = MemoryClaims::Answer;

/// Another process that does nothing.
class Other {
 public:
  Other() : process_(::fork()) {
    if (process_ != 0) return;
    for (;;) ::pause();
  }
  ~Other() { end(); }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;
  pid_t process() const { return process_; }
  void end() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_;
};

}  // namespace

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
  const Format format{"f", 1, "p", "t",
                      {{"/few", Type::f64, {"row", "2"}, "m", ""},
                       {"/many", Type::f64, {"sample", "row"}, "m", ""},
                       {"/absent", Type::f64, {"other"}, "m", ""}},
                      {}};
  const double few = 100 * 2 * 8;
  CHECK(file_buffers(format, {{"row", 100}}) == 2 * few);  // of /many there are no samples
  const double cache = 1 << 20, on_its_way = 2 << 16;
  CHECK(file_buffers(format, {{"row", 100}, {"sample", 1'000'000}}) == 2 * few + cache + on_its_way);
}

TEST_CASE("memory: what is free is given, and nobody is waited for where nobody works") {
  const Scratch scratch;
  const auto free = [] { return std::optional<double>(100); };
  const MemoryClaims alone("", free), first(scratch / "memory", free);
  CHECK(alone.ask(100) == Answer::given);
  CHECK(alone.ask(101) == Answer::never);
  CHECK(first.ask(101) == Answer::never);
  CHECK(first.ask(99) == Answer::given);
  CHECK(first.ask(99) == Answer::given);  // its own claim does not stand in its way
  CHECK(MemoryClaims(scratch / "other", [] { return std::optional<double>(); }).ask(1e9) == Answer::given);
}

TEST_CASE("memory: what another stage was given and has not taken yet is not free, until it ends") {
  const Scratch scratch;
  const MemoryClaims claims(scratch / "memory", [] { return std::optional<double>(1000); });
  Other other, small;
  // What it holds already is no longer among the free: a few megabytes of this test.
  scratch.write("memory", fmt::format("{} 900\n{} 1\n", other.process(), small.process()));
  CHECK(claims.ask(50) == Answer::given);
  CHECK(claims.ask(500) == Answer::wait);
  CHECK(bytes_of(scratch / "memory").starts_with(fmt::format("{} 900\n{} 1\n", other.process(), small.process())));
  other.end();
  CHECK(claims.ask(500) == Answer::given);
  CHECK(bytes_of(scratch / "memory") == fmt::format("{} 1\n{} 500\n", small.process(), ::getpid()));
  CHECK(claims.ask(2000) == Answer::wait);  // the small one will end, too
  small.end();
  CHECK(claims.ask(2000) == Answer::never);
}

TEST_CASE("memory: what the machine has free is told and is not more than it has") {
  const std::optional<double> free = free_memory_mb();
  if (!free) return;
  CHECK(*free > 0);
  CHECK(*free <= static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20));
}

}  // namespace dresslife::pipeline
