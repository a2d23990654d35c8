// The thesis' bending test (3.4.1, figures 13 to 15), from the job file to the wire: the behaviour of a cable between two
// blocks while the upper block moves down.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;

namespace {

constexpr int segments = 21, middle_from_tool = 11;
constexpr double youngs_modulus = 117e9;  // copper [Pa]
constexpr double conductor_lay = -25 * std::numbers::pi / 180, wire_lay = 5 * std::numbers::pi / 180;
constexpr double wire_radius = 0.075e-3;

/// Results of the stages for the bending job with some settings.
struct Bending {
  int worst_from_tool = 0;
  std::vector<double> curvature, strain;  // of the worst site over time, after the cable has bowed out
  double direction = 0;                   // of the curvature vector at the end [rad]
  std::vector<double> helix;              // of the worst site: R, lay, phase per level
};

Bending bend(const std::string& settings, const std::string& of_cable = "") {
  Scratch scratch;
  const std::string job = std::string(DRESSLIFE_SOURCE_DIR) + "/config/jobs/bending_cable.yaml";
  must_run(scratch, "dresslife-sim", "'" + job + "' --quiet -o motion.h5" + of_cable);
  must_run(scratch, "dresslife-strain", "motion.h5 --quiet -o strain.h5 " + settings);
  must_run(scratch, "dresslife-fatigue", "strain.h5 --quiet -o life.h5");

  const pipeline::FileReader strain(scratch / "strain.h5", pipeline::strain_format());
  const pipeline::FileReader life(scratch / "life.h5", pipeline::life_format());
  Bending result;
  const auto site = static_cast<std::size_t>(life.number_attribute("worst_site"));
  result.worst_from_tool = static_cast<int>(life.number_attribute("worst_segment_from_tool"));
  const int segment = segments - result.worst_from_tool;
  strain.read_rows("/site/helix", site, 1, result.helix);

  // The probe nearest to the worst site is that of its segment.
  const auto probes = strain.read<std::uint32_t>("/probe/site");
  const auto sites = strain.read<std::int32_t>("/site/segment");
  std::vector<double> history;
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (probes[p] == site || (history.empty() && sites[probes[p]] == segment)) {
      strain.read_rows("/probe/strain", p, 1, history);
      strain.read_rows("/site/helix", probes[p], 1, result.helix);
    }
  const auto bending = strain.read<double>("/deformation/curvature");
  for (std::size_t k = 0; k < history.size(); ++k) {
    const double k1 = bending[2 * (k * segments + segment)], k2 = bending[2 * (k * segments + segment) + 1];
    if (std::hypot(k1, k2) < 0.15) continue;  // the thesis' "pops out": before it the cable is compressed
    result.curvature.push_back(std::hypot(k1, k2));
    result.strain.push_back(history[k]);
    result.direction = std::atan2(k2, k1);
  }
  return result;
}

struct Line {
  double slope, share_explained;
};

/// Fits by least squares with an intercept (the compression at which the cable bows out remains).
Line fit(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::Map<const Eigen::ArrayXd> a(x.data(), x.size()), b(y.data(), y.size());
  const Eigen::ArrayXd da = a - a.mean(), db = b - b.mean();
  const double slope = (da * db).sum() / da.square().sum();
  return {slope, 1 - (db - slope * da).square().sum() / db.square().sum()};
}

/// Strain of a wire's axis per unit curvature by the thesis' (14) to (20) at the phases of a site, and the strains of its own
/// bend and twist per unit curvature by (21) to (23).
struct WireShares {
  double stretch, bend, twist;
};
WireShares shares_of(double conductor_radius, double conductor_phase, double wire_helix_radius, double wire_phase) {
  const double sc = std::sin(conductor_lay), cc = std::cos(conductor_lay), sw = std::sin(wire_lay),
               cw = std::cos(wire_lay);
  const double conductor = cc * cc * conductor_radius * std::sin(conductor_phase);
  const double normal = cc * std::cos(conductor_phase), binormal = cc * cc * std::sin(conductor_phase),
               torsion = sc * cc * std::sin(conductor_phase);
  const double across = binormal * std::sin(wire_phase) - normal * std::cos(wire_phase);
  return {cw * cw * (conductor + wire_helix_radius * across) + wire_helix_radius * sw * cw * torsion,
          wire_radius *
              std::hypot((normal * std::sin(wire_phase) + binormal * std::cos(wire_phase)) * cw, across * cw * cw),
          wire_radius * std::abs(across * sw * cw)};
}

}  // namespace

TEST_CASE("bending test with the thesis' model") {
  const Bending bending = bend(
      "--set strain.kinematics=thesis --set strain.deformation=thesis --set strain.slip=stick --set "
      "strain.surface_fibres=0");
  CHECK(bending.worst_from_tool == middle_from_tool);
  const Line line = fit(bending.curvature, bending.strain);
  CHECK(line.share_explained > 0.999);

  // The largest stretch per curvature over all conductors and wires of the outermost layer, over both phases.
  WireShares worst{0, 0, 0};
  for (int i = 0; i < 720; ++i)
    for (int j = 0; j < 720; ++j) {
      const WireShares shares = shares_of(2.825e-3, i * std::numbers::pi / 360, 0.75e-3, j * std::numbers::pi / 360);
      if (shares.stretch > worst.stretch) worst = shares;
    }
  // With seven conductors the nearest one is up to half of 360/7 degrees from the worst phase: the slope is between
  // cos(26 degrees) = 0.9 of the construction's radius and this radius.
  const double effective_radius = std::abs(line.slope);
  CHECK(effective_radius <= worst.stretch * 1.001);
  CHECK(effective_radius >= worst.stretch * std::cos(std::numbers::pi / 7));
  CHECK(youngs_modulus * effective_radius * 0.25 == Approx(youngs_modulus * worst.stretch * 0.25).epsilon(0.1));

  // Figure 14: the wire's stretch is much larger than its own bend and twist.
  CHECK(worst.stretch > 20 * worst.bend);
  CHECK(worst.stretch > 100 * worst.twist);
}

