// The play of loose cables and the excess length that fits into it. Another test compares the force of a compressed cable with
// the minimum of the cables' energy (tests/strain/loose/closed_forms_test.cpp).
#include "pipeline/cable/excess.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/room.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

/// Returns a power cable in the middle of a ring of other cables, which leave it `gap` of play.
Dresspack hose(double gap, double slack_percent) {
  const std::string text = fmt::format(R"(name: hose
source: made up
diameter_mm: 100
inner_diameter_mm: 92
bending_stiffness_Nm2: 20
components:
  - name: power cable
    radius_mm: 8
    helix_radius_mm: 0
    slack_percent: {}
    polymer_bending_stiffness_Nm2: 3
    components:
      - {{name: core, count: 3, radius_mm: 2.8, helix_radius_mm: 4.6, lay_angle_deg: 12, components: [
          {{name: wire, count: 30, radius_mm: 0.25, helix_radius_mm: 2.5, lay_angle_deg: 5, material: copper}}]}}
  - name: signal cable
    count: 6
    slack_percent: 0
    radius_mm: 4
    helix_radius_mm: {}
    components:
      - {{name: wire, count: 30, radius_mm: 0.1, helix_radius_mm: 2, lay_angle_deg: 10, material: copper}}
)",
                                       slack_percent, 8 + 4 + gap);
  const Scratch scratch;
  return read_dresspack(scratch.write("hose.yaml", text));
}

}  // namespace

TEST_CASE("room: a cable in the middle has what its ring leaves, a ring turns as one, a lone one goes to the wall") {
  std::vector<CableSpot> spots{{{0, 0}, 0.008}};
  for (int k = 0; k < 6; ++k) spots.push_back({{0.0135 * std::cos(k * pi / 3), 0.0135 * std::sin(k * pi / 3)}, 0.004});
  const auto rooms = rooms_of(spots, 0.026, 0);
  CHECK(rooms[0].ring == no_ring);
  CHECK(winding_radius(spots[0], rooms[0]) == Approx(0.0015));
  CHECK(winding_radius(spots[1], rooms[1]) == Approx(0.0135));
  CHECK(rooms[1].gap == Approx((0.0135 - 0.008) / 2));
  CHECK(rooms[1].farthest == Approx(0.022));
  CHECK(rooms[1].nearest == Approx(0.012));
  const auto alone = rooms_of(std::vector{spots[1]}, 0.026, 0.005);
  CHECK(alone[0].ring == no_ring);
  CHECK(winding_radius(spots[1], alone[0]) == Approx(0.022));
  CHECK(alone[0].nearest == Approx(0.009));
}

TEST_CASE("excess: force and excess are inverse to each other, and without room nothing but compression is left") {
  const Dresspack dresspack = hose(0.5, 1);
  const CableForce cable(dresspack, dresspack.components[0]);
  for (const double room : {0.0, 1e-4, 5e-4, 5e-3})
    for (const double excess : {1e-5, 1e-3, 0.05}) {
      const double force = force_of_excess(cable, excess, room);
      CHECK(excess_at_force(cable, force, room) == Approx(excess).epsilon(1e-9));
      if (room == 0) CHECK(force == Approx(cable.force(excess)));
    }
  // s = F / E A + F c^2 / (4 E I) of 0.1 % in 10 mm. E I: 3 N m2 of the polymer, plus that of the wires and their friction.
  const double stiffness = cable.bending_stiffness(), axial = cable.force(1e-6) / 1e-6;
  CHECK(stiffness > 3);
  const double force = 1e-3 / (1 / axial + 1e-4 / (4 * stiffness));
  CHECK(force_of_excess(cable, 1e-3, 0.01) == Approx(force).epsilon(1e-3));
  CHECK(room_of_excess(cable, 1e-3, force) == Approx(0.01).epsilon(1e-3));
  CHECK(force_of_excess(cable, 0, 0.01) == 0);
  CHECK(force_of_excess(cable, -1, 0.01) == 0);
}

