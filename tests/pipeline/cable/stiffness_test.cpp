// A hose's stiffness from its construction: closed forms of each part, the three states, and its use in a job.
#include "pipeline/cable/stiffness.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cable_pull.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

constexpr double copper_modulus = 117e9;

Component wires(int count, double radius, double helix_radius, double lay_angle, Hand hand = Hand::right) {
  Component layer;
  layer.name = "wire";
  layer.count = count;
  layer.radius = radius;
  layer.helix_radius = helix_radius;
  layer.lay_angle = lay_angle;
  layer.hand = hand;
  layer.material = "copper";
  return layer;
}

Dresspack of(std::vector<Component> components) {
  Dresspack dresspack;
  Material copper, polyamide;
  copper.name = "copper", copper.youngs_modulus = copper_modulus, copper.poisson_ratio = 0.34;
  polyamide.name = "polyamide", polyamide.youngs_modulus = 1.65e9, polyamide.poisson_ratio = 0.4;
  dresspack.materials = {copper, polyamide};
  dresspack.components = std::move(components);
  return dresspack;
}

Component cable_of(std::vector<Component> layers) {
  Component cable;
  cable.name = "cable";
  cable.radius = 0.005;
  cable.components = std::move(layers);
  return cable;
}

Dresspack thesis_pack() { return read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/thesis_welding.yaml"); }

HoseStiffness in_state(const Dresspack& dresspack, SlipState state) {
  return stiffness_of_construction(dresspack, state, 1);
}

Job job_with(const std::vector<std::string>& sets) { return job_from(parse_yaml(sample_job, "job.yaml"), sets); }

}  // namespace

TEST_CASE("stiffness: a pulled and twisted layer is that of the helix, and gives way when nothing pulls") {
  // Strain of a wire: cos^2 e + R sin cos t. Its force acts along the cable by cos, in torque by R sin. Its length is 1 / cos.
  const double R = 2e-3, a = 20 * degree, EA = copper_modulus * pi * 1e-8;  // wires of 0.2 mm
  for (const Hand hand : {Hand::right, Hand::left}) {
    const Component cable = cable_of({wires(12, 1e-4, R, a, hand)});
    const PullAndTwist answer = pull_and_twist(of({cable}), cable);
    // The wire's own bending and torsion, 0.1 mm radius: (r/R)^2 / 4 of that, 6e-4.
    constexpr double wire_itself = 1e-3;
    CHECK(answer.pull_by_elongation == Approx(12 * EA * std::pow(std::cos(a), 3)).epsilon(wire_itself));
    CHECK(answer.coupling ==
          Approx(sign_of(hand) * 12 * EA * R * std::sin(a) * std::pow(std::cos(a), 2)).epsilon(wire_itself));
    CHECK(answer.torque_by_twist ==
          Approx(12 * EA * std::pow(R * std::sin(a), 2) * std::cos(a)).epsilon(5 * wire_itself));
    CHECK(answer.relaxed() < 0.01 * answer.torque_by_twist);
    CHECK(answer.relaxed() > 0);
  }
}

TEST_CASE("stiffness: layers of both hands do not give way") {
  const Component one = wires(12, 1e-4, 2e-3, 20 * degree);
  const Component other = wires(12, 1e-4, 2e-3, 20 * degree, Hand::left);
  const Component cable = cable_of({one, other});
  const PullAndTwist answer = pull_and_twist(of({cable}), cable);
  CHECK(std::abs(answer.coupling) < 1e-6 * answer.pull_by_elongation * 2e-3);
  CHECK(answer.relaxed() == Approx(answer.torque_by_twist));
}

TEST_CASE("stiffness: a soft bed and the parts on it are springs in series") {
  const double R = 2e-3, a = 20 * degree, bed = 1e7, area = pi * 1e-8, EA = copper_modulus * area;
  Component core = cable_of({wires(1, 1e-4, 0, 0)});
  core.count = 5, core.helix_radius = R, core.lay_angle = a, core.radial_stiffness = bed;
  const Component cable = cable_of({core});
  const Dresspack dresspack = of({cable});
  const PullAndTwist answer = pull_and_twist(dresspack, cable);
  // Force F per length of a helix presses with F sin^2/R on the bed. It gives way by x, which shortens the helix by x sin^2/R.
  const double curvature = std::pow(std::sin(a), 2) / R, share = 1 / (1 + EA * curvature * curvature / bed);
  REQUIRE(share < 0.6);
  constexpr double wire_itself = 5e-3;  // its own bending and torsion, (r/R)^2/4 of the pull's energy over the share
  CHECK(answer.pull_by_elongation == Approx(5 * share * EA * std::pow(std::cos(a), 3)).epsilon(wire_itself));
  CHECK(answer.torque_by_twist == Approx(5 * share * EA * std::pow(R * std::sin(a), 2) * std::cos(a)).epsilon(2e-2));
  const double small = 1e-6;
  CHECK(answer.pull_by_elongation == Approx(pull_of_wires(dresspack, {core}, small, 0) / small).epsilon(wire_itself));
}