TEST_CASE("bending test with our model") {
  // With one lay length of 26.4 mm the wires' waves about the cable are 86 mm. Those of the shipped job are up to 1.4 m, three
  // times the cable, and their strain does not even out.
  std::string short_waves;
  const char* const lays[] = {"10.12", "8.13", "6.11", "4.08", "2.04"};
  for (int layer = 0; layer < 5; ++layer)
    short_waves +=
        " --set dresspack.components.1.components." + std::to_string(layer + 1) + ".lay_angle_deg=" + lays[layer];
  const Bending stick = bend("--set strain.slip=stick", short_waves);
  // A column between clamps bends by cos(2 pi s/L): the curvature at its clamps is as large as in its middle.
  CHECK((stick.worst_from_tool == middle_from_tool || stick.worst_from_tool == 1 ||
         stick.worst_from_tool == 2 * middle_from_tool - 1));
  const Line glued = fit(stick.curvature, stick.strain);
  CHECK(glued.share_explained > 0.999);

  // If all parts slip freely, only the bend of the wire itself remains: the strain falls by more than the ratio of the
  // conductor's helix radius to the wire's own radius, 2.8 mm to 0.075 mm, with an allowance for the change of lay.
  const Bending free = bend("--set strain.slip=free", short_waves);
  const Line slipping = fit(free.curvature, free.strain);
  CHECK(slipping.share_explained > 0.999);
  CHECK(std::abs(slipping.slope) < 1.5 * wire_radius);
  CHECK(std::abs(slipping.slope) > 0.8 * wire_radius);
  CHECK(std::abs(glued.slope) > 20 * std::abs(slipping.slope));
  const Bending long_waves = bend("--set strain.slip=free");
  CHECK(std::abs(fit(long_waves.curvature, long_waves.strain).slope) > 2 * wire_radius);
}

TEST_CASE(
    "a swinging cable is pulled by its weight and its motion, not by the gaps that a step leaves between segments") {
  const auto pull = [](const std::string& step_ms) {
    Scratch scratch;
    std::string poses;
    const std::string along_x = ",1,0.7071067811865476,0,0.7071067811865476,0";
    for (int k = 0; k <= 100; ++k)
      poses += std::to_string(0.01 * k) + ",0,0" + along_x + "," +
               std::to_string(0.5 + 0.2 * std::sin(2 * std::numbers::pi * 0.01 * k)) + ",0" + along_x + "\n";
    scratch.write("poses.csv", poses);
    scratch.write("job.yaml",
                  "motion: {clamp_poses: poses.csv}\ndresspack: control_cable\nrouting: {free_length_m: 0.9}\n"
                  "uncertainty: {enabled: false}\nsimulation: {segments: 40, sample_rate_Hz: 100, time_step_ms: " +
                      step_ms + "}\n");
    must_run(scratch, "dresslife-sim", "job.yaml --quiet -o motion.h5");
    must_run(scratch, "dresslife-strain", "motion.h5 --quiet -o strain.h5");
    const pipeline::FileReader strain(scratch / "strain.h5", pipeline::strain_format());
    const auto pulls = strain.read<double>("/cable/strain");
    return *std::max_element(pulls.begin(), pulls.end());
  };
  // The step is of second order, so 5 ms have sixteen times the error of 1.25 ms. The gaps alone pulled twelve times as much.
  const double fine = pull("1.25");
  CHECK(fine > 0);
  CHECK(pull("5") == Approx(fine).epsilon(0.05));
}

TEST_CASE("friction that gathers over more than the closed forms contain is warned of, and the remedy is enough") {
  Scratch scratch;
  const std::string job = std::string(DRESSLIFE_SOURCE_DIR) + "/config/jobs/bending_cable.yaml";
  // Wires in long waves slide as lines, cores do not.
  must_run(scratch, "dresslife-sim",
           "'" + job +
               "' --quiet -o motion.h5 --set dresspack=control_cable --set "
               "dresspack.components.1.data_sheet.lay_length_mm=250");
  const auto warnings = [&](const std::string& settings) {
    must_run(scratch, "dresslife-strain", "motion.h5 --quiet -o strain.h5 --force " + settings);
    return pipeline::FileReader(scratch / "strain.h5", pipeline::strain_format()).text_attribute("warnings");
  };
  CHECK_THAT(warnings(""), Catch::Contains("evens out over") && Catch::Contains("strain.friction_factor: 2.5"));
  CHECK_THAT(warnings("--set strain.friction_factor=2.5"), !Catch::Contains("evens out over"));
}
