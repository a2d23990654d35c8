// The generated pages agree with the code.
#include <sstream>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

TEST_CASE("the references of keys, files and columns are fresh") {
  Scratch scratch;
  const std::string marker = "<!-- generated below this line by scripts/manual: do not edit -->\n";
  for (const auto& [page, what] : {std::pair{"config/keys.md", "keys"}, std::pair{"pipeline/files/formats.md", "files"},
                                   std::pair{"pipeline/study/ranking.md", "ranking.csv"}}) {
    const std::string text = content(fs::path(DRESSLIFE_SOURCE_DIR) / page);
    const std::size_t at = text.find(marker);
    REQUIRE(at != std::string::npos);
    const Outcome manual = must_run(scratch, "dresslife", std::string("manual ") + what);
    INFO("run scripts/manual to refresh " << page);
    CHECK(text.substr(at + marker.size()) == "\n" + manual.out);
  }
}

TEST_CASE("manual prints one key, by its path, the end of its path or its name") {
  Scratch scratch;
  const auto paths = [&](const std::string& key) {
    const Outcome manual = must_run(scratch, "dresslife", "manual " + key);
    std::string found;
    std::istringstream lines(manual.out);
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && line[0] != ' ') found += line + " ";
    return found;
  };
  CHECK(paths("motion") == "motion ");
  CHECK(paths("job.fatigue.scatter_log10") == "fatigue.scatter_log10 ");
  CHECK(paths("dresspack.components.2.count") == "dresspack.components[].count ");  // the form of --set
  CHECK(paths("base_clamp.link") == "routing.base_clamp.link ");
  CHECK(paths("routing.tool_clamp.link").find("routing.base_clamp.link ") != std::string::npos);  // the same keys
  CHECK_THAT(paths("motion.tools"), Catch::Contains("motion.tools motion.tools[].name motion.tools[].position_mm "));
  const Outcome text = run(scratch, "dresslife", "manual free_length_m");
  CHECK(
      text.out ==
      "routing.free_length_m\n  The free length of the dresspack between the clamps.\n  allowed: > 0, unit m\n  default: "
      "required\n");
  CHECK(run(scratch, "dresslife", "manual data_sheet").out.find("Examples:\n    data_sheet: 7 x 0.5 mm2,") !=
        std::string::npos);
  CHECK(run(scratch, "dresslife", "manual place").out.find("'place: auto'") !=
        std::string::npos);  // a short form of keys
  CHECK_THAT(run(scratch, "dresslife", "manual life_hours_p10").out,
             Catch::Contains("column life_hours_p10 of ranking.csv\n  ") && Catch::Contains("unit: h"));
  CHECK(run(scratch, "dresslife", "manual life_hours_p11").err.find("did you mean 'life_hours_p10'?") !=
        std::string::npos);
  const Outcome unknown = run(scratch, "dresslife", "manual slack_procent");
  CHECK(unknown.status == 1);
  CHECK(unknown.err.find("did you mean 'slack_percent'?") != std::string::npos);
}