TEST_CASE("excess: a cable that is too long for its room is named with its force, its room and the slack that fits") {
  CHECK(slack_warnings(hose(0.5, 0)).empty());
  CHECK(slack_warnings(hose(5.5, 0.2)).empty());
  const auto warnings = slack_warnings(hose(0.5, 1));
  REQUIRE(warnings.size() == 1);
  const std::string& words = warnings[0].words;
  CHECK_THAT(words, Contains("'power cable' is compressed with ") && Contains("% of its breaking force") &&
                        Contains("limit 20 %") && Contains("Likely cause: it has 0.5 mm of room to wind in and 1 %") &&
                        Contains("Remedy: slack_percent: "));
  // The remedy removes the warning. A slack larger by a twentieth does not.
  REQUIRE(warnings[0].remedy.size() == 1);
  CHECK(warnings[0].remedy[0].key == "slack_percent");
  int of_slack = 0;
  for (const Warning& placed : construction_warnings_at("dresspack", hose(0.5, 1), true)) {
    if (placed.kind != WarningKind::force) continue;
    ++of_slack;
    REQUIRE(placed.remedy.size() == 1);
    CHECK(placed.remedy[0].key == "dresspack.components.1.slack_percent");
  }
  CHECK(of_slack == 1);
  const double fits = std::stod(warnings[0].remedy[0].value);
  REQUIRE(fits > 0);
  CHECK(slack_warnings(hose(0.5, fits)).empty());
  CHECK_FALSE(slack_warnings(hose(0.5, 1.2 * fits)).empty());
  const std::string room = words.substr(words.find("or less; or ") + 12);
  CHECK(slack_warnings(hose(1.03 * std::stod(room), 1)).empty());
}

TEST_CASE(
    "excess: a cable that cannot wind around the axis of its hose is named, and the slack that is proposed lets it") {
  MountedDresspack mounted;
  mounted.dresspack = hose(0.5, 0);
  mounted.routing.base_clamp.emplace(), mounted.routing.tool_clamp.emplace();
  mounted.routing.free_length = 1.2;
  std::vector<Component>& parts = mounted.dresspack.components;
  const double excess = std::hypot(1.2, 2 * pi * parts[1].helix_radius) / 1.2 - 1;  // of a helix of one turn
  CHECK(winding_slack(mounted, parts[1]) ==
        Approx(excess).epsilon(excess));         // half of it is the next term of the series
  CHECK(winding_slack(mounted, parts[0]) == 0);  // on the axis
  const auto warnings = tight_warnings("dresspacks.1.dresspack", mounted);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words, Contains("'signal cable' has 0 % of slack (limit 0.11 %: ") &&
                                    Contains("Remedy: dresspacks.1.dresspack.components.2.slack_percent: 1 (now 0)"));
  CHECK(warnings[0].remedy == std::vector<KeyValue>{{"dresspacks.1.dresspack.components.2.slack_percent", "1"}});
  parts[1].laying.slack = 1;
  CHECK(tight_warnings("dresspack", mounted).empty());
  parts[1].laying.slack = 0;
  parts[1].laying.play = 1e-3;  // it has its own play beside the others
  CHECK(tight_warnings("dresspack", mounted).empty());
  parts[1].laying.play.reset();
  mounted.routing.clamps.emplace_back();  // a clamp that holds it halfway
  CHECK(tight_warnings("dresspack", mounted).empty());
}

TEST_CASE("excess: percentages are rounded to the safe side") {
  CHECK(percent_below(0.000489) == "0.048");
  CHECK(percent_above(0.000481) == "0.049");
  CHECK(percent_below(0.0199) == "1.9");
  CHECK(percent_above(0.0101) == "1.1");
  CHECK(percent_below(0) == "0");
  CHECK(percent_below(-1e-3) == "0");
  CHECK(percent_above(1e-9) == "1e-07");
}
