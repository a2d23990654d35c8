#include "pipeline/cable/cable_bending.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "strain/construction.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"
#include "tests/strain/strand_bending.h"

using namespace dresslife;
using namespace dresslife::strain;
using dresslife::pipeline::CableBending;
using dresslife::pipeline::friction_level;
using namespace test_dresspacks;

namespace {

constexpr double youngs_modulus = 117e9, poisson_ratio = 0.34;

/// The thesis' cable with pressures between its parts.
Dresspack pressed_dresspack() {
  Dresspack dresspack = thesis_dresspack();
  dresslife::pipeline::Material copper;
  copper.name = "copper";
  copper.youngs_modulus = youngs_modulus;
  copper.poisson_ratio = poisson_ratio;
  dresspack.materials = {copper};
  Component& conductor = dresspack.components[0].components[0];
  conductor.friction = 0.3;
  conductor.radial_line_load = 100;
  for (Component& wire : conductor.components) {
    wire.friction = 0.3;
    wire.radial_line_load = 20;
  }
  return dresspack;
}

/// Mean squares of the bending and torsion of a sliding conductor at lay angle alpha, per curvature and length of the cable,
/// to first order of W6 and W11: bending about its normal, cos (1 + sin^2) times cos(theta); about its binormal,
/// cos^2 (cos^2 - sin^2) times sin(theta); torsion, -2 sin cos^3 times sin(theta).
struct ConductorInCable {
  double bending, torsion;
  explicit ConductorInCable(double alpha) {
    const double s = std::sin(alpha), c = std::cos(alpha);
    const double normal = c * (1 + s * s), binormal = c * c * (c * c - s * s), twist = 2 * s * c * c * c;
    bending = (normal * normal + binormal * binormal) / 2 / c;
    torsion = twist * twist / 2 / c;
  }
};

}  // namespace

TEST_CASE("a cable's closed ends: free, wires stuck, all stuck") {
  for (const double lay_angle : {25.0, 10.0}) {
    Dresspack dresspack = pressed_dresspack();
    Component& conductor = dresspack.components[0].components[0];
    conductor.lay_angle = lay_angle * degree;
    const CableBending bending(dresspack, dresspack.components[0]);
    const double sine = std::sin(lay_angle * degree), cosine = std::cos(lay_angle * degree);
    const ConductorInCable in_cable(lay_angle * degree);
    const double section = pi * 75e-6 * 75e-6, EA = youngs_modulus * section, EI = EA * 75e-6 * 75e-6 / 4;
    const double wire_cosine = std::cos(5 * degree);
    // The wires are stranded into a conductor that turns by its own torsion. Against the cable they turn by the sum of both,
    // which is nearly zero here. This sum determines their stretch.
    const double torsion_at_rest = sine * cosine / conductor.helix_radius;
    double free = 0, wires = 0, conductor_EA = 0;
    for (const Component& wire : conductor.components) {
      const double R = wire.helix_radius, turning = torsion_at_rest - std::tan(5 * degree) / R;
      const double V2 = 1 + R * R * turning * turning, many = 7 * wire.count / wire_cosine;
      wires += many * EA * std::pow(R / V2, 2) / 2 * in_cable.bending;
      const double by_torsion = R * R * turning / V2;
      free +=
          many * (EI * in_cable.bending + (EI / (1 + poisson_ratio) + EA * by_torsion * by_torsion) * in_cable.torsion);
      conductor_EA += wire.count * EA * std::pow(wire_cosine, 3);
    }
    const double conductors = 7 * conductor_EA * std::pow(cosine, 3) * std::pow(conductor.helix_radius, 2) / 2;
    // The wires' curvature is smaller than the conductor's by sin^2 of their own 5 degrees.
    constexpr double wires_lay = 0.01;
    CHECK(bending.free_stiffness() == Approx(free).epsilon(wires_lay));
    // The undeformed conductor has the curvature 63 1/m. A wire on its outside is longer by R x 63; in squares: 0.2 %.
    constexpr double bow = 0.004;
    CHECK(bending.stuck_stiffness(1) - bending.free_stiffness() == Approx(wires).epsilon(bow));
    CHECK(bending.stuck_stiffness() - bending.stuck_stiffness(1) == Approx(conductors).epsilon(1e-5));
    if (lay_angle != 25) continue;
    // Without the cosines of lay angles: 644 E I = 0.0019, and 7 sum of K E A R^2/2 = 0.226. The sum of this and the
    // conductors' share with its cosines is 4.14. With all cosines:
    CHECK(644 * EI == Approx(0.0019).epsilon(0.02));
    CHECK(bending.free_stiffness() == Approx(0.00180).epsilon(0.005));
    CHECK(bending.stuck_stiffness(1) == Approx(0.180).epsilon(0.005));
    CHECK(bending.stuck_stiffness() == Approx(4.09).epsilon(0.005));
    CHECK(0.2265 + conductors == Approx(4.14).epsilon(0.002));
  }
}

