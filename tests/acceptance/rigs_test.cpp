// Prescribed deformations and test rigs from the job to the wire: the files contain the given deformation, and the chain
// reproduces closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;
using std::numbers::pi;

namespace {

const std::string rigs = std::string(DRESSLIFE_SOURCE_DIR) + "/config/rigs/";

void strain_of(const Scratch& scratch, const std::string& job, const std::string& strain_settings = "") {
  must_run(scratch, "dresslife-sim", job + " --quiet -o motion.h5");
  must_run(scratch, "dresslife-strain", "motion.h5 --quiet -o strain.h5 " + strain_settings);
}

double life_of(const Scratch& scratch, const std::string& job, const std::string& strain_settings = "") {
  strain_of(scratch, job, strain_settings);
  must_run(scratch, "dresslife-fatigue", "strain.h5 --quiet -o life.h5");
  return pipeline::FileReader(scratch / "life.h5", pipeline::life_format()).number_attribute("life_repeats");
}

struct Found {
  std::vector<double> curvature, twist, elongation;
};
Found found_in(const Scratch& scratch) {
  const pipeline::FileReader strain(scratch / "strain.h5", pipeline::strain_format());
  return {strain.read<double>("/deformation/curvature"), strain.read<double>("/deformation/twist"),
          strain.read<double>("/deformation/elongation")};
}

/// Returns a job whose dresspack is one layer of wires around its axis.
std::string wire_job(const std::string& motion, double helix_radius_mm, double lay_deg, double radius_mm) {
  return "motion: " + motion + "\nrouting: {free_length_m: 0.6}\n" + R"(dresspack:
  name: wires
  source: made for the tests
  cable_alone: true
  diameter_mm: 10
  components: [{name: wire, count: )" +
         std::to_string(helix_radius_mm > 0 ? 6 : 1) + ", radius_mm: " + std::to_string(radius_mm) +
         ", helix_radius_mm: " + std::to_string(helix_radius_mm) + ", lay_angle_deg: " + std::to_string(lay_deg) +
         ", material: copper}]\nstrain: {slip: stick, gate: 0}\nsimulation: {segments: 30}\n";
}

}  // namespace

TEST_CASE("prescribed deformation: what is uniform along the dresspack is found again to rounding") {
  Scratch scratch;
  scratch.write("d.csv",
                "t_s,kappa_1_1_per_m,kappa_2_1_per_m,twist_deg_per_m,elongation\n0,0,0,0,0\n1,12,-7,180,0.004\n"
                "2,-3,20,-360,-0.01\n3,0,0,0,0\n");
  scratch.write("job.yaml", wire_job("{deformation: d.csv}", 2, 20, 0.1));
  strain_of(scratch, "job.yaml");
  const Found found = found_in(scratch);
  const double k1[] = {0, 12, -3, 0}, k2[] = {0, -7, 20, 0}, twist[] = {0, pi, -2 * pi, 0}, e[] = {0, .004, -.01, 0};
  // From positions kept to 5e-13 m over links of 20 mm, and from the file's single precision.
  constexpr double rounding = 1e-10, of_the_file = 0x1p-24;
  const auto is = [](double value, double exact) {
    return std::abs(value - exact) < rounding + of_the_file * std::abs(exact);
  };
  for (int t = 0; t < 4; ++t)
    for (int i = 0; i < 30; ++i) {
      CHECK(is(found.curvature[2 * (30 * t + i)], k1[t]));
      CHECK(is(found.curvature[2 * (30 * t + i) + 1], k2[t]));
      CHECK(is(found.twist[30 * t + i], twist[t]));
      CHECK(is(found.elongation[30 * t + i], e[t]));
    }
}

TEST_CASE("prescribed deformation: what changes along it is found again as of a simulated chain") {
  const auto error = [](int segments) {
    Scratch scratch;
    std::string csv = "t_s,position_m,kappa_1_1_per_m,twist_rad_per_m\n";
    for (int t = 0; t < 2; ++t)
      for (int k = 0; k <= 600; ++k) {
        const double s = k / 1000.0;
        csv += std::to_string(t) + "," + std::to_string(s) + "," + std::to_string(5 * std::sin(2 * pi * s / 0.6)) +
               "," + std::to_string(3 * std::cos(2 * pi * s / 0.6)) + "\n";
      }
    scratch.write("d.csv", csv);
    scratch.write("job.yaml", wire_job("{deformation: d.csv}", 2, 20, 0.1));
    strain_of(scratch, "'job.yaml' --set simulation.segments=" + std::to_string(segments));
    const Found found = found_in(scratch);
    double worst = 0;
    for (int i = 3; i + 3 < segments; ++i) {
      const double s = (i + 0.5) * 0.6 / segments;
      worst = std::max({worst, std::abs(found.curvature[2 * i] - 5 * std::sin(2 * pi * s / 0.6)),
                        std::abs(found.twist[i] - 3 * std::cos(2 * pi * s / 0.6))});
    }
    return worst;
  };
  // Values of links are means over their length: l^2/24 of the second derivative, at most 5 (2 pi / 0.6)^2 (l)^2 / 24.
  const double coarse = error(30), fine = error(60);
  CHECK(coarse < 1.2 * 5 * std::pow(2 * pi / 0.6 * 0.02, 2) / 24);
  CHECK(coarse / fine > 3.5);  // second order
}

TEST_CASE("torsion rig: a glued wire's strain is the closed one") {
  Scratch scratch;
  scratch.write("d.csv", "t_s,twist_deg_per_m\n0,0\n1,180\n2,-180\n3,0\n");
  scratch.write("job.yaml", wire_job("{deformation: d.csv}", 2, 20, 0.1));
  strain_of(scratch, "job.yaml", "--set strain.surface_fibres=0");
  const pipeline::FileReader strain(scratch / "strain.h5", pipeline::strain_format());
  std::vector<double> history;
  strain.read_rows("/probe/strain", 0, 1, history);
  REQUIRE(history.size() == 4);
  const double lay = 20 * pi / 180;
  const auto closed = [&](double twist) { return std::cos(lay) * std::hypot(std::tan(lay) + 2e-3 * twist, 1) - 1; };
  constexpr double single = 3e-6;  // of the largest strain, which the stage computes in single precision (W26)
  constexpr double kept = 5e-8;    // resolution of turning points in the file
  CHECK(std::abs(history[1] - closed(pi)) < single * closed(pi) + kept);
  CHECK(std::abs(history[2] - closed(-pi)) < single * std::abs(closed(-pi)) + kept);
}

TEST_CASE("bending: a core wire's surface has r/R") {
  Scratch scratch;
  scratch.write("d.csv", "t_s,kappa_2_1_per_m\n0,0\n1,20\n2,0\n");
  scratch.write("job.yaml", wire_job("{deformation: d.csv}", 0, 0, 0.1));
  strain_of(scratch, "job.yaml", "--set strain.surface_fibres=4");
  const pipeline::FileReader strain(scratch / "strain.h5", pipeline::strain_format());
  std::vector<double> history;
  double largest = 0;
  for (std::size_t probe = 0; probe < strain.length("probe"); ++probe) {
    strain.read_rows("/probe/strain", probe, 1, history);
    for (const double value : history) largest = std::max(largest, std::abs(value));
  }
  CHECK(largest == Approx(0.1e-3 * 20).epsilon(1e-5));
}

TEST_CASE("rigs: a wire on the axis feels the bend, and a strain below the usual gate counts") {
  Scratch scratch;
  const std::string wire =
      "dresspack: {cable: {name: wire, source: test, radius_mm: 0.07, components: [{name: strand, radius_mm: 0.07, "
      "helix_radius_mm: 0, material: copper}]}}\n";
  scratch.write("bent.yaml", "motion: {rig: {kind: tick_tock, radius_mm: 300}}\n" + wire);
  scratch.write("pulled.yaml", "motion: {rig: {kind: axial, elongation_percent: 0.02}}\n" + wire);
  const double bent = life_of(scratch, "bent.yaml"), pulled = life_of(scratch, "pulled.yaml");
  CHECK(std::isfinite(pulled));
  // +-0.07/300.07 against +-2e-4 of strain. Lives follow the power 1/b.
  const pipeline::FileReader life(scratch / "life.h5", pipeline::life_format());
  const double exponent = std::log(pulled / bent) / std::log(0.07 / 300.07 / 2e-4);
  CHECK(exponent > 8);
  CHECK(exponent < 9.5);  // -1/b = 8.9 for b = -0.112; the plastic strain is small
  // An amplitude of 9.2e-5 is below half of the usual gate.
  std::string weak = wire;
  weak.replace(weak.find("copper"), std::string("copper").size(), "copper_annealed");
  scratch.write("weak.yaml", "motion: {rig: {kind: axial, elongation_percent: 0.0092}}\n" + weak);
  CHECK(std::isfinite(life_of(scratch, "weak.yaml")));
}

TEST_CASE("rigs: every shipped rig runs, and its curvature is not more than its radius says") {
  for (const auto& entry : fs::directory_iterator(rigs)) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path().string());
    Scratch scratch;
    const double life = life_of(scratch, "'" + entry.path().string() + "'");
    CHECK(life > 1);
    const pipeline::FileReader motion(scratch / "motion.h5", pipeline::motion_format());
    const std::vector<double> given = motion.read<double>("/check/curvature");
    const double most = *std::max_element(given.begin(), given.end());
    const Found found = found_in(scratch);
    double largest = 0;
    for (std::size_t k = 0; k + 1 < found.curvature.size(); k += 2)
      largest = std::max(largest, std::hypot(found.curvature[k], found.curvature[k + 1]));
    // The cubic of (W2) across ramps of four segments exceeds the given value by at most 3 %.
    CHECK(largest <= 1.03 * most + 1e-9);
    // Cables in torsion bow in one wave, which is largest at the clamps (D3). The centre of the first segment is half a segment
    // from the clamp, and a segment has the mean of the wave.
    const double turn = 2 * pi / static_cast<double>(motion.rows("/segment/length"));
    const double wave = entry.path().stem() == "torsion" ? turn * turn / 8 + turn * turn / 24 : 0;
    CHECK(largest >= (0.999 - wave) * most - 1e-9);
  }
}