TEST_CASE("stiffness: a cable with a core on its axis has the jacket of one with all cores around it") {
  Component middle = cable_of({wires(1, 1e-4, 0, 0)}), around = middle;
  middle.radius = around.radius = 1.7e-3;
  around.count = 6, around.helix_radius = 3.4e-3, around.lay_angle = 10 * degree;
  Dresspack flat = of({middle, around}), ring = of({around});
  flat.diameter = ring.diameter = 0.0106;
  const double jacket = 1e7 * pi / 4 * std::pow(0.0053, 4), wire = copper_modulus * pi / 4 * 1e-16;
  constexpr double slant = 1e-3;  // of the cores, on the wires' share of 1 % (10 deg: 4 % of it)
  CHECK(in_state(flat, SlipState::sliding).bending == Approx(jacket + 7 * wire).epsilon(slant));
  CHECK(in_state(ring, SlipState::sliding).bending == Approx(jacket + 6 * wire).epsilon(slant));
  Dresspack wrapped = of({cable_of({middle, around})});  // a single part on the axis is the cable itself, 10 mm wide
  wrapped.diameter = 0.0106;
  CHECK(in_state(wrapped, SlipState::sliding).bending == Approx(jacket_bending(0.005) + 7 * wire).epsilon(slant));
}

TEST_CASE("stiffness: the layers of a single cable are twisted together at its free length") {
  const Component inner = wires(3, 1e-4, 7e-4, 5 * degree);
  const auto torsional = [&](Hand hand, SlipState state) {
    const Component outer = wires(9, 1e-4, 2.5e-3, 18 * degree, hand);
    Dresspack dresspack = of({outer, inner});
    dresspack.diameter = 0.008;
    return std::pair(in_state(dresspack, state).torsional, pull_and_twist(dresspack, cable_of({outer, inner})));
  };
  for (const SlipState state : {SlipState::sliding, SlipState::stuck}) {
    const auto [opposite, of_opposite] = torsional(Hand::left, state);
    const auto [equal, of_equal] = torsional(Hand::right, state);
    REQUIRE(of_opposite.relaxed() < 0.6 * of_opposite.torque_by_twist);
    // Jacket and insulation are the same.
    CHECK(opposite - equal == Approx(of_opposite.relaxed() - of_equal.relaxed()).epsilon(1e-6));
  }
}

TEST_CASE("stiffness: straight cables in a hose bend each by itself, and all as one where they are glued") {
  Component cable = cable_of({wires(1, 1e-3, 0, 0)});
  cable.count = 6;
  cable.helix_radius = 0.02;
  cable.polymer_bending_stiffness = 0.01;
  const Dresspack dresspack = [&] {
    Dresspack hose = of({cable});
    hose.inner_diameter = 0.052;
    hose.core_bending_stiffness = 3;
    return hose;
  }();
  const double EA = copper_modulus * pi * 1e-6, EI = EA * 1e-6 / 4;
  constexpr double first_order = 1e-6;
  CHECK(in_state(dresspack, SlipState::sliding).bending == Approx(3 + 6 * (0.01 + EI)).epsilon(first_order));
  CHECK(in_state(dresspack, SlipState::friction).bending == Approx(3 + 6 * (0.01 + EI)).epsilon(first_order));
  CHECK(in_state(dresspack, SlipState::stuck).bending ==
        Approx(3 + 6 * (0.01 + EI) + 6 * EA * 0.02 * 0.02 / 2).epsilon(first_order));
  // Without slack the cables carry tension. The core's default twist stiffness is that of a solid bar.
  CHECK(in_state(dresspack, SlipState::sliding).axial == Approx(6 * EA).epsilon(first_order));
  CHECK(in_state(dresspack, SlipState::sliding).torsional ==
        Approx(0.8 * 3 + 6 * (0.01 * 2 / 3 + EI / 1.34)).epsilon(first_order));
  Dresspack slack = dresspack;
  slack.components[0].laying.slack = 0.5;
  CHECK(in_state(slack, SlipState::sliding).axial == 0);
  CHECK(in_state(slack, SlipState::stuck).axial == Approx(6 * EA).epsilon(first_order));
}

TEST_CASE("stiffness: a smooth wall is a tube, a folded one a bellows") {
  Dresspack hose = of({});
  hose.hose_material = "polyamide";
  hose.diameter = 0.06;
  hose.inner_diameter = 0.056;
  const double R = 0.029, t = 0.002;
  constexpr double thick = 2e-3;  // (t/R)^2 / 4
  CHECK(in_state(hose, SlipState::sliding).axial == Approx(1.65e9 * 2 * pi * R * t).epsilon(1e-9));
  CHECK(in_state(hose, SlipState::sliding).bending == Approx(1.65e9 * pi * R * R * R * t).epsilon(thick));
  CHECK(in_state(hose, SlipState::sliding).torsional == Approx(1.65e9 / 2.8 * 2 * pi * R * R * R * t).epsilon(thick));
  hose.inner_diameter.reset();
  // The makers' stiffness of a corrugation (EJMA) is 1.7 D E t^3 / (w^3 C_f), and C_f goes to 1 with the pitch. Their 1.7
  // contains 1 / (1 - 0.3^2), which does not apply to a beam.
  const double w = 0.01, wall = 0.0005, pitch = 4 * wall;
  hose.hose_corrugation = Corrugation{pitch, w + wall, wall, {}};
  const double D = hose.diameter - w - wall;
  const double makers = 1.7 * (1 - 0.09) * D * 1.65e9 * std::pow(wall / w, 3) * pitch;
  constexpr double round_crests = 0.15;  // 1.5 of pitch / depth, halved by the crests' share of the flanks
  CHECK(in_state(hose, SlipState::sliding).axial == Approx(makers).epsilon(round_crests));
  const HoseStiffness folded = in_state(hose, SlipState::sliding);
  CHECK(folded.bending == Approx(folded.axial * D * D / 8).epsilon(1e-9));
  CHECK(folded.torsional > 10 * folded.bending);  // flexible in bending and stiff in torsion
}