TEST_CASE("a cable of wires alone is the strand that its sliders make") {
  // One layer, by two methods: virtual work over phases of the exact helix, and K E A cos R mean(held sin).
  Dresspack dresspack = pressed_dresspack();
  Component& cable = dresspack.components[0];
  cable.components = {wires("layer 1", 12, 75e-6, 0.0003, 10, Hand::right)};
  cable.components[0].friction = 0.3;
  cable.components[0].radial_line_load = 20;
  for (const double jacket : {0.0, 1e9}) {
    cable.components[0].jacket_stiffness = jacket;
    const CableBending bending(dresspack, cable);
    Strand strand{{{12, 75e-6, youngs_modulus, 0.0003, 10 * degree, 20, jacket}}, 0, 0.3, true};
    StrandBending sliders(strand);
    for (const double curvature : {0.01, 1.0, 5.0, 20.0}) {
      const double held = bending.moment(curvature, 1) - bending.moment(curvature, 0);
      const double of_strand = sliders.moment(curvature) - sliders.slipped_stiffness() * curvature;
      const double elastic = (bending.free_stiffness() - sliders.slipped_stiffness()) * curvature;
      // 360 phases of a curve with kinks; the own bending of the wires differs by sin^2 of the lay angle
      CHECK(held + (jacket > 0 ? elastic : 0) ==
            Approx(of_strand).epsilon(3e-3).margin(0.1 * sliders.slipped_stiffness() * curvature));
    }
  }
}

TEST_CASE("the friction level of a measured stiffness gives that stiffness back") {
  Dresspack dresspack = pressed_dresspack();
  Component& cable = dresspack.components[0];
  const CableBending bending(dresspack, cable);
  for (const double level : {0.5, 1.0, 13.0, 200.0})
    for (const double curvature : {0.3, 1.0, 3.0}) {
      cable.polymer_bending_stiffness = 0.03;
      cable.measured_at_curvature = curvature;
      cable.measured_bending_stiffness = 0.03 + bending.moment(curvature, level) / curvature;
      CHECK(friction_level(dresspack, cable) == Approx(level).epsilon(1e-9));  // 80 halvings of a range of 21 decades
      const Construction construction(dresspack, dresslife::pipeline::Kinematics::exact);
      CHECK(construction.layers()[0].line_load == 0);
      CHECK(construction.layers()[1].line_load == Approx(100 * level));
      CHECK(construction.layers()[2].line_load == Approx(20 * level));
    }
}

TEST_CASE("a stiffness that no friction gives is refused with the two it could have") {
  Dresspack dresspack = pressed_dresspack();
  Component& cable = dresspack.components[0];
  cable.measured_bending_stiffness = 0.0017;
  CHECK_THROWS_WITH(friction_level(dresspack, cable), Catch::Contains("0.0017 at 1 1/m") &&
                                                          Catch::Contains("0.001802 without friction") &&
                                                          Catch::Contains("4.09 where friction holds all"));
  cable.measured_bending_stiffness = 5;
  CHECK_THROWS_WITH(friction_level(dresspack, cable), Catch::Contains("error: 'signal cable' has"));
  cable.measured_bending_stiffness = 0.2;
  for (Component& wire : cable.components[0].components) wire.radial_line_load.reset();
  cable.components[0].radial_line_load.reset();
  CHECK_THROWS_WITH(friction_level(dresspack, cable), Catch::Contains("radial_line_load_N_per_m"));
  cable.components[0].lay_angle = 0;
  CHECK_THROWS_WITH(friction_level(dresspack, cable), Catch::Contains("lies straight beside the axis"));
}

TEST_CASE("a cable held by friction needs less moment to bend than one that sticks, and never less than free") {
  const Dresspack dresspack = pressed_dresspack();
  const CableBending bending(dresspack, dresspack.components[0]);
  double before = 0;
  for (double curvature = 0.01; curvature < 10; curvature *= 1.3) {
    const double moment = bending.moment(curvature, 10);
    CHECK(moment >= bending.free_stiffness() * curvature);
    CHECK(moment <= bending.stuck_stiffness() * curvature * (1 + 1e-12));
    CHECK(moment > before);
    before = moment;
  }
  CHECK(bending.moment(1e-5, 10) == Approx(1e-5 * bending.stuck_stiffness()));
}