TEST_CASE("torsion rig: a held cable that is pulled has a remedy, with which nothing is warned of") {
  Scratch scratch;
  const auto said = [&](const std::string& settings) {
    std::string all;
    for (const auto& [program, words] : std::vector<std::pair<std::string, std::string>>{
             {"dresslife-sim", "'" + rigs + "torsion.yaml' -o motion.h5 " + settings},
             {"dresslife-strain", "motion.h5 -o strain.h5"},
             {"dresslife-fatigue", "strain.h5 -o life.h5"}})
      all += must_run(scratch, program, words + " --force").err;
    return all;
  };
  CHECK_THAT(said(""), Catch::Contains("is pulled with") && Catch::Contains("motion.rig.weight_kg: 0 if"));
  // Rounding bends the straight cable by 1e-11 1/m, in waves of three segments. That is no bend over which strain could even out.
  CHECK_THAT(said("--set motion.rig.weight_kg=0"), !Catch::Contains("warning"));
}

TEST_CASE("torsion rig: the life of a hanging cable does not depend on the number of segments") {
  const auto life = [](int segments) {
    Scratch scratch;
    return life_of(scratch, "'" + rigs + "torsion_hanging.yaml' --set 'dresspack.cable={from: thesis_welding}'" +
                                " --set simulation.segments=" + std::to_string(segments));
  };
  // The twist is the same everywhere. Single precision of strains (3e-6) changes a life by its tenth power.
  CHECK(life(25) == Approx(life(50)).epsilon(1e-4));
}