TEST_CASE("stiffness: the shipped hose's lies between sliding and glued, where its cables' friction puts it") {
  const Dresspack dresspack = thesis_pack();
  const double wall_and_core = 1.42 + 5;  // the wall by W22, and the core by the file
  CHECK(in_state(dresspack, SlipState::sliding).bending ==
        Approx(wall_and_core + 10 * (0.0018 + 0.0062)).epsilon(0.01));
  const double cable = cable_stiffness(dresspack, dresspack.components[0]);
  CHECK(cable == Approx(0.03).epsilon(0.05));
  CHECK(in_state(dresspack, SlipState::friction).bending == Approx(wall_and_core + 10 * cable).epsilon(0.01));
  const double glued = 10 * axial_stiffness(dresspack, dresspack.components[0]) * std::pow(0.01845, 2) / 2;
  CHECK(in_state(dresspack, SlipState::stuck).bending == Approx(glued + wall_and_core + 10 * 0.43).epsilon(0.01));
  double before = in_state(dresspack, SlipState::stuck).bending;
  for (const double curvature : {1e-3, 1e-2, 0.1, 1.0, 10.0}) {  // the larger the bend, the more parts have slid
    const double bending = stiffness_of_construction(dresspack, SlipState::friction, curvature).bending;
    CHECK(bending < before);
    before = bending;
  }
  CHECK(before > in_state(dresspack, SlipState::sliding).bending);
}

TEST_CASE("stiffness: a job takes it, prints it in words, and simulates with the number") {
  const std::string wall = "dresspack.hose_material=hose_polyamide",
                    profile = "dresspack.hose_corrugation={pitch_mm: 5, height_mm: 4.5, wall_mm: 0.8}";
  const std::string words = "dresspack.bending_stiffness_Nm2=from_construction";
  const Job taken = job_with({words, wall, profile});
  const Dresspack& dresspack = taken.dresspacks[0].dresspack;
  CHECK(dresspack.bending_stiffness == stiffness_of_construction(dresspack, SlipState::friction, 1).bending);
  CHECK(dresspack.torsional_stiffness == 4);
  CHECK_THAT(job_text(taken), Contains("bending_stiffness_Nm2: from_construction"));
  const Job again = job_from(parse_yaml(job_text(taken), "job.yaml"));
  CHECK(again.dresspacks[0].dresspack.bending_stiffness == dresspack.bending_stiffness);
  CHECK(part_text(again, JobPart::sim) == part_text(taken, JobPart::sim));
  const Job sliding = job_with({words, wall, profile, "dresspack.construction_state=sliding"});
  const Job number = job_with(
      {fmt::format("dresspack.bending_stiffness_Nm2={:.17g}", sliding.dresspacks[0].dresspack.bending_stiffness), wall,
       profile});
  CHECK(part_text(number, JobPart::sim) == part_text(sliding, JobPart::sim));
  CHECK(part_text(number, JobPart::sim) != part_text(taken, JobPart::sim));  // its bending includes friction
  CHECK(part_text(job_with({words, wall, profile, "dresspack.construction_state=stuck"}), JobPart::sim) !=
        part_text(taken, JobPart::sim));
  CHECK_THAT(stiffness_text(dresspack), Contains("E I 1.") && Contains("N m2 from construction (friction at 1 1/m)") &&
                                            Contains("G J 4 N m2 given"));
}

TEST_CASE("stiffness: friction's elements follow the construction's own moment over curvature") {
  for (const std::string name : {"thesis_welding", "spot_welding", "sensor_cable", "control_cable"}) {
    CAPTURE(name);
    Dresspack dresspack = read_dresspack(std::string(DRESSLIFE_SOURCE_DIR "/config/dresspacks/") + name + ".yaml");
    const auto secant = [&](double bend) {
      return stiffness_of_construction(dresspack, SlipState::friction, bend).bending;
    };
    const double sliding = in_state(dresspack, SlipState::sliding).bending;
    const auto friction = [&](double bend) { return (secant(bend) - sliding) * bend; };
    dresspack.bending_from_construction = true, dresspack.construction_state = SlipState::friction;
    take_from_construction(dresspack);
    const std::vector<BendingFriction>& elements = dresspack.bending_friction;
    const auto held = [&](double bend) {
      double sum = 0;
      for (const BendingFriction& element : elements) sum += element.stiffness * std::min(bend, element.slides_at);
      return sum;
    };
    REQUIRE_FALSE(elements.empty());
    REQUIRE(elements.size() <= most_bending_frictions);
    const double most = friction(100), ends_early = 0.006;  // the last 0.5 % of all friction is neglected
    double stuck = 0;
    for (const BendingFriction& element : elements) {
      CHECK(element.stiffness > 0);
      stuck += element.stiffness;
      CHECK(held(element.slides_at) == Approx(friction(element.slides_at)).margin(ends_early * most));
    }
    CHECK(stuck <= 9.001 * sliding);
    const double chords =
        0.1;  // error of straight lines between four curvatures; above the elements' slope limit none is larger
    for (double bend = 1e-3; bend < 30; bend *= 1.2) {
      CAPTURE(bend, held(bend) / most, friction(bend) / most);
      CHECK(held(bend) <= friction(bend) + 1e-9 * most);
      if (bend >= elements.front().slides_at) CHECK(held(bend) >= friction(bend) - chords * most);
    }
  }
}

