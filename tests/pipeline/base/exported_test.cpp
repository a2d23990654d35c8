#include "pipeline/base/exported.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("exported numbers: a comma is decimal unless three digits behind it end the number") {
  for (const auto& [text, value] : {std::pair{"37,5", 37.5},
                                    {"0,25", 0.25},
                                    {"12,3456", 12.3456},
                                    {"1200", 1200.0},
                                    {"120", 120.0},
                                    {"12.345", 12.345},
                                    {"1.200,50", 1200.5},
                                    {"1,200.50", 1200.5},
                                    {"1.234.567,8", 1234567.8}})
    CHECK(exported_number(text) == value);
  for (const char* none :
       {"1,200", "12,345", "1.20,50", "12000.300,5", "1.2003000,5", ".200,5", "1.200,300.5", "1,2,3", "", ","})
    CHECK_FALSE(exported_number(none));
  CHECK(number_remedy("1,200") == "write 1200 or 1.200");
  CHECK(number_remedy("1,200,300.5") == "write 1200300.5, without unit, blank or comma");
}