TEST_CASE(
    "two pulleys: too few segments for the whole bend are refused, and the number that the remedy names suffices") {
  Scratch scratch;
  const std::string job = "'" + rigs + "two_pulley.yaml' ";
  const Outcome coarse = run(scratch, "dresslife-sim", job + "-o motion.h5 --set simulation.segments=12");
  CHECK(coarse.status == 1);
  const std::string remedy = "give simulation.segments: ";
  const std::size_t at = coarse.err.find(remedy);
  REQUIRE(at != std::string::npos);
  const std::string enough = std::to_string(std::stoi(coarse.err.substr(at + remedy.size())));
  // At the least number only one place is bent by the whole: 20 % of the life. Twelve segments lived 9 times as long.
  CHECK(life_of(scratch, job + "--set simulation.segments=" + enough) == Approx(life_of(scratch, job)).epsilon(0.3));
}

TEST_CASE("rolling flex: its worst wire lives as long as one bent and straightened twice a cycle") {
  Scratch scratch;
  const std::string cable = "dresspack: {cable: {from: spot_welding}}\n";
  scratch.write("rig.yaml", "motion: {rig: {kind: rolling_flex, radius_mm: 50, travel_m: 1}}\n" + cable);
  scratch.write("d.csv", "t_s,kappa_2_1_per_m\n0,0\n0.5,20\n1,0\n1.5,20\n2,0\n");
  scratch.write("plain.yaml",
                "motion: {deformation: d.csv}\nrouting: {free_length_m: 1}\nstrain: {gate: 1e-6}\n" + cable);
  const double rig = life_of(scratch, "rig.yaml"), plain = life_of(scratch, "plain.yaml");
  // 1 % more curvature at the bend's edges; damage follows its seventh to ninth power at these strains.
  CHECK(rig == Approx(plain).epsilon(0.15));
}

