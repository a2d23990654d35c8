#include "pipeline/base/warnings.h"

#include <fmt/format.h>
#include "pipeline/base/warning_words.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("warnings come back from an attribute as they went in") {
  std::vector<Warning> all;
  for (int k = 0; k < warning_kinds_count; ++k)
    all.push_back({static_cast<WarningKind>(k), k % 2 ? "door.mod:12" : "", "what: it is; what to do"});
  all[0].remedy = {{"routing.tool_clamp.direction", "[1, 0, 0]"}, {"a", "b: c"}};
  all[0].amount = 1.0 / 3;
  all[1].amount = 1e-20;
  CHECK(warnings_from(warnings_text(all)) == all);
  CHECK(warnings_text({}).empty());
  CHECK(warnings_from("").empty());
  CHECK(warnings_from("of_a_newer_program\t\twords\nno tabs\ntwist\t\tkept").size() == 1);
}

TEST_CASE(
    "warnings: what separates them is taken out of their words, none is cut, and of too many the rest is counted") {
  const auto back = warnings_from(warnings_text({{WarningKind::program, "a\tb", "one\ntwo"}}));
  REQUIRE(back.size() == 1);
  CHECK(back[0].where == "a b");
  CHECK(back[0].words == "one two");
  std::string umlauts;
  for (int k = 0; k < 1000; ++k) umlauts += "\u00fc";
  const std::string text = warnings_text(std::vector<Warning>(5000, {WarningKind::program, umlauts, umlauts}));
  CHECK(text.size() < 64 * 1024);  // HDF5's limit of an attribute
  const auto kept = warnings_from(text);
  REQUIRE(kept.size() > 2);
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) REQUIRE(kept[k].words == umlauts);
  CHECK(kept.back().words == fmt::format("and {} more warnings", 5000 - (kept.size() - 1)));
}

TEST_CASE("warnings say what is wrong, why, and what to do, with the values of the remedy also as data") {
  const auto twist = [](const auto& remedy) {
    return warning_of(WarningKind::twist, "hose", "twist: 200 deg/m (limit 180 deg/m)", "the clamps turn it", remedy);
  };
  const std::string begin =
      "hose: warning: twist: 200 deg/m (limit 180 deg/m). Likely cause: the clamps turn it. Remedy: ";
  const Remedy remedy{{{"routing.pre_twist_deg", "-90"}, {"routing.free_length_m", "1.2"}}, ", or another clamp"};
  CHECK(twist(remedy).line() == begin + "routing.pre_twist_deg: -90 and routing.free_length_m: 1.2, or another clamp");
  CHECK(twist(remedy).remedy == remedy.values);
  const Remedy last{{{"motion.acceleration_percent", "50"}}, " (now 100)", "other clamps; or "};
  CHECK(twist(last).line() == begin + "other clamps; or motion.acceleration_percent: 50 (now 100)");
  CHECK(twist(last).remedy == last.values);
  CHECK(twist(last).paragraph() ==
        "hose: warning: twist: 200 deg/m (limit 180 deg/m).\n    Likely cause: the clamps turn it.\n"
        "    Remedy: other clamps; or motion.acceleration_percent: 50 (now 100)\n");
  CHECK(Warning{WarningKind::twist, "hose", std::string(60, 'a') + " " + std::string(60, 'b')}.paragraph() ==
        "hose: warning: " + std::string(60, 'a') + "\n    " + std::string(60, 'b') + "\n");
  const WarningParts parts = parts_of(twist(last).words), bare = parts_of("skipped: Stop");
  CHECK(parts.problem == "twist: 200 deg/m (limit 180 deg/m)");
  CHECK(parts.cause == "the clamps turn it");
  CHECK(parts.remedy == "other clamps; or motion.acceleration_percent: 50 (now 100)");
  CHECK((bare.problem == "skipped: Stop" && bare.cause.empty() && bare.remedy.empty()));
  const std::string in_words = "routing.pre_twist_deg: -90";
  CHECK(twist(in_words).line() == begin + in_words);
  CHECK(twist(in_words).remedy.empty());
}

TEST_CASE("warnings of a stage stand behind the earlier ones, each once") {
  const Warning a{WarningKind::twist, "", "a"}, b{WarningKind::mesh, "", "b"};
  CHECK(joined({a}, {b, a}) == std::vector<Warning>{a, b});
  CHECK(a.line() == "warning: a");
  CHECK((Warning{WarningKind::program, "p.mod:1", "c"}).line() == "p.mod:1: warning: c");
}

TEST_CASE(
    "a number outside of its limits is warned of with the units in which it keeps them, else with the other remedy") {
  constexpr OtherUnit from_metres{1e3, "metres instead of millimetres", "metres"},
      from_inches{25.4, "inches", "inches"};
  const auto words = [&](double value, const Limits& limits, const Otherwise& otherwise = {}) {
    std::vector<Warning> warnings;
    WarningsOfKind(warnings, WarningKind::mesh)
        .number({"job.yaml", 3}, "width_mm", " of 'a'", value, limits, {from_metres, from_inches}, otherwise);
    return warnings.empty() ? "" : warnings[0].line();
  };
  const std::string begin = "job.yaml:3: warning: width_mm of 'a' is ";
  for (const double within : {5.0, 7.0, 200.0, 200.0 * (1 + 1e-15)}) CHECK(words(within, {5, 200}) == "");
  CHECK(
      words(0.05, {5, 200}) ==
      begin +
          "0.05 (limits 5 .. 200). Likely cause: metres instead of millimetres. Remedy: width_mm: 50 if that was metres");
  CHECK(
      words(1, {20, 2000, ": a hose"}, {"none", "none", ", or no key"}) ==
      begin +
          "1 (limits 20 .. 2000: a hose). Likely cause: metres instead of millimetres. Remedy: width_mm: 1000 if that was "
          "metres, 25.4 if that was inches, or no key");
  CHECK(words(300, {0, 200}) ==
        begin + "300 (limit 200 or less). Likely cause: another unit. Remedy: width_mm: 200 or less");
  CHECK(words(-1, {0, 200}) == begin + "-1 (limits 0 .. 200). Likely cause: another unit. Remedy: width_mm: 0 .. 200");
  CHECK(words(1e-9, {5}, {"a slip", "as measured"}) ==
        begin + "1e-09 (limit 5 or more). Likely cause: a slip. Remedy: as measured");
}
