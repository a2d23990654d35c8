// Numbers and texts as people read them.
#include "pipeline/base/readable.h"

#include <limits>

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("readable: numbers are rounded before they are written") {
  CHECK(readable(999.6) == "1,000");
  CHECK(readable(-1234567) == "-1,230,000");
  CHECK(readable(0.01236) == "0.0124");
  CHECK(readable(0) == "0");
  CHECK(readable(std::numeric_limits<double>::infinity()) == "unlimited");
  CHECK(readable(std::nan("")) == "-");
}

TEST_CASE("readable: every double has words, the smallest and the largest too") {
  using Limits = std::numeric_limits<double>;
  CHECK(readable(Limits::denorm_min()) == "4.94e-324");
  CHECK(readable(Limits::min()) == "2.23e-308");
  CHECK(readable(Limits::max()) == "1.80e+308");  // beyond the largest, once rounded
  CHECK(readable(-Limits::max(), 1) == "-2e+308");
  CHECK(calendar_words(Limits::denorm_min()) == "less than a day");
}
