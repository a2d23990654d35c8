#include "pipeline/base/progress.h"

#include <fcntl.h>
#include <unistd.h>

#include <thread>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

TEST_CASE("progress: the remaining time is that of the work done so far, and nothing is said too early") {
  CHECK(remaining_words(10, 0, 0.5) == "10 s left");
  CHECK(remaining_words(60, 0, 0.25) == "3 min left");
  CHECK(remaining_words(3600, 0, 0.1) == "9.0 h left");
  CHECK(remaining_words(60, 0.5, 0.75) == "60 s left");  // half was already done at the begin
  CHECK(remaining_words(1, 0, 0.5) == "");
  CHECK(remaining_words(100, 0, 0.009) == "");
  CHECK(remaining_words(100, 0, 1) == "");
  CHECK(remaining_words(3, 0, 0.999) == "1 s left");
}

TEST_CASE("progress: a log has a line per interval, however short the pieces of work are") {
  const Scratch scratch;
  const int terminal = ::dup(STDERR_FILENO), file = ::open((scratch / "log").c_str(), O_CREAT | O_WRONLY, 0600);
  ::dup2(file, STDERR_FILENO);
  constexpr std::chrono::milliseconds interval{100};
  Progress::set_log_interval(interval);
  const auto begun = Progress::Clock::now();
  int pieces = 0;
  while (Progress::Clock::now() - begun < 5 * interval) {
    Progress piece("piece", false);
    piece.show(0.5, "half");
    std::this_thread::sleep_for(interval / 5);
    ++pieces;
  }
  Progress::set_log_interval(std::chrono::minutes{1});
  ::dup2(terminal, STDERR_FILENO);
  ::close(terminal), ::close(file);
  const std::string log = bytes_of(scratch / "log");
  INFO(log);
  CHECK(pieces > 2);
  CHECK(count_of(log, "piece:  50.0 %  half\n") >= 1);
  CHECK(count_of(log, "piece:") <= 5);  // at most one per interval
}
