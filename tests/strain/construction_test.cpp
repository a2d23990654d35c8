#include "strain/construction.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/errors.h"
#include "strain/slip.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;

namespace {

constexpr double rounding = 1e-12;

/// Returns the difference of two angles, ignoring whole turns.
double apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

}  // namespace

TEST_CASE("the thesis' dresspack has 10 cables, 70 conductors and 6440 wires with paths") {
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  CHECK(construction.parts().size() == 80);
  CHECK(construction.bundles().size() == 70);
  CHECK(construction.levels() == 3);
  int wires = 0;
  for (const Bundle& bundle : construction.bundles())
    for (const int layer : bundle.wire_layers) wires += construction.layers()[layer].count;
  CHECK(wires == 6440);
  const Bundle& bundle = construction.bundles()[2 * 7 + 1];
  CHECK(construction.wire_path(bundle.wire_layers[0], 17, bundle.part) == "signal cable 3/conductor 2/layer 1/wire 17");
  CHECK(construction.layers()[bundle.wire_layers[0]].lay_angle == Approx(-5 * degree));
}

TEST_CASE("a phase advances with the length along the parent") {
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  const Bundle& bundle = construction.bundles()[1];  // conductor 2 of cable 1
  const Part& conductor = construction.parts()[bundle.part];
  const double arc = 0.123;
  CHECK(apart(construction.phase(conductor.layer, 2, conductor.parent, arc),
              2 * pi / 7 + arc * std::tan(25 * degree) / 0.002825) < rounding);
  // Wires are counted along the conductor, which is longer than the cable by 1/cos(25 deg), in left-hand direction.
  CHECK(apart(construction.phase(bundle.wire_layers[0], 4, bundle.part, arc),
              2 * pi * 3 / 31 - arc / std::cos(25 * degree) * std::tan(5 * degree) / 0.00075) < rounding);
}

TEST_CASE("the thesis' phase of a wire is counted against its conductor's, without hands (19)") {
  const Construction construction(thesis_dresspack(), Kinematics::thesis);
  const Bundle& bundle = construction.bundles()[1];
  const Part& conductor = construction.parts()[bundle.part];
  const double arc = 0.05;
  // The conductor lies in the cable, which lies in the dresspack at phase 0. At this level pi - 0 is added as well.
  const double conductor_phase = 2 * pi / 7 + arc * std::tan(25 * degree) / 0.002825 + pi;
  CHECK(apart(construction.phase(conductor.layer, 2, conductor.parent, arc), conductor_phase) < rounding);
  CHECK(apart(construction.phase(bundle.wire_layers[0], 4, bundle.part, arc),
              2 * pi * 3 / 31 + arc / std::cos(25 * degree) * std::tan(5 * degree) / 0.00075 + pi - conductor_phase) <
        rounding);
}

TEST_CASE("components that cannot be are refused with the reason") {
  auto message_of = [](const Dresspack& dresspack) -> std::string {
    try {
      Construction(dresspack, Kinematics::exact);
    } catch (const dresslife::pipeline::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  Dresspack same = thesis_dresspack();
  same.components.push_back(same.components[0]);
  CHECK_THAT(message_of(same), Catch::Contains("two components 'signal cable' lie in the same part"));

  Dresspack axis = thesis_dresspack();
  axis.components[0].helix_radius = 0;
  CHECK_THAT(message_of(axis), Catch::Contains("helix radius 0") && Catch::Contains("count 1"));

  Component inner = wires("", 1, 1e-4, 0, 0, Hand::right);
  for (int level = 0; level < highest_level; ++level) {
    Component outer = part("strand", 2, 1e-3, 1e-3, 5);
    outer.components = {inner};
    inner = outer;
  }
  Dresspack deep;
  deep.components = {inner};
  CHECK_THAT(message_of(deep), Catch::Contains("levels deep"));
}

TEST_CASE("free components slide over their pitch, or from clamp to clamp when straight") {
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  const auto plan = plan_slip(construction, {Slip::free}, 2.0);
  CHECK(plan[0].sliding == Sliding::clamp_to_clamp);  // cables
  CHECK(plan[1].sliding == Sliding::over_pitch);      // conductors
  CHECK(plan[2].sliding == Sliding::over_pitch);      // wires
  for (const LayerSlip& slip : plan_slip(construction, {Slip::stick}, 2.0)) CHECK(slip.sliding == Sliding::glued);

  const auto mixed = plan_slip(construction, {Slip::stick, Slip::free, Slip::stick}, 2.0);
  CHECK(mixed[0].sliding == Sliding::glued);
  CHECK(mixed[1].sliding == Sliding::over_pitch);
  CHECK(mixed[2].sliding == Sliding::glued);

  // A pitch of 38 mm is longer than 30 mm: the conductor slides from clamp to clamp, and so do its wires.
  const auto brief = plan_slip(construction, {Slip::free}, 0.03);
  CHECK(brief[1].sliding == Sliding::clamp_to_clamp);
  CHECK(brief[2].sliding == Sliding::clamp_to_clamp);
}

TEST_CASE("straight wires in a helical conductor slide over the conductor's pitch") {
  Dresspack dresspack = thesis_dresspack();
  for (Component& layer : dresspack.components[0].components[0].components) layer.lay_angle = 0;
  const Construction construction(dresspack, Kinematics::exact);
  const auto plan = plan_slip(construction, {Slip::free}, 2.0);
  CHECK(plan[2].sliding == Sliding::along_ancestor);
  CHECK(plan[2].helical_level == 2);
}

TEST_CASE("factors of what is not known reach friction, slack and grips, each where it belongs") {
  Dresspack dresspack = thesis_dresspack();
  dresspack.inner_diameter = 0.05;
  Component& cable = dresspack.components[0];
  cable.friction = 0.3, cable.radial_line_load = 5;
  cable.laying.slack = 1, cable.laying.tool_grip = 300;
  cable.components[0].friction = 0.4, cable.components[0].radial_line_load = 100;
  dresslife::pipeline::StrainFactors factors;
  factors.friction = 2, factors.hose_friction = 3, factors.slack = 0.5, factors.grip = 0.1;
  const Construction as_given(dresspack, Kinematics::exact), changed(dresspack, Kinematics::exact, factors);
  const Layer& in_hose = changed.layers()[0];
  CHECK(in_hose.friction == Approx(0.9));
  CHECK(in_hose.laying.slack == Approx(0.5));
  CHECK(*in_hose.laying.tool_grip == Approx(30));
  CHECK_FALSE(in_hose.laying.base_grip);
  CHECK(changed.layers()[1].friction == Approx(0.8));
  const std::vector<Slip> rubbing{Slip::free, Slip::friction, Slip::free};
  CHECK(plan_slip(changed, rubbing, 2.0)[1].cap.constant ==
        Approx(2 * plan_slip(as_given, rubbing, 2.0)[1].cap.constant).epsilon(rounding));
  CHECK(as_given.layers()[0].friction == 0.3);
}
