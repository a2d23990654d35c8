// Numbers and texts in readable form.
#include "pipeline/base/readable.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "pipeline/base/joined.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("readable: every double has words, the smallest and the largest too") {
  using Limits = std::numeric_limits<double>;
  CHECK(readable(Limits::denorm_min()) == "4.94e-324");
  CHECK(readable(Limits::min()) == "2.23e-308");
  CHECK(readable(Limits::max()) == "1.80e+308");  // larger than the largest after rounding
  CHECK(readable(-Limits::max(), 1) == "-2e+308");
  CHECK(calendar_words(Limits::denorm_min()) == "less than a day");
}

TEST_CASE("readable: three figures, thousands apart, powers of ten only far out") {
  CHECK(calendar_words(68.24) == "5.7 years");
  CHECK(calendar_words(13.24) == "13.2 months");
  CHECK(calendar_words(1) == "1.00 months");
  CHECK(calendar_words(0.0525) == "1.6 days");
  CHECK(calendar_words(0.001) == "less than a day");
  CHECK(calendar_words(std::numeric_limits<double>::infinity()) == "unlimited");
  CHECK(readable(0) == "0");
  CHECK(readable(1) == "1.00");
  CHECK(readable(0.0123456) == "0.0123");
  CHECK(readable(0.01236) == "0.0124");
  CHECK(readable(9.999e8) == "1.00e+09");
  CHECK(readable(9.98e8) == "998,000,000");
  CHECK(readable(1.004e-4) == "0.000100");
  CHECK(readable(9.98e-5) == "9.98e-05");
  CHECK(readable(12.345) == "12.3");
  CHECK(readable(999.6) == "1,000");
  CHECK(readable(12345) == "12,300");
  CHECK(readable(-1234567) == "-1,230,000");
  CHECK(readable(4.5678e12) == "4.57e+12");
  CHECK(readable(1.5e-7) == "1.50e-07");
  CHECK(readable(INFINITY) == "unlimited");
  CHECK(readable(NAN) == "-");
  CHECK(readable(-INFINITY) == "-unlimited");
  CHECK(readable(12345, 5) == "12,345");
  CHECK(life_text(12345) == "12,300");
  CHECK(life_text(12345, 2) == "12,000");
  CHECK(life_text(INFINITY) == "no damage");
  CHECK(hours_text(12.345) == "12.3 h");
  CHECK(hours_text(INFINITY) == "no damage");
  CHECK(calendar_text(INFINITY) == "no damage");
  CHECK(calendar_text(NAN) == "-");
  CHECK(calendar_words(35.9) == "35.9 months");
  CHECK(calendar_words(36.1) == "3.0 years");
  CHECK(calendar_words(0.0327) == "less than a day");
  CHECK(calendar_words(0.0331) == "1.0 days");
}

TEST_CASE("readable: digits in groups") {
  CHECK(grouped("1") == "1");
  CHECK(grouped("123") == "123");
  CHECK(grouped("1234") == "1,234");
  CHECK(grouped("-1234567.8901") == "-1,234,567.8901");
}

TEST_CASE("readable: text is measured and cut in characters, not bytes") {
  CHECK(columns_of("Käfig") == 5);
  CHECK(shortened("Käfig", 5) == "Käfig");
  CHECK(shortened("Kääfig", 5) == "Kä...");
  CHECK(shortened("abcdef", 2) == "..");
  CHECK(wrapped("one two three", 7, "") == "one two\nthree\n");
  CHECK(wrapped("one two three", 8, " ") == " one two\n three\n");
  CHECK(wrapped("one Käfig three", 9, "") == "one Käfig\nthree\n");
  CHECK(wrapped("unbreakable", 4, "") == "unbreakable\n");
  CHECK(wrapped("", 4, "") == "");
}

TEST_CASE("joined words have the text between each two of them, also where a word is empty") {
  CHECK(joined(std::vector<std::string>{}, ", ").empty());
  CHECK(joined(std::vector<std::string>{"a"}, ", ") == "a");
  CHECK(joined(std::vector<std::string>{"", "a", "", "b"}, ", ") == ", a, , b");
  CHECK(joined(std::array<const char*, 2>{"x", "y"}, " | ") == "x | y");
}