TEST_CASE("stiffness: a hose's moment with more friction is that of a hose whose coefficients are higher") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/spot_welding.yaml"),
            rougher = dresspack;
  for (Component* part : {&rougher.components[0], &rougher.components[0].components[0]})
    for (Component& inner : part->components) *inner.friction *= 3;
  const std::vector<double> bends{1e-3, 0.03, 0.1, 0.5, 5};
  const auto one = bending_moments(dresspack, 1, bends), three = bending_moments(dresspack, 3, bends),
             none = bending_moments(dresspack, 0, bends);
  for (std::size_t k = 0; k < bends.size(); ++k) {
    CAPTURE(bends[k]);
    CHECK(one[k] == Approx(bends[k] * stiffness_of_construction(dresspack, SlipState::friction, bends[k]).bending));
    CHECK(three[k] ==
          Approx(bends[k] * stiffness_of_construction(rougher, SlipState::friction, bends[k]).bending).epsilon(1e-9));
    CHECK(none[k] == Approx(bends[k] * in_state(dresspack, SlipState::sliding).bending));
  }
  CHECK(three[2] > 1.1 * one[2]);

  // Friction of a cable with a part whose stiffness was measured: the measurement sets a level, which the factor multiplies.
  Component cable = dresspack.components[0];
  Component& conductor = cable.components[0];
  CableBending bending(dresspack, conductor, StraightParts::slide);
  conductor.measured_at_curvature = 1;
  conductor.measured_bending_stiffness =
      conductor.polymer_bending_stiffness + (bending.free_stiffness() + bending.stuck_stiffness()) / 2;
  const double bend = 5;
  const auto by_friction = [&](double factor, double at) {
    return bending_moments(dresspack, cable, factor, {at})[0] - bending_moments(dresspack, cable, 0, {at})[0];
  };
  CHECK(by_friction(3, 3 * bend) == Approx(3 * by_friction(1, bend)));
  REQUIRE(by_friction(1, 3 * bend) < 2.5 * by_friction(1, bend));  // parts slide
}

TEST_CASE("stiffness: a hose from its construction keeps its secant, and its links get spring and friction apart") {
  const std::string words = "dresspack.bending_stiffness_Nm2=from_construction", loss = "dresspack.loss_factor=0.3";
  const Job job = job_with({words, loss});
  const Dresspack& dresspack = job.dresspacks[0].dresspack;
  const double sliding = in_state(dresspack, SlipState::sliding).bending;
  CHECK(dresspack.bending_stiffness == in_state(dresspack, SlipState::friction).bending);
  // The curve is straight up to the first wire that slides: two of the four elements are one.
  CHECK(dresspack.bending_friction.size() == most_bending_frictions - 1);
  // Elements are below the friction's curve between their curvatures, and by 0.5 % at its end.
  CHECK(elastic_bending_stiffness(dresspack) == Approx(sliding).epsilon(0.01));
  const Job again = job_from(parse_yaml(job_text(job), "job.yaml"));
  CHECK(job_text(again) == job_text(job));
  CHECK(part_text(again, JobPart::sim) == part_text(job, JobPart::sim));
  CHECK_THAT(part_text(job, JobPart::sim), Contains("bending_friction") && Contains("construction_curvature"));
  CHECK(
      job_with({words, loss, "dresspack.construction_state=sliding"}).dresspacks[0].dresspack.bending_friction.empty());
  const std::string list = "dresspack.bending_friction=[{stiffness_Nm2: 3, slides_at_1_per_m: 0.1}]";
  const Job given = job_with({"dresspack.bending_stiffness_Nm2=2", list});
  CHECK(elastic_bending_stiffness(given.dresspacks[0].dresspack) == Approx(2 - 0.3));
  CHECK_THROWS_WITH(job_with({"dresspack.bending_stiffness_Nm2=0.3", list}),
                    Contains("bending_friction holds 0.3 N m2 at 1 1/m, all of bending_stiffness_Nm2, 0.3"));
  CHECK_THROWS_WITH(job_with({words, list}), Contains("bending_friction"));
  CHECK_THROWS_WITH(job_with({"dresspack.loss_factor=0.8"}), Contains("0 .. 0.7"));
}

