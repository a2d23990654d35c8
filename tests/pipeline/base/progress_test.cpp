#include "pipeline/base/progress.h"
#include "tests/catch.h"


using namespace dresslife::pipeline;

TEST_CASE("progress: the remaining time is that of the work done so far, and nothing is said too early") {
  CHECK(remaining_words(10, 0, 0.5) == "10 s left");
  CHECK(remaining_words(60, 0, 0.25) == "3 min left");
  CHECK(remaining_words(3600, 0, 0.1) == "9.0 h left");
  CHECK(remaining_words(60, 0.5, 0.75) == "60 s left");  // half was there at the beginning
  CHECK(remaining_words(1, 0, 0.5) == "");
  CHECK(remaining_words(100, 0, 0.009) == "");
  CHECK(remaining_words(100, 0, 1) == "");
  CHECK(remaining_words(3, 0, 0.999) == "1 s left");
}
