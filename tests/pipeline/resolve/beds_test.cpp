// Defaults of friction, stiffness and bed of the shipped cables.
#include "pipeline/resolve/beds.h"

#include <cmath>

#include "pipeline/cable/cable_bending.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

Job job_of(const std::string& dresspack, const std::string& strain = "{}") {
  return job_from(parse_yaml("motion: {rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}}\nstrain: " + strain +
                                 "\ndresspack: " + dresspack,
                             "job.yaml"));
}
const Component* with_parts(const std::vector<Component>& parts) {
  for (const Component& part : parts)
    if (!part.components.empty() && part.helix_radius > 0) return &part;
  for (const Component& part : parts)
    if (const Component* const inner = with_parts(part.components)) return inner;
  return nullptr;
}

/// Returns all of a dresspack that consists of one cable.
Component whole(const Dresspack& dresspack) {
  Component cable;
  cable.components = dresspack.components;
  cable.radius = dresspack.diameter / 2;
  return cable;
}

}  // namespace

TEST_CASE("shipped cables have the friction and the stiffness of published ones") {
  for (const char* name : {"{from: spot_welding}", "sensor_cable", "control_cable", "{from: handling}"}) {
    CAPTURE(name);
    const Dresspack dresspack = job_of(std::string("{cable: ") + name + "}").dresspacks.front().dresspack;
    const Component cable = whole(dresspack);
    const CableBending bending(dresspack, cable, StraightParts::slide);
    const double friction = bending.moment(1, 1) - bending.free_stiffness(), d = dresspack.diameter;
    // Seven rows of bending.csv: median 16 kPa, 10 to 90 %: 7 to 52 kPa. The estimates are chosen for the median.
    CHECK(friction / std::pow(d, 3) > 14e3);
    CHECK(friction / std::pow(d, 3) < 20e3);
    // 64 E I/(pi d^4) at 1 1/m: 13 to 60 MPa with the whole section of 8 charging cables and 3 leads.
    const double modulus = 64 * (jacket_bending(d / 2) + bending.moment(1, 1)) / (std::numbers::pi * std::pow(d, 4));
    CHECK(modulus > 13e6);
    CHECK(modulus < 60e6);
  }
}

TEST_CASE("one cable has one stiffness in every shipped file") {
  const Dresspack hose = job_of("thesis_welding").dresspacks.front().dresspack;  // bending_cable has the same lays
  const double of_hose = cable_stiffness(hose, hose.components.front());
  const Job alone = read_job(std::string(DRESSLIFE_SOURCE_DIR) + "/config/jobs/bending_cable.yaml");
  // The file states two digits.
  CHECK(alone.dresspacks.front().dresspack.bending_stiffness == Approx(of_hose).epsilon(0.05));
  const Dresspack cable = job_of("{cable: {from: thesis_welding}}").dresspacks.front().dresspack;
  CHECK(cable_stiffness(cable, cable.components.front()) == Approx(of_hose).epsilon(1e-12));
}

TEST_CASE("cores lie on polymer, wires on wires, and the thesis on nothing that gives") {
  for (const char* name :
       {"{cable: sensor_cable}", "{cable: {from: spot_welding}}", "{cable: control_cable}", "spot_welding"}) {
    CAPTURE(name);
    const Dresspack dresspack = job_of(name).dresspacks.front().dresspack;
    const bool in_hose = std::string(name) == "spot_welding";
    const Component* const core = with_parts(in_hose ? dresspack.components.front().components : dresspack.components);
    REQUIRE(core);
    CHECK(core->radial_stiffness == 5e7);
    for (const Component& wire : core->components) CHECK_FALSE(wire.radial_stiffness);
    if (in_hose) CHECK_FALSE(dresspack.components.front().radial_stiffness);
    const Dresspack thesis = job_of(name, "{kinematics: thesis, slip: stick}").dresspacks.front().dresspack;
    CHECK_FALSE(with_parts(in_hose ? thesis.components.front().components : thesis.components)->radial_stiffness);
  }
  const std::string on_axis =
      "{cable: {name: c, source: test, radius_mm: 3, components: [{name: core, radius_mm: 1, helix_radius_mm: 0, components: [{name: "
      "wire, radius_mm: 0.1, helix_radius_mm: 0, material: copper}]}]}}";
  CHECK(job_text(job_of(edited(on_axis, "mm: 1, helix_radius_mm: 0,", "mm: 1, helix_radius_mm: 0.0,"))) ==
        job_text(job_of(on_axis)));
  const Job rigid = job_from(parse_yaml(
      "motion: {rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}}\ndresspack: {cable: {name: c, source: test, radius_mm: 3, "
      "components: [{name: core, count: 3, radius_mm: 1, helix_radius_mm: 1.2, lay_angle_deg: 9, radial_stiffness_N_per_m2: 1e12, "
      "components: [{name: wire, radius_mm: 0.1, helix_radius_mm: 0, material: copper}]}]}}",
      "job.yaml"));
  CHECK(with_parts(rigid.dresspacks.front().dresspack.components)->radial_stiffness == 1e12);
}