TEST_CASE("rolling flex: strains even out over the cable of the test, not over the part that is evaluated") {
  // The evaluated part of 95 mm contains four turns of 23.8 mm; the cable from clamp to clamp, 0.53 m, contains 22. Lays on
  // either side differ by 2.5 % in lay angle, which is 0.1 % in strain.
  const auto life = [](double lay_mm) {
    Scratch scratch;
    scratch.write(
        "job.yaml",
        "motion: {rig: {kind: rolling_flex, radius_mm: 11, travel_m: 1}}\n"
        "dresspack: {cable: {name: lead, source: made for the tests, data_sheet: {cores: 3, cross_section_mm2: 0.09, "
        "wire_diameter_mm: 0.08, outer_diameter_mm: 2.2, jacket_thickness_mm: 0.4, lay_length_mm: " +
            std::to_string(lay_mm) + "}}}\nuncertainty: {enabled: false}\n");
    return life_of(scratch, "job.yaml");
  };
  CHECK(life(24.1) / life(23.5) ==
        Approx(1).epsilon(0.1));  // the tenth power of the strain, and an equal part from phases
}

TEST_CASE("swivel and tick-tock: the life does not depend on the number of turns in the evaluated part") {
  // The evaluated part of a swivel, 0.1 m, contains one turn of 100 mm, which has no mean strain, and 1.05 turns of 95 mm. The clip's
  // edge decides the bend, so only the lay angle differs, by 5 %.
  const auto life = [](const std::string& rig, const std::string& lay_mm) {
    Scratch scratch;
    scratch.write(
        "job.yaml",
        "motion: {rig: {" + rig +
            "}}\n"
            "dresspack: {cable: {name: cable, source: made for the tests, data_sheet: {cores: 7, cross_section_mm2: 0.5, "
            "wire_diameter_mm: 0.1, outer_diameter_mm: 8.2, jacket_thickness_mm: 1.1, lay_length_mm: " +
            lay_mm + "}}}\nuncertainty: {enabled: false}\n");
    return life_of(scratch, "job.yaml");
  };
  const std::string swivel = "kind: swivel, angle_deg: 45, weight_kg: 2, radius_mm: 80";
  CHECK(life(swivel, "95") / life(swivel, "100") == Approx(1).epsilon(0.2));
  // Around one mandrel by 30 and by 90 degrees: the evaluated part contains 2.3 and 6.9 turns, with the same curvature.
  const std::string mandrel = "kind: tick_tock, radius_mm: 40, angle_deg: ";
  CHECK(life(mandrel + "30", "60") / life(mandrel + "90", "60") == Approx(1).epsilon(0.2));
}
