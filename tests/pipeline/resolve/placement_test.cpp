#include "pipeline/resolve/placement.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <random>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

/// Returns the smallest gap between any two parts, and between parts and bore or core [m].
double least_room(const std::vector<double>& radii, const std::vector<PlacedPart>& places, double bore, double core) {
  double least = HUGE_VAL;
  for (std::size_t a = 0; a < radii.size(); ++a) {
    least = std::min(least, bore - places[a].helix_radius - radii[a]);
    if (core > 0) least = std::min(least, places[a].helix_radius - radii[a] - core);
    for (std::size_t b = 0; b < a; ++b) {
      const std::complex<double> apart =
          std::polar(places[a].helix_radius, places[a].phase) - std::polar(places[b].helix_radius, places[b].phase);
      least = std::min(least, std::abs(apart) - radii[a] - radii[b]);
    }
  }
  return least;
}

std::string hose_text(const std::string& bore, const std::string& parts) {
  return "name: hose\nsource: made up\ndiameter_mm: 60\nbending_stiffness_Nm2: 10\n" + bore + "components:\n" + parts;
}
std::string cable(const std::string& name, int count, double radius_mm, const std::string& keys = "place: auto") {
  return fmt::format(
      "  - {{name: {}, count: {}, radius_mm: {}, {}, components: [{{name: wire, count: 6, radius_mm: 0.2, "
      "helix_radius_mm: 1, lay_angle_deg: 5, material: copper}}]}}\n",
      name, count, radius_mm, keys);
}

}  // namespace

TEST_CASE("placement: parts never overlap, leave the bore or enter the core, and what does not fit is refused") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(2e-3, 9e-3), share(0, 0.4);
  int placed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> radii(1 + static_cast<std::size_t>(trial % 14));
    for (double& of : radii) of = trial % 3 ? radius(random) : 4e-3;
    const double bore = 0.03, core = trial % 2 ? share(random) * bore : 0;
    const auto places = pack_in_bore(radii, bore, core);
    double area = core * core;
    for (const double of : radii) area += of * of;
    // Parts with more area than the bore never fit. Parts with a quarter of it always fit.
    if (area > bore * bore) CHECK_FALSE(places);
    if (core == 0 && area < 0.2 * bore * bore) CHECK(places);
    if (!places) continue;
    ++placed;
    CHECK(least_room(radii, *places, bore, core) > -1e-9);
  }
  CHECK(placed > 500);
}

TEST_CASE("placement: closed forms of one, two, six and seven parts") {
  const auto one = pack_in_bore({4e-3}, 0.02, 0);
  REQUIRE(one);
  CHECK((*one)[0].helix_radius == 0);
  // Six of radius r touch each other on a circle of radius 2 r, with no gap in a bore of 3 r.
  const auto six = pack_in_bore(std::vector<double>(6, 4e-3), 0.012 + 1e-12, 0);
  REQUIRE(six);
  for (const PlacedPart& part : *six) CHECK(part.helix_radius == Approx(8e-3).epsilon(1e-6));
  CHECK_FALSE(pack_in_bore(std::vector<double>(6, 4e-3), 0.0119, 0));
  // Seven in the same bore: one is placed in the middle.
  const auto seven = pack_in_bore(std::vector<double>(7, 4e-3), 0.012 + 1e-12, 0);
  REQUIRE(seven);
  CHECK(std::count_if(seven->begin(), seven->end(), [](const PlacedPart& part) { return part.helix_radius == 0; }) ==
        1);
  // The gap to the wall is half of the gap between parts: bore - R - r = R (pi - 2 asin(r / R)) / 2 for two parts.
  const auto two = pack_in_bore({3e-3, 3e-3}, 0.02, 0);
  REQUIRE(two);
  const double R = (*two)[0].helix_radius;
  CHECK(0.02 - R - 3e-3 == Approx(R * (pi - 2 * std::asin(3e-3 / R)) / 2));
}

TEST_CASE("placement: a dresspack's parts get their places, and a job reads it") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) { return read_dresspack(scratch.write("hose.yaml", text)); };
  const std::string bore = "inner_diameter_mm: 50\n";
  const Dresspack ring = read(hose_text(bore, cable("lead", 6, 5)));
  REQUIRE(ring.components.size() == 1);  // six equal parts even after placement
  CHECK(ring.components[0].count == 6);
  CHECK(ring.components[0].helix_radius > 0.015);
  CHECK(overlap_warnings(ring).empty());

  const Dresspack mixed = read(hose_text(bore + "core_diameter_mm: 10\ncore_bending_stiffness_Nm2: 1\n",
                                         cable("lead", 3, 5) + cable("bus", 2, 3)));
  REQUIRE(mixed.components.size() == 5);
  CHECK(mixed.components[0].name == "lead a");
  CHECK(mixed.components[4].name == "bus b");
  CHECK(overlap_warnings(mixed).empty());
  // Key paths of messages count the user's entries: the second is 'bus', in the resolved list, too.
  CHECK(ring.components[0].entry.empty());
  CHECK(entry_number(mixed.components, 3) == "2");
  Node job;
  job["dresspack"] = echo_fields(mixed);
  set_value(job, "dresspack.components.2.slack_percent", scalar("3"), {});
  Dresspack changed;
  read_fields(*job.find("dresspack"), changed);
  CHECK(mapped(changed.components, [](const Component& of) { return of.laying.slack; }) ==
        std::vector<double>{1, 1, 1, 3, 3});
  // A part in the middle with a given place stays there.
  const Dresspack around = read(hose_text(bore, cable("power", 1, 8, "helix_radius_mm: 0") + cable("lead", 6, 5)));
  CHECK(around.components[1].helix_radius >= 0.0129);
  // Also if the other part would itself be placed in the middle.
  const Dresspack beside = read(hose_text(bore, cable("power", 1, 8, "helix_radius_mm: 0") + cable("lead", 1, 5)));
  CHECK(beside.components[1].helix_radius >= 0.0129);
  // A data sheet gives the radius.
  const Dresspack sheet =
      read(hose_text(bore,
                     "  - {name: lead, count: 4, place: auto, data_sheet: '7 x 0.5 mm2, wire 0.1 mm, outer "
                     "diameter 8.2 mm, jacket 1.1 mm'}\n"));
  CHECK(sheet.components[0].radius == Approx(4.1e-3));
  CHECK(sheet.components[0].helix_radius > 5e-3);
}

