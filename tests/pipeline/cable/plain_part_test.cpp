// Parts without wires: closed forms of a tube, their contribution to a hose, and refused inputs.
#include "pipeline/job/plain_part.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

std::string refusal(const std::vector<std::string>& sets) {
  return message_of([&] { job_from(parse_yaml(sample_job, "job.yaml"), sets); });
}

const std::string part = "dresspack.components.1.";
const std::string free_cables = "strain.slip=free", hose = "dresspack.inner_diameter_mm=50";
std::string with(const std::string& component) { return "dresspack.components=[" + component + "]"; }

}  // namespace

TEST_CASE("a part without wires is a tube of polymer, or as stiff as it is said to be") {
  PlainPart tube{PlainKind::hose, 0.008, Medium::water, {}, {}};
  const PlainProperties by_polymer = properties_of(tube, 0.006);
  CHECK(by_polymer.bending == Approx(50e6 * pi / 64 * (std::pow(0.012, 4) - std::pow(0.008, 4))));
  CHECK(by_polymer.axial == Approx(50e6 * pi / 4 * (0.012 * 0.012 - 0.008 * 0.008)));
  CHECK(by_polymer.mass == Approx(pi / 4 * (1200 * (0.012 * 0.012 - 0.008 * 0.008) + 1000 * 0.008 * 0.008)));
  tube.bending_stiffness = 2 * by_polymer.bending;  // of a material twice as stiff
  CHECK(properties_of(tube, 0.006).axial == Approx(2 * by_polymer.axial));
  CHECK(properties_of({PlainKind::hose, {}, {}, {}, {}}, 0.006).bore == Approx(0.004));  // two thirds
  const PlainProperties solid = properties_of({PlainKind::fibre, {}, {}, {}, {}}, 0.002);
  CHECK(solid.bore == 0);
  CHECK(solid.mass == Approx(1200 * pi * 4e-6));
}

TEST_CASE("parts without wires add mass and stiffness to a hose's construction, and a pull without slack") {
  Dresspack dresspack;
  dresspack.diameter = 0.05;
  dresspack.inner_diameter = 0.044;
  Component tube;
  tube.name = "air hose", tube.count = 3, tube.radius = 0.004, tube.helix_radius = 0.01;
  tube.plain = PlainPart{PlainKind::hose, 0.005, {}, {}, {}};
  const double empty_mass = mass_of_construction(dresspack);
  dresspack.components = {tube};
  const PlainProperties one = properties_of(*tube.plain, tube.radius);
  const HoseStiffness straight = stiffness_of_construction(dresspack, SlipState::friction, 1);
  CHECK(mass_of_construction(dresspack) - empty_mass == Approx(3 * one.mass));
  CHECK(straight.bending == Approx(3 * one.bending));
  CHECK(straight.torsional == Approx(2.0 / 3 * 3 * one.bending));
  CHECK(straight.axial == Approx(3 * one.axial));
  dresspack.components[0].laying.slack = 1;
  CHECK(stiffness_of_construction(dresspack, SlipState::friction, 1).axial == 0);
  dresspack.components[0].laying.mass = 0.2;
  CHECK(mass_of_construction(dresspack) - empty_mass == Approx(0.6));
  CHECK(lies_loose(dresspack, dresspack.components[0]));
  CHECK_FALSE(has_wires(dresspack));
  // Elastic in both directions.
  const CableForce force(dresspack, dresspack.components[0]);
  CHECK(force.force(-0.01) == Approx(-0.01 * one.axial));
  CHECK(force.bending_stiffness() == Approx(one.bending));
  CHECK(force.mass_per_length() == Approx(one.mass));
}

TEST_CASE("what a part without wires cannot be is refused with its place and a remedy") {
  const auto plain = [](const std::string& words, const std::string& keys = "helix_radius_mm: 8") {
    return refusal({free_cables, hose, with("{name: x, radius_mm: 4, " + keys + ", without_wires: " + words + "}")});
  };
  CHECK(plain("{kind: hose}") == "");
  CHECK_THAT(plain("{kind: fibre, bore_mm: 2}"),
             Contains("'x' is a fibre and has a bore or a filling; set kind: hose"));
  CHECK_THAT(plain("{filled_with: water}"), Contains("'x' is a filler and has a bore or a filling"));
  CHECK_THAT(plain("{kind: hose, bore_mm: 8}"), Contains("'x' has bore_mm 8 (it is 8 mm wide outside)"));
  CHECK_THAT(plain("{kind: tube}"), Contains("kind"));
  CHECK_THAT(plain("{kind: hose}", "helix_radius_mm: 8, material: copper"),
             Contains("'x' is without wires and has a material; leave out one of the two"));
  CHECK_THAT(plain("{kind: hose}", "helix_radius_mm: 8, measured_bending_stiffness_Nm2: 1"),
             Contains("give without_wires.bending_stiffness_Nm2"));
  CHECK_THAT(plain("{kind: hose}", "helix_radius_mm: 0, count: 2"), Contains("lie on the axis"));
  CHECK_THAT(
      refusal({free_cables, part + "components=[{name: x, radius_mm: 1, helix_radius_mm: 2, without_wires: {}}]"}),
      Contains("'x' is without wires and lies in 'cable'; leave it out"));
  CHECK_THAT(refusal({free_cables, hose, with("{name: x, radius_mm: 4, helix_radius_mm: 8}")}),
             Contains("give one of the two, or without_wires: {kind: hose, fibre, filler or cable}"));
}

TEST_CASE("the middle of a hose is described once: by the core's keys or by a component") {
  const std::string middle = with("{name: x, radius_mm: 6, helix_radius_mm: 0, without_wires: {kind: hose}}");
  CHECK(refusal({free_cables, hose, middle}) == "");
  CHECK_THAT(refusal({free_cables, hose, middle, "dresspack.core_diameter_mm=12"}),
             Contains("'x' lies in the middle, and the keys core_.. describe something else that does"));
  CHECK_THAT(refusal({free_cables, hose, middle, "dresspack.core_bending_stiffness_Nm2=2"}),
             Contains("leave out the keys core_.."));
  const std::string beside = with("{name: x, radius_mm: 4, helix_radius_mm: 10, without_wires: {kind: filler}}");
  CHECK(refusal({free_cables, hose, beside, "dresspack.core_diameter_mm=12"}) == "");
  CHECK_THAT(refusal({free_cables, hose, beside, "dresspack.core_diameter_mm=14"}),
             Contains("'x' begins 6 mm from the axis, 1 mm inside the core (core_diameter_mm is 14)"));
}