TEST_CASE("stiffness: the mass of a construction is that of wires, polymer and wall") {
  const double metal = 10 * pi * 1e-8 * 8900 / std::cos(0.2),
               left = (pi * 25e-6 - 10 * pi * 1e-8 / std::cos(0.2)) * 1200;
  const Component cable = cable_of({wires(10, 1e-4, 2e-3, 0.2)});
  Dresspack pack = of({cable});
  CHECK(mass_of_part(pack, cable) == Approx(metal + left).epsilon(1e-12));
  pack.diameter = 0.012;  // a jacket that fills the room outside the parts
  CHECK(mass_of_construction(pack) == Approx(metal + left + 1200 * pi * (36e-6 - 25e-6)).epsilon(1e-12));
  pack.inner_diameter = 0.011;
  CHECK(mass_of_construction(pack) == Approx(metal + left + 1200 * pi / 4 * (144e-6 - 121e-6)).epsilon(1e-12));
  Dresspack laid = pack;
  laid.components[0].lay_angle = 0.3;  // a metre of hose contains more than a metre of a laid part
  laid.components[0].laying.mass = 0.5;
  Dresspack straight = laid;
  straight.components[0].lay_angle = 0;
  CHECK(mass_of_construction(laid) - mass_of_construction(straight) ==
        Approx(0.5 / std::cos(0.3) - 0.5).epsilon(1e-12));
  pack.components[0].laying.mass = 0.5;
  CHECK(mass_of_construction(pack) == Approx(0.5 + 1200 * pi / 4 * (144e-6 - 121e-6)).epsilon(1e-12));
}

TEST_CASE("stiffness: the masses of wires, wall and sleeve follow the densities of their materials") {
  const double metal = 10 * pi * 1e-8 / std::cos(0.2);
  const Component cable = cable_of({wires(10, 1e-4, 2e-3, 0.2)});
  Dresspack pack = of({cable});
  pack.materials[0].density = 2810;
  CHECK(mass_of_part(pack, cable) == Approx(metal * 2810 + (pi * 25e-6 - metal) * 1200).epsilon(1e-12));
  CHECK(mass_of_part(pack, wires(1, 1e-4, 0, 0)) == Approx(pi * 1e-8 * 2810).epsilon(1e-12));
  pack.diameter = 0.012, pack.inner_diameter = 0.011;
  const double parts = mass_of_part(pack, cable), wall = pi / 4 * (144e-6 - 121e-6);
  Material steel;
  steel.name = "steel", steel.density = 7900;
  pack.materials.push_back(steel);
  pack.hose_material = "steel";
  CHECK(mass_of_construction(pack) == Approx(parts + 7900 * wall).epsilon(1e-12));
  pack.sleeve = Sleeve{1e-3, "steel", {}};
  CHECK(mass_of_construction(pack) == Approx(parts + 7900 * (wall + pi / 4 * (196e-6 - 144e-6))).epsilon(1e-12));
}

TEST_CASE("stiffness: what a dresspack with parts leaves out is from its construction, its damping the default") {
  const auto without = [](const std::string& keys) {
    Node document = parse_yaml(sample_job, "job.yaml");
    Node& dresspack = *document.find("dresspack");
    std::erase_if(dresspack.entries, [&](const Entry& entry) {
      return (" " + keys + " ").find(" " + entry.key + " ") != std::string::npos;
    });
    return document;
  };
  const std::string all =
      "mass_kg_per_m bending_stiffness_Nm2 torsional_stiffness_Nm2 axial_stiffness_N damping_time_ms damping_source";
  const Job job = job_from(without(all));
  const Dresspack& dresspack = job.dresspacks.front().dresspack;
  CHECK(dresspack.mass_per_length == mass_of_construction(dresspack));
  CHECK(dresspack.bending_stiffness == in_state(dresspack, SlipState::friction).bending);
  CHECK(dresspack.damping_time == 0.02);
  CHECK_THAT(dresspack.damping_source, Contains("ESTIMATE"));
  CHECK_THAT(stiffness_text(dresspack), Contains("mass ") && Contains(" kg/m from construction"));
  CHECK(job_text(job_from(parse_yaml(job_text(job), "again"))) == job_text(job));
  CHECK_THROWS_WITH(job_from(without("damping_source")), Contains("damping_source is missing"));
  CHECK_THROWS_WITH(job_from(without("components " + all)), Contains("bending_stiffness_Nm2 is missing"));
}

TEST_CASE("stiffness: what has none, and words that are none, are refused with a remedy") {
  const auto refusal = [](const std::vector<std::string>& sets) { return message_of([&] { job_with(sets); }); };
  CHECK_THAT(refusal({"dresspack.bending_stiffness_Nm2=from_the_construction"}),
             Contains("must be a number or from_construction, the unit is in the key: N m2"));
  CHECK_THAT(refusal({"dresspack.axial_stiffness_N=from_construction", "dresspack.components.1.slack_percent=1"}),
             Contains("axial_stiffness_N is from_construction, which has none") && Contains("hose_material"));
  CHECK_THAT(refusal({"dresspack.construction_curvature_1_per_m=0"}), Contains("construction_curvature_1_per_m"));
  CHECK_THAT(refusal({"dresspack.construction_state=loose"}), Contains("sliding") && Contains("stuck"));
}

