// The generated pages are what the code says.
#include <cmath>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

TEST_CASE("the key and file references in the READMEs are fresh") {
  Scratch scratch;
  const std::string marker = "<!-- generated below this line by scripts/manual: do not edit -->\n";
  for (const auto& [page, what] :
       {std::pair{"config/README.md", "keys"}, std::pair{"pipeline/README.md", "files"}, std::pair{"pipeline/study/README.md", "ranking.csv"}}) {
    const std::string text = content(fs::path(DRESSLIFE_SOURCE_DIR) / page);
    const std::size_t at = text.find(marker);
    REQUIRE(at != std::string::npos);
    const Outcome manual = run(scratch, "dresslife", std::string("manual ") + what);
    REQUIRE(manual.status == 0);
    INFO("run scripts/manual to refresh " << page);
    CHECK(text.substr(at + marker.size()) == "\n" + manual.out);
  }
}
