// The wear of one hour of a program relative to the test in which its cable is rated, run as a user runs it.
#include <algorithm>
#include <sstream>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

constexpr double cycles_per_hour = 1800;  // of a rig at 30 cycles a minute

std::string core(int count) {
  return "{name: core, count: " + std::to_string(count) +
         ", radius_mm: 0.8, helix_radius_mm: 1.2, lay_angle_deg: 12, components: [{name: wire, count: 6, radius_mm: 0.05, "
         "helix_radius_mm: 0.3, lay_angle_deg: 8, material: copper}]}";
}

/// Returns a rating with twist in either direction [deg/m].
std::string rating(int twist, const std::string& cycles) {
  return "{rig: {kind: torsion, twist_deg_per_m: " + std::to_string(twist) + "}, cycles: " + cycles +
         ", source: data sheet}";
}

/// Returns a job with a cable in torsion, and its ratings.
std::string twisted(int twist, const std::string& ratings) {
  return "motion: {rig: {kind: torsion, twist_deg_per_m: " + std::to_string(twist) +
         "}}\ndresspack: {cable: {name: lead, source: test, radius_mm: 3, components: [" + core(3) + "], ratings: [" +
         ratings + "]}}\n";
}

struct Relative {
  std::string per_hour, hours, cable;
};

Relative relative_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string title, row;
  std::getline(lines, title);
  std::getline(lines, row);
  std::vector<std::string> titles, cells;
  for (auto [line, list] : {std::pair(&title, &titles), std::pair(&row, &cells)}) {
    std::istringstream words(*line);
    for (std::string word; std::getline(words, word, ',');) list->push_back(word);
  }
  const auto column = std::find(titles.begin(), titles.end(), "rated_cycles_per_hour");
  REQUIRE(titles.end() - column > 2);
  const auto at = static_cast<std::size_t>(column - titles.begin());  // no cell before it contains a comma here
  REQUIRE(cells.size() > at + 2);
  const Relative relative{cells[at], cells[at + 1], cells[at + 2]};
  return relative;
}

Relative run_one(const Scratch& scratch, const std::string& name, const std::string& job) {
  scratch.write(name + ".yaml", job);
  const Outcome outcome = must_run(scratch, "dresslife", "run " + name + ".yaml --quiet");
  INFO(outcome.err);
  const Relative relative = relative_of(content(scratch / ("runs/" + name + "/ranking.csv")));
  CHECK((outcome.out.find("one hour does the damage of ") != std::string::npos) == !relative.cable.empty());
  const std::string page = content(scratch / ("runs/" + name + "/report.html"));
  CHECK((page.find("<dt>relative life</dt>") != std::string::npos) == !relative.cable.empty());
  return relative;
}

}  // namespace

TEST_CASE("relative life: a program that is the rig itself does one rated cycle per cycle, whatever the settings") {
  Scratch scratch;
  for (const std::string settings :
       {"",
        "strain: {slip: stick, gate: 1e-5, surface_fibres: 3}\nfatigue: {failed_wires_percent: 50, "
        "scatter_log10: 0.4, material: copper_annealed}\n"}) {
    const Relative own =
        run_one(scratch, settings.empty() ? "own" : "other", twisted(180, rating(180, "1e+6")) + settings);
    CHECK(own.cable == "lead");
    // The gate of a rig is at most 1e-6. These turning points are much larger, so the gate has no effect.
    CHECK(std::stod(own.per_hour) == Approx(cycles_per_hour).epsilon(1e-12));
    CHECK(std::stod(own.hours) == Approx(1e6 / cycles_per_hour).epsilon(1e-12));
  }
  // Nothing is computed twice, and commands that only report print the same.
  CHECK(run(scratch, "dresslife", "run own.yaml").err.find("own: nothing to do") != std::string::npos);
  const std::string before = content(scratch / "runs/own/ranking.csv");
  CHECK(run(scratch, "dresslife", "report own.yaml").out.find("1,800 rated cycles of lead") != std::string::npos);
  CHECK(content(scratch / "runs/own/ranking.csv") == before);
}

TEST_CASE("relative life: two tests are each other's reciprocal") {
  Scratch scratch;
  const Relative up = run_one(scratch, "up", twisted(180, rating(270, "1e+6")));
  const Relative down = run_one(scratch, "down", twisted(270, rating(180, "1e+6")));
  CHECK(std::stod(up.per_hour) < cycles_per_hour);
  CHECK(std::stod(up.per_hour) * std::stod(down.per_hour) == Approx(cycles_per_hour * cycles_per_hour).epsilon(1e-9));
}

TEST_CASE("relative life: without a rating nothing is printed and no rig runs") {
  Scratch scratch;
  const Relative none = run_one(scratch, "none", twisted(180, ""));
  CHECK(none.per_hour.empty());
  CHECK(none.hours.empty());
  CHECK(none.cable.empty());
  CHECK_FALSE(fs::exists(scratch / "runs/none/.rigs"));
}

TEST_CASE("relative life: what a study's keep leaves no file for is said") {
  Scratch scratch;
  scratch.write("rated.yaml", twisted(180, rating(180, "1e+6")));
  for (const std::string keep : {"lives", "histories"}) {
    scratch.write(keep + ".yaml", "base: rated.yaml\nkeep: " + keep + "\njobs: {only: {}}\n");
    const Outcome outcome = run(scratch, "dresslife", "run " + keep + ".yaml");
    CHECK((outcome.err.find("no life in rated cycles") != std::string::npos) == (keep == "lives"));
    CHECK((outcome.out.find("rated cycles of lead") != std::string::npos) == (keep == "histories"));
  }
}