TEST_CASE(
    "stiffness: a smooth wall that no hand bends is warned of with a profile that cures it, a pneumatic tube is not") {
  const Scratch scratch;
  const auto warnings = [&](double outer, double inner, const std::string& keys) {
    const Dresspack dresspack = read_dresspack(scratch.write(
        "hose.yaml",
        fmt::format("name: hose\nsource: a catalogue\nhose_material: hose_polyamide\ndiameter_mm: {}\n{}{}components:\n"
                    "  - {{name: lead, helix_radius_mm: 0, data_sheet: '2 x 0.25 mm2, outer diameter 4 mm'}}\n",
                    outer, inner > 0 ? fmt::format("inner_diameter_mm: {}\n", inner) : "", keys)));
    std::string words;
    for (const Warning& warning : stiffness_warnings(dresspack)) words += warning.line() + "\n";
    return words;
  };
  const std::string doubt = "the smooth wall of the hose";
  const std::string words = warnings(29, 23, "least_bend_radius_mm: 110\n");
  INFO(words);
  const double wall = 1.65e9 * pi / 64 * (std::pow(29e-3, 4) - std::pow(23e-3, 4));
  CHECK_THAT(words, Contains("hose.yaml:1:1: warning: " + doubt) && Contains(fmt::format("E I {:.3g} N m2", wall)) &&
                        Contains(fmt::format("takes {:.3g} N m (limit 10", wall / 0.11)) &&
                        Contains("strains its surface by 13 %"));
  // The line of the remedy, unchanged, is the profile of a hose as flexible as the wall that it names.
  const std::size_t begin = words.find("Remedy: ") + 8, end = words.find('}', begin) + 1;
  const std::string profile = words.substr(begin, end - begin) + "\n";
  CHECK(warnings(29, 23, profile + "least_bend_radius_mm: 110\n") == "");
  CHECK(warnings(29, 0, profile) == "");
  // 11.6 N m of NW10, 13/10 mm, at ten diameters; 5.7 and 8 N m of tubes of 8/6 and 10/8 mm at the makers' radii.
  CHECK_THAT(warnings(13, 10, ""), Contains("ten diameters"));
  CHECK(warnings(8, 6, "") == "");
  CHECK(warnings(8, 6, "least_bend_radius_mm: 40\n") == "");
  CHECK(warnings(10, 8, "least_bend_radius_mm: 60\n") == "");
  // With a given stiffness of a corrugated hose the smooth wall is the fault, not the stiffness.
  CHECK_THAT(warnings(29, 23, "bending_stiffness_Nm2: 0.2\n"),
             Contains(doubt) && !Contains("bending_stiffness_Nm2 is 0.2"));
}

TEST_CASE("stiffness: a given one that its construction cannot have is warned of with what it has") {
  Dresspack dresspack = thesis_pack();
  const auto told = [&] {
    const std::vector<Warning> warnings = stiffness_warnings(dresspack);
    return warnings.empty() ? std::string("nothing") : warnings.front().words;
  };
  // The file's own 25 N m2 is an estimate, several times the stiffness with sliding.
  CHECK_THAT(told(), Contains("is 25 (limits 6.49 .. 13.4)") && Contains("6.72") && Contains("6.49 sliding") &&
                         Contains("from_construction"));
  dresspack.bending_stiffness = 12;
  CHECK(told() == "nothing");
  dresspack.bending_stiffness = 6;  // less than without any friction
  CHECK_THAT(told(), Contains("is 6 (limits 6.49"));
  dresspack.bending_stiffness = 5000;
  CHECK_THAT(told(), Contains("glued"));
  dresspack.core_bending_stiffness.reset();  // an unknown core may be stiff, but not stiffer than a solid bar
  CHECK_THAT(told(), Contains("is 5e+03 (limits 1.49 .. 2.21e+03)"));
  dresspack.bending_stiffness = 2000;
  CHECK(told() == "nothing");
  dresspack.bending_stiffness = 1;
  CHECK_THAT(told(), Contains("without what fills its core of 26 mm"));
  dresspack.bending_from_construction = true;
  take_from_construction(dresspack);
  CHECK_THAT(told(), Contains("too low: bending_stiffness_Nm2 1.72") && Contains("lacks what fills its core of 26 mm"));
}