TEST_CASE("placement: what cannot be placed is refused with what would do") {
  const Scratch scratch;
  const auto refusal = [&](const std::string& text) {
    return message_of([&] { read_dresspack(scratch.write("hose.yaml", text)); });
  };
  const std::string full = refusal(hose_text("inner_diameter_mm: 30\n", cable("lead", 12, 5)));
  CHECK_THAT(full, Contains("12 parts with place: auto do not fit into the bore of 30 mm") && Contains("hose.yaml:7:"));
  const double enough = std::stod(full.substr(full.find("inner_diameter_mm: ") + 19));
  CHECK(refusal(hose_text(fmt::format("inner_diameter_mm: {}\n", enough), cable("lead", 12, 5))) == "");
  const std::string corrugation = "hose_corrugation: {pitch_mm: 5, height_mm: 4, wall_mm: 0.8}\n",
                    narrow = hose_text(corrugation, cable("lead", 40, 5)), key = "diameter_mm: ";
  const std::string corrugated = refusal(narrow);
  CHECK_THAT(corrugated, Contains("or a hose with " + key));
  const double wide = std::stod(corrugated.substr(corrugated.find(key) + key.size()));
  CHECK(refusal("name: hose\nsource: made up\n" + key + fmt::format("{}", wide) +
                narrow.substr(narrow.find("\nbending_stiffness"))) == "");
  // The search for inner rings must not try every number of parts in every ring: that takes hours for 40 parts.
  for (const int count : {40, 200, 1000})
    CHECK_THAT(refusal(hose_text("inner_diameter_mm: 42\n", cable("lead", count, 5.7) + cable("thin", 7, 2))),
               Contains(fmt::format("{} parts with place: auto do not fit", count + 7)));
  CHECK_THAT(refusal(hose_text("inner_diameter_mm: 42\n", cable("lead", 200'000'000, 5.7))),
             Contains("count is 200000000 (must be 1 .. 1000)"));
  CHECK_THAT(refusal(hose_text("", cable("lead", 3, 5))),
             Contains("place: auto is given, and the hose's bore is not") && Contains("give inner_diameter_mm") &&
                 Contains("of 60 mm usually hose_material: hose_polyamide and hose_corrugation: {pitch_mm: 5.06, "));
  CHECK_THAT(refusal(hose_text("inner_diameter_mm: 70\n", cable("lead", 3, 5))),
             Contains("inner_diameter_mm is 70 (diameter_mm is 60)"));
  const std::string wide_core = "inner_diameter_mm: 50\ncore_diameter_mm: 52\n";
  CHECK_THAT(refusal(hose_text(wide_core, cable("lead", 1, 3, "helix_radius_mm: 12"))),
             Contains("core_diameter_mm is 52 (the hose is 50 wide inside)"));
  CHECK_THAT(refusal(hose_text("inner_diameter_mm: 50\n", cable("lead", 3, 5, "place: auto, helix_radius_mm: 10"))),
             Contains("both place and helix_radius_mm are given"));
  // For a refused data sheet no other error is reported.
  const std::string sheet =
      refusal(hose_text("inner_diameter_mm: 50\n",
                        "  - {name: a, place: auto, data_sheet: '4 x 2.5 mm2, sausage'}\n" + cable("lead", 3, 5)));
  CHECK_THAT(sheet, Contains("'sausage' of a data sheet is not understood"));
  CHECK(std::count(sheet.begin(), sheet.end(), '\n') == 0);
  CHECK_THAT(refusal(hose_text("inner_diameter_mm: 50\n", "  - {name: a, place: auto}\n" + cable("lead", 3, 5))),
             Contains("has place: auto and no radius_mm"));
  for (const char* huge : {"1e17", "inf"})
    CHECK_THAT(refusal(hose_text("inner_diameter_mm: 50\n", std::string("  - {name: a, place: auto, radius_mm: ") +
                                                                huge + "}\n" + cable("lead", 3, 5))),
               Contains("has place: auto and a radius_mm of more than "));
  CHECK_THAT(refusal(hose_text("inner_diameter_mm: 50\n", cable("lead", 3, 5, "place: middle"))),
             Contains("place is 'middle' (must be auto)"));
  CHECK_THAT(
      refusal(hose_text("inner_diameter_mm: 50\n", cable("lead", 3, 5) + cable("other", 1, 3, "helix_radius_mm: 12"))),
      Contains("lies off the axis at a place of its own"));
}
