#include "pipeline/base/warnings.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("warnings come back from an attribute as they went in") {
  std::vector<Warning> all;
  for (int k = 0; k < warning_kinds_count; ++k)
    all.push_back({static_cast<WarningKind>(k), k % 2 ? "door.mod:12" : "", "what: it is; what to do"});
  CHECK(warnings_from(warnings_text(all)) == all);
  CHECK(warnings_text({}).empty());
  CHECK(warnings_from("").empty());
  CHECK(warnings_from("of_a_newer_program\t\twords\nno tabs\ntwist\t\tkept").size() == 1);
}

TEST_CASE("warnings: what separates them is taken out of their words, many and long ones are cut") {
  const auto back = warnings_from(warnings_text({{WarningKind::program, "a\tb", "one\ntwo"}}));
  REQUIRE(back.size() == 1);
  CHECK(back[0].where == "a b");
  CHECK(back[0].words == "one two");
  std::string umlauts;
  for (int k = 0; k < 30'000; ++k) umlauts += "\u00fc";
  const std::string text =
      warnings_text(std::vector<Warning>(5000, {WarningKind::program, umlauts, umlauts}));
  CHECK(text.size() < 64 * 1024 * 2);
  const auto cut = warnings_from(text);
  REQUIRE(cut.size() > 1);
  CHECK(cut.back().words.find(" more warnings") != std::string::npos);
  CHECK(cut[0].words.ends_with("\u00fc..."));  // no half letter
}

TEST_CASE("warnings of a stage stand behind the earlier ones, each once") {
  const Warning a{WarningKind::twist, "", "a"}, b{WarningKind::mesh, "", "b"};
  CHECK(joined({a}, {b, a}) == std::vector<Warning>{a, b});
  CHECK(a.line() == "warning: a");
  CHECK((Warning{WarningKind::program, "p.mod:1", "c"}).line() == "p.mod:1: warning: c");
}