TEST_CASE("stiffness: a bending stiffness as a number has the friction of the parts in it") {
  Dresspack dresspack = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/control_cable.yaml");
  const std::vector<BendingFriction> taken = dresspack.bending_friction;
  const double of_parts = dresspack.bending_stiffness, elastic = elastic_bending_stiffness(dresspack);
  REQUIRE(elastic < 0.5 * of_parts);  // friction holds most of this cable
  const auto with = [&](double stiffness, SlipState state) {
    Dresspack typed = dresspack;
    typed.bending_from_construction = false;
    typed.bending_friction.clear();
    typed.bending_stiffness = stiffness, typed.construction_state = state;
    take_from_construction(typed);
    CHECK(typed.bending_stiffness == stiffness);
    return typed;
  };
  const Dresspack same = with(of_parts, SlipState::friction), half = with(of_parts / 2, SlipState::friction),
                  twice = with(2 * of_parts, SlipState::friction);
  REQUIRE(same.bending_friction.size() == taken.size());
  REQUIRE(half.bending_friction.size() == taken.size());
  for (std::size_t k = 0; k < taken.size(); ++k) {
    CHECK(same.bending_friction[k].stiffness == Approx(taken[k].stiffness).epsilon(1e-6));
    CHECK(half.bending_friction[k].stiffness == Approx(taken[k].stiffness / 2).epsilon(1e-6));
    CHECK(same.bending_friction[k].slides_at == Approx(taken[k].slides_at).epsilon(1e-6));
  }
  CHECK(elastic_bending_stiffness(half) == Approx(elastic / 2).epsilon(1e-6));
  // The wall or the polymer is stiffer than estimated; the first element may be stiffer too, and holds as much.
  CHECK(elastic_bending_stiffness(twice) == Approx(of_parts + elastic).epsilon(0.05));
  CHECK(with(of_parts, SlipState::sliding).bending_friction.empty());
  Dresspack given = same;
  given.bending_friction = {{0.001, 0.5}};
  take_from_construction(given);
  CHECK(given.bending_friction.size() == 1);
}

TEST_CASE("stiffness: a hose without a wall gives a warning with its stiffness and the key to write") {
  Dresspack dresspack = thesis_pack();
  dresspack.bending_stiffness = 12;
  dresspack.axial_from_construction = true;
  take_from_construction(dresspack);
  CHECK(stiffness_warnings(dresspack).empty());
  dresspack.hose_material.clear();
  dresspack.core_axial_stiffness = 300;  // a filler with little axial stiffness
  take_from_construction(dresspack);
  const std::vector<Warning> warnings = stiffness_warnings(dresspack);
  REQUIRE(warnings.size() == 1);
  // 9.81 m/s2 of the filled hose's mass per metre / 300 N.
  CHECK_THAT(warnings[0].words, Contains("too low: axial_stiffness_N 300 from the construction; it would stretch by " +
                                         fmt::format("{:.2g} %", 100 * 9.81 * dresspack.mass_per_length / 300)) &&
                                    Contains("lacks its wall (hose_material)") &&
                                    Contains("Remedy: hose_material: hose_polyamide"));
}

TEST_CASE("stiffness: a given one is warned of beyond its limits, and not up to them") {
  Component cable = cable_of({wires(7, 3e-4, 1e-3, 10 * degree), wires(1, 3e-4, 0, 0)});
  cable.polymer_bending_stiffness = 0.01;
  Dresspack alone = of({cable}), bare = of(cable.components), hose, walled;
  bare.diameter = 0.012;  // itself a cable, in a jacket
  cable.count = 6, cable.helix_radius = 0.02;
  hose = of({cable});
  hose.diameter = 0.06, hose.inner_diameter = 0.052, hose.core_bending_stiffness = 3;
  walled = hose;
  walled.hose_material = "polyamide";
  const auto bending = [](const Dresspack& dresspack, SlipState state) {
    return stiffness_of_construction(dresspack, state, dresspack.construction_curvature).bending;
  };
  // The limit of a hose without a wall is a solid bar of 3.3 GPa. The limit of a known wall is twice the stiffness with friction.
  const double bar = 3.3e9 * pi / 64 * std::pow(0.06, 4);
  const struct {
    Dresspack dresspack;
    double least, most;
  } cases[]{{hose, std::max(bending(hose, SlipState::friction) / 2, bending(hose, SlipState::sliding)),
             bending(hose, SlipState::stuck) + bar},
            {walled, std::max(bending(walled, SlipState::friction) / 2, bending(walled, SlipState::sliding)),
             std::min(2 * bending(walled, SlipState::friction), bending(walled, SlipState::stuck))},
            {alone, bending(alone, SlipState::sliding) - 0.01, bending(alone, SlipState::stuck)},
            {bare, bending(bare, SlipState::sliding) - jacket_bending(0.006), bending(bare, SlipState::stuck)}};
  for (const auto& [dresspack, least, most] : cases)
    for (const auto& [given, warned] :
         {std::pair{0.999 * least, true}, {1.001 * least, false}, {0.999 * most, false}, {1.001 * most, true}}) {
      Dresspack one = dresspack;
      one.bending_stiffness = given;
      CAPTURE(given, least, most);
      CHECK(stiffness_warnings(one).size() == (warned ? 1 : 0));
    }
}

TEST_CASE("stiffness: a warm cell softens polymers and not copper, and 23 C changes nothing") {
  const std::string wall = "dresspack.hose_material=hose_polyamide",
                    profile = "dresspack.hose_corrugation={pitch_mm: 5, height_mm: 4.5, wall_mm: 0.8}",
                    words = "dresspack.bending_stiffness_Nm2=from_construction",
                    sliding = "dresspack.construction_state=sliding";
  const auto at = [&](const std::string& temperature) {
    return job_with({words, wall, profile, sliding, "cell.temperature_C=" + temperature});
  };
  const Job usual = job_with({words, wall, profile, sliding}), same = at("23"), warm = at("43"), cold = at("10");
  const auto bending = [](const Job& job) { return job.dresspacks[0].dresspack.bending_stiffness; };
  for (const JobPart part : {JobPart::sim, JobPart::strain, JobPart::fatigue})
    CHECK(part_text(same, part) == part_text(usual, part));
  // Nearly all sliding stiffness is the polymer's: six wires of 0.2 mm in three cables add at most 3 x 6 x 1e-5 N m2.
  const double softer = std::exp(-0.0175 * 20), copper = 18 * copper_modulus * pi / 4 * std::pow(1e-4, 4);
  CHECK(bending(warm) < bending(usual));
  CHECK(bending(warm) == Approx(softer * bending(usual)).margin(10 * copper));
  CHECK(bending(cold) > bending(usual));
  CHECK(bending(job_from(parse_yaml(job_text(warm), "again.yaml"))) == bending(warm));
  CHECK(part_text(warm, JobPart::sim) != part_text(usual, JobPart::sim));
  CHECK(part_text(warm, JobPart::fatigue) != part_text(usual, JobPart::fatigue));
  for (const char* beyond : {"9.9", "61", "-5", "1e9", "nan"}) CHECK_THROWS_WITH(at(beyond), Contains("temperature_C"));
  // A stiffness given as a number does not change.
  const auto given = [](const std::string& temperature) { return job_with({"cell.temperature_C=" + temperature}); };
  CHECK(bending(given("50")) == bending(given("23")));
}

TEST_CASE("stiffness: parts of the core add mass to that from the construction") {
  const std::string core = "dresspack.core_diameter_mm=20", mass = "dresspack.mass_kg_per_m=from_construction",
                    part =
                        "{name: power, radius_mm: 4, helix_radius_mm: 0, mass_kg_per_m: 0.25, without_wires: {kind: "
                        "cable, bending_stiffness_Nm2: 1}}";
  const Job job = job_with({core, mass, "dresspack.core_components=[" + part + "]"}), none = job_with({core, mass});
  const auto of_hose = [](const Job& of) { return of.dresspacks[0].dresspack.mass_per_length; };
  // The sample has no wall: it is full of a polymer of 1200 kg/m3, which the part displaces.
  CHECK(of_hose(job) - of_hose(none) == Approx(0.25 - 1200 * pi * std::pow(0.004, 2)));
}

TEST_CASE("stiffness: parts of the core add none, and what does not fit into it is refused") {
  const auto with = [](const std::string& part) {
    return job_with({"dresspack.core_diameter_mm=20", "dresspack.core_components=[" + part + "]"});
  };
  const std::string hose =
      "{name: water hose, count: 2, radius_mm: 4, helix_radius_mm: 5, without_wires: {kind: hose, bore_mm: 6}}";
  const Job job = with(hose), none = job_with({"dresspack.core_diameter_mm=20"});
  CHECK(part_text(job, JobPart::sim) == part_text(none, JobPart::sim));
  CHECK(part_text(job, JobPart::strain) == part_text(none, JobPart::strain));
  CHECK(part_text(job, JobPart::fatigue) != part_text(none, JobPart::fatigue));
  CHECK(job_text(job_from(parse_yaml(job_text(job), "again.yaml"))) == job_text(job));
  CHECK_THROWS_WITH(with("{name: water hose, radius_mm: 4, helix_radius_mm: 7, without_wires: {kind: hose}}"),
                    Contains("reaches 11 mm from the axis (core_diameter_mm is 20)"));
  CHECK_THROWS_WITH(
      with(
          "{name: cable, radius_mm: 4, helix_radius_mm: 0, components: [{name: wire, radius_mm: 1, helix_radius_mm: 0, "
          "material: copper}]}"),
      Contains("has more than a life"));
  CHECK_THROWS_WITH(
      with("{name: fibre, radius_mm: 4, helix_radius_mm: 0, without_wires: {kind: fibre, least_bend_radius_mm: 50}}"),
      Contains("least_bend_radius_mm"));
  CHECK_THROWS_WITH(
      with("{name: fibre, radius_mm: 4, helix_radius_mm: 0, without_wires: {kind: fibre, most_pressure_bar: 5}}"),
      Contains("is a fibre and has a pressure"));
  CHECK_THROWS_WITH(
      with("{name: hose, radius_mm: 4, helix_radius_mm: 0, without_wires: {kind: hose, most_pressure_bar: 5}}"),
      Contains("'hose' has most_pressure_bar, but not pressure_bar"));
  CHECK_THROWS_WITH(
      with("{name: hose, radius_mm: 4, helix_radius_mm: 0, without_wires: {kind: hose, pressure_bar: 5}}"),
      Contains("'hose' has pressure_bar, but not most_pressure_bar"));
  CHECK_THROWS_WITH(
      with("{name: hose, radius_mm: 4, helix_radius_mm: 0, without_wires: {kind: hose, least_bend_radius_mm: 3}}"),
      Contains("least_bend_radius_mm 3 (it is 8 mm wide outside)"));
  CHECK_THROWS_WITH(job_with({"dresspack.core_diameter_mm=20", "dresspack.core_parts=a hose",
                              "dresspack.core_components=[" + hose + "]"}),
                    Contains("both core_parts and core_components"));
}
