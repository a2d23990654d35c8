#include "sim/run/prescribed.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipeline/cable/cable_pull.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/deformation_file.h"
#include "sim/run/rig_deformation.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::sim {
namespace {

using pipeline::message_of;
using pipeline::Scratch;
using std::numbers::pi;

/// Returns a job with one cable of one layer of wires, in a rig or with a prescribed deformation.
std::string cable_job(const std::string& motion, const std::string& more = "") {
  return "motion: " + motion + R"(
dresspack:
  cable:
    name: cable
    source: made for the tests
    radius_mm: 4
    components: [{name: wire, count: 6, radius_mm: 0.1, helix_radius_mm: 3, lay_angle_deg: 20, hand: left, material: copper}]
)" + more;
}

pipeline::Job job_of(const std::string& text) { return pipeline::job_from(pipeline::parse_yaml(text, "job.yaml")); }

PrescribedDeformation rig(const std::string& keys, const std::string& more = "") {
  return deformation_of(job_of(cable_job("{rig: {" + keys + "}}", more)));
}

std::string refused(const std::string& keys, const std::string& more = "") {
  return message_of([&] { rig(keys, more); });
}

TEST_CASE("prescribed: uniform curvature and twist lay a helix whose every link turns alike") {
  PrescribedDeformation bent;
  bent.times = {0}, bent.positions = {0}, bent.states = {{{3, -4, 10}, 0.01}};
  const int n = 40;
  const double length = 0.8, l = length / n;
  const RodState state = posed(bent, 0, n, length);
  constexpr double rounding = 1e-12;  // of 40 products of quaternions
  for (int i = 1; i < n; ++i) {
    const Vector3 turned = rotation_vector(state.orientation[i - 1].conjugate() * state.orientation[i]);
    CHECK((turned - l * Vector3(3, -4, 10)).norm() < rounding);
  }
  const Vector3 whole(3, -4, 10);
  CHECK(state.clamps.tool.orientation.angularDistance(rotation(length * whole)) < rounding);
  // The ends of a helix: r = integral of exp(s w) e_z (1 + e). The error of the chain is (w l)^4, 2e-3 here.
  Vector3 end = Vector3::Zero();
  const int fine = 20000;
  for (int k = 0; k < fine; ++k)
    end += 1.01 * length / fine * (rotation((k + 0.5) * length / fine * whole) * Vector3(0, 0, 1));
  CHECK((state.clamps.tool.position - end).norm() < 2e-3 * length);
}

TEST_CASE("prescribed: rates that change along the dresspack are integrated as by very small steps") {
  PrescribedDeformation bent;
  bent.times = {0};
  for (int k = 0; k <= 20; ++k) {
    const double s = 0.05 * k;
    bent.positions.push_back(s);
    bent.states.push_back({{8 * std::sin(5 * s), 6 * std::cos(9 * s), 12 * s}, 0});
  }
  const int n = 50;
  const RodState state = posed(bent, 0, n, 1);
  Quaternion plain = Quaternion::Identity();
  const int fine = 200000;
  for (int k = 0; k < fine; ++k) plain = plain * rotation(bent.at(0, (k + 0.5) / fine).rate / fine);
  // Fourth order: (20 1/m x 2.5 mm)^5 / 720 per step, 400 steps. The plain sum has an error of (w h)^3/24 per step, 8e-9 in
  // total.
  CHECK(state.clamps.tool.orientation.angularDistance(plain) < 2e-7);
}

TEST_CASE("prescribed: a twisted cable of one hand that hangs without weight keeps its wires' length") {
  const PrescribedDeformation hung = rig("kind: torsion, twist_deg_per_m: 360, weight_kg: 0");
  const double lay = -20 * pi / 180, radius = 3e-3;
  double most = 0;
  for (const auto& state : hung.states) {
    // R^2 sigma^2 + (1 + e)^2 = 1 / cos^2(alpha): the wire keeps its length at rest.
    const double turning = std::tan(lay) + radius * state.rate.z();
    CHECK(state.elongation == Approx(std::sqrt(1 / std::pow(std::cos(lay), 2) - turning * turning) - 1).margin(1e-12));
    most = std::max(most, std::abs(state.elongation));
  }
  CHECK(most > 0.006);  // tan(20 deg) x 3 mm x 2 pi
  // 1 kg: a stretch of g m / (E A cos^3 of six wires), with 117 GPa as in the material's file.
  const auto job = job_of(cable_job("{rig: {kind: torsion, twist_deg_per_m: 360, weight_kg: 1}}"));
  const auto& dresspack = job.dresspacks.front().dresspack;
  const double stiffness = 6 * dresspack.materials.front().youngs_modulus * pi * 1e-8 * std::pow(std::cos(lay), 3);
  CHECK(axial_stiffness(dresspack) == Approx(stiffness));
  CHECK(deformation_of(job).states.front().elongation == Approx(9.80665 / stiffness).epsilon(2e-3));  // quadratic terms
}

TEST_CASE(
    "prescribed: held ends pull at a twisted cable that would shorten, and one that would lengthen bows with Euler's load") {
  const auto job = job_of(cable_job("{rig: {kind: torsion, twist_deg_per_m: 360, length_m: 0.8}}"));
  const PrescribedDeformation held = deformation_of(job);
  const auto& dresspack = job.dresspacks.front().dresspack;
  const double lay = -20 * pi / 180, radius = 3e-3, length = 0.8, modulus = dresspack.materials.front().youngs_modulus;
  const double load = pipeline::bending_stiffness(dresspack) * std::pow(2 * pi / length, 2);  // 0.02 N
  const std::size_t places = held.positions.size();
  double most = 0, pulled = 0;
  for (std::size_t sample = 0; sample < held.times.size(); ++sample) {
    const auto& state = held.states[sample * places];
    const double turning = std::tan(lay) + radius * state.rate.z();
    const double strain = std::cos(lay) * std::hypot(turning, 1 + state.elongation) - 1;
    const double pull = 6 * modulus * pi * 1e-8 * std::cos(lay) * strain;
    if (state.elongation == 0) {
      CHECK(pull > -load);
      CHECK(state.rate.head<2>().norm() == 0);
      pulled = std::max(pulled, pull);
      continue;
    }
    CHECK(pull == Approx(-load).epsilon(1e-3));  // rounding of a strain of 1e-7
    most = std::max(most, state.elongation);
    // With its new length the cable still ends parallel at the held grip. J0(2 sqrt(e)) (1 + e) = 1 - 3 e^2/4.
    const int n = 50;
    const auto tool = posed(held, sample, n, length).clamps.tool;
    const double turn =
        state.rate.head<2>().norm() * length / n;  // of the most bent link; its chord is shorter by turn^2/24
    CHECK(tool.position.norm() == Approx(length).epsilon(std::pow(state.elongation, 2) + turn * turn / 24));
    CHECK((tool.orientation * Vector3::UnitZ()).z() > 1 - 1e-6);
  }
  CHECK(most > 0.006);  // tan(20 deg) x 3 mm x 2 pi, as if it hung free
  CHECK(pulled > 100);  // [N], this strain times E A
}

TEST_CASE("prescribed: rolling flex bends and straightens the share of the cable that passes the bend") {
  const FlexShares longer = flex_shares(0.1, 8);  // the bend moves by 4 m, and a length of 0.314 m is bent at a time
  CHECK(longer.each_stroke == Approx((4 - 0.1 * pi) / (4 + 0.1 * pi)));
  CHECK(longer.each_stroke + longer.each_cycle == Approx(1));
  const FlexShares shorter = flex_shares(0.1, 0.32);
  CHECK(shorter.each_stroke == 0);
  CHECK(shorter.each_cycle == Approx(2 * 0.16 / (0.16 + 0.1 * pi)));

  const auto reversals = [](const PrescribedDeformation& deformation, double kappa) {
    std::size_t most = 0;
    for (std::size_t place = 0; place < deformation.positions.size(); ++place) {
      std::size_t bends = 0;
      bool bent = deformation.states[place].rate.y() > 0.99 * kappa;
      for (std::size_t k = 0; k < deformation.times.size(); ++k) {
        const double now = deformation.states[k * deformation.positions.size() + place].rate.y();
        CHECK(now <= kappa * (1 + 1e-12));
        if (!bent && now > 0.99 * kappa) bent = true, ++bends;
        if (bent && now < 0.01 * kappa) bent = false;
      }
      most = std::max(most, bends);
    }
    return most;
  };
  CHECK(reversals(rig("kind: rolling_flex, radius_mm: 100, travel_m: 8"), 10) == 2);     // once a stroke
  CHECK(reversals(rig("kind: rolling_flex, radius_mm: 100, travel_m: 0.32"), 10) == 1);  // once a round trip
}

TEST_CASE("prescribed: mandrels and pulleys bend both ways by the radius of the cable's axis") {
  const auto extremes = [](const PrescribedDeformation& deformation) {
    double low = 0, high = 0;
    for (const auto& state : deformation.states)
      low = std::min(low, state.rate.y()), high = std::max(high, state.rate.y());
    return std::pair{low, high};
  };
  const auto [left, right] = extremes(rig("kind: tick_tock, radius_mm: 46"));
  CHECK(right == Approx(1 / 0.05));
  CHECK(left == Approx(-1 / 0.05));
  const auto [under, over] = extremes(rig("kind: two_pulley, pulley_diameter_mm: 92"));
  CHECK(over == Approx(1 / 0.05));
  CHECK(under == Approx(-1 / 0.05));
}

TEST_CASE("prescribed: the curvature at a clip is that of the elastica that dies out along the cable") {
  const std::string keys = "kind: swivel, angle_deg: 40, weight_kg: 0.1";
  const std::string stiff = "simulation: {segments: 200}\n";
  const auto job = job_of(cable_job("{rig: {" + keys + "}}", stiff));
  const double bending = dresslife::pipeline::bending_stiffness(job.dresspacks.front().dresspack), pull = 0.1 * 9.80665;
  const PrescribedDeformation bent = deformation_of(job);
  double theta = 40 * pi / 180, kappa = 0;
  for (const auto& state : bent.states) kappa = std::max(kappa, state.rate.y());
  // E I theta'' = T sin(theta), theta' = -kappa at the clip: the solution must tend to 0 and not diverge.
  const double ell = std::sqrt(bending / pull), h = ell / 1000;
  double slope = -kappa;
  for (int k = 0; k < 6000; ++k) {  // leapfrog scheme
    slope += h / 2 * std::sin(theta) / (ell * ell);
    theta += h * slope;
    slope += h / 2 * std::sin(theta) / (ell * ell);
  }
  CHECK(std::abs(theta) < 4 * 40 * pi / 180 * std::exp(-6));
  // The edge radius of a clip limits the curvature.
  double edged = 0;
  for (const auto& state : rig(keys + ", radius_mm: 50", stiff).states) edged = std::max(edged, state.rate.y());
  CHECK(edged == Approx(std::min(kappa, 1 / 0.054)));
}

TEST_CASE("prescribed: a rig that cannot be is refused with what to do") {
  CHECK(refused("kind: torsion") == "job.yaml:1:15: error: a rig of kind torsion needs twist_deg_per_m; give it");
  CHECK(refused("kind: torsion, twist_deg_per_m: 90, travel_m: 1") ==
        "job.yaml:1:15: error: a rig of kind torsion has no travel_m (it has length_m, twist_deg_per_m, weight_kg); "
        "leave it out, or choose another kind");
  CHECK(refused("kind: tick_tock, radius_mm: 10, radius_diameters: 2").find("both radius_mm and") != std::string::npos);
  CHECK(refused("kind: rolling_flex, travel_m: 1").find("has no radius_mm; give radius_mm, or radius_diam") !=
        std::string::npos);
  CHECK(refused("kind: rolling_flex, travel_m: 0.01, radius_mm: 100").find("too short to bend or straighten") !=
        std::string::npos);
  CHECK(
      refused("kind: torsion, twist_deg_per_m: 90000") ==
      "job.yaml:1:15: error: the rig turns a segment of 20 mm by 1800 deg (at most 120); check the rig's twist, angle and "
      "weight, or give simulation.segments: 751");
  CHECK(refused("kind: swivel, angle_deg: 5, weight_kg: 0").find("weight_kg is 0") != std::string::npos);
  const std::string twist = "kind: torsion, twist_deg_per_m: 90";
  CHECK(refused(twist, "robot: abb_irb2600_12_165\n").find("robot is given beside motion.rig") != std::string::npos);
  CHECK(refused(twist, "cell: {boxes: []}\n").find("cell.boxes is given beside motion.rig") != std::string::npos);
  CHECK(refused(twist, "routing: {free_length_m: 2}\n").find("routing is given beside motion.rig") !=
        std::string::npos);
}

TEST_CASE("prescribed: a job with a rig, written out, is the same job") {
  const auto job = job_of(cable_job("{rig: {kind: rolling_flex, radius_diameters: 10, travel_m: 1}}"));
  const std::string text = pipeline::job_text(job);
  CHECK(pipeline::job_text(job_of(text)) == text);
  CHECK(job.dresspacks.front().routing.free_length == Approx(0.08 * pi * 2.75));
  CHECK(message_of([&] {
          job_of(cable_job("{clamp_poses: p.csv}", "routing: {free_length_m: 1}\n"));
        }).find("dresspack.mass_kg_per_m is missing (a cable that is simulated needs it); give from_construction") !=
        std::string::npos);
}

TEST_CASE("deformation file: what is wrong is reported by line and column") {
  const Scratch scratch;
  const auto job_with = [&](const std::string& csv) {
    scratch.write("d.csv", csv);
    return job_of(cable_job("{deformation: " + (scratch / "d.csv").string() + "}", "routing: {free_length_m: 1}\n"));
  };
  const auto read = [&](const std::string& csv) { return deformation_of(job_with(csv)); };
  const auto problem = [&](const std::string& csv) {
    const std::string text = message_of([&] { read(csv); });
    return text.substr(text.find("d.csv") == std::string::npos ? 0 : text.find("d.csv"));
  };
  CHECK(problem("t_s,kappa_1_1_per_m\n0,0\n1,2\n1,3\n") ==
        "d.csv:4:1: error: time 1 s is listed twice; drop a row, or give its place in a column position_m");
  CHECK(problem("t_s,kappa_1_per_m\n0,0\n").find("d.csv:1:5: error: 'kappa_1_per_m' is no column") == 0);
  CHECK(problem("t_s,twist_deg_per_m,twist_rad_per_m\n0,0,0\n")
            .find("d.csv:1:21: error: column twist_rad_per_m beside") == 0);
  CHECK(problem("kappa_1_1_per_m\n0\n").find("has no column t_s") != std::string::npos);
  CHECK(problem("t_s\n0\n").find("nothing that deforms") != std::string::npos);
  CHECK(problem("t_s,elongation\n0,x\n").find("d.csv:2:3: error: 'x' is not a finite number (elongation)") == 0);
  CHECK(problem("t_s,elongation\n0,1\n").find("elongation is 1 (must be -0.5 .. 0.5") != std::string::npos);
  CHECK(problem("t_s,elongation\n0,0,0\n").find("d.csv:2:5: error: row has 3 cells (its header has 2)") == 0);
  CHECK(problem("t_s,elongation\n1,0\n").find("first time is 1 s (must be 0)") != std::string::npos);
  CHECK(problem("t_s,elongation\n0,0\n2,0\n1,0\n").find("d.csv:4:1: error: time 1 s does not follow 2 s") == 0);
  CHECK(problem("t_s,kappa_1_1_per_m\n0,300\n")
            .find("d.csv:2:3: error: curvature and twist turn a segment of 20 mm by") == 0);
  // The number of segments suits the worst row, not only the first one beyond the limit.
  CHECK_THAT(problem("t_s,kappa_1_1_per_m\n0,110\n1,300\n2,200\n"),
             Catch::Contains("d.csv:3:3: error: curvature and twist turn a segment of 20 mm by 343.8 deg") &&
                 Catch::Contains("simulation.segments: 144"));
  CHECK(problem("t_s,position_m,elongation\n0,0,0\n0,2,0\n")
            .find("d.csv:3:3: error: position_m is 2 (must lie in 0 .. 1") == 0);
  CHECK(problem("t_s,position_m,elongation\n0,0,0\n0,1,0\n1,0,0\n2,0,0\n")
            .find("time 1 s has 1 places (the first has 2)") != std::string::npos);
  CHECK(problem("t_s,position_m,elongation\n0,0,0\n0,1,0\n1,0,0\n1,0.5,0\n").find("position_m 0.5 is not the place") !=
        std::string::npos);
  CHECK(problem("t_s,elongation\n").find("deformation holds no row") != std::string::npos);
  CHECK(message_of([&] {
          read_deformation(job_of(cable_job("{deformation: none.csv}", "routing: {free_length_m: 1}\n")));
        }).find("none.csv: error: cannot be read (No such file or directory); check the path") != std::string::npos);

  const PrescribedDeformation one =
      read("# twisted\nelongation , t_s, twist_deg_per_m\r\n0.01,0,180\n\n0.02,0.5,-90\n");
  CHECK(one.times == std::vector<double>{0, 0.5});
  CHECK(one.states[1].rate.z() == Approx(-pi / 2));
  CHECK(one.at(0, 0.7).elongation == 0.01);
  const PrescribedDeformation several = read("t_s,position_m,kappa_2_1_per_m\n0,0.2,1\n0,0.6,3\n1,0.2,0\n1,0.6,4\n");
  CHECK(several.at(0, 0.0).rate.y() == 1);
  CHECK(several.at(0, 0.3).rate.y() == Approx(1.5));
  CHECK(several.at(1, 0.9).rate.y() == 4);
  const auto pulled = job_with("t_s,tension_N\n0,0\n1,100\n");
  CHECK(deformation_of(pulled).states[1].elongation ==
        Approx(100 / axial_stiffness(pulled.dresspacks.front().dresspack)));
}

TEST_CASE("prescribed: a deformation whose times are in another unit is warned of") {
  const Scratch scratch;
  const auto doubts = [&](double unit, const char* rows = "kappa_1_1_per_m\n0,0\n{},10\n{},0\n") {
    scratch.write("d.csv", "t_s," + fmt::format(fmt::runtime(rows), unit, 2 * unit));
    const auto job =
        job_of(cable_job("{deformation: " + (scratch / "d.csv").string() + "}", "routing: {free_length_m: 1}\n"));
    const auto warnings = doubts_of_times(deformation_of(job), job);
    return warnings.empty() ? std::string() : warnings[0].words;
  };
  CHECK(doubts(1) == "");
  CHECK_THAT(doubts(1e-3),
             Catch::Contains("takes 0.002 s, and the strain at the surface changes by up to 40 per second "
                             "(limits 0.0001 .. 10)") &&
                 Catch::Contains("a thousand times too small") && Catch::Contains("a repeat of 2 s if so"));
  CHECK_THAT(doubts(1e3), Catch::Contains("milliseconds instead of seconds"));
  CHECK_THAT(doubts(1e-4, "elongation\n0,0\n{},0.002\n{},0\n"), Catch::Contains("up to 20 per second"));
  CHECK(doubts(1, "kappa_1_1_per_m\n0,0\n{},0.001\n{},0\n") == "");  // it hardly moves
  CHECK(doubts(1e-3, "kappa_1_1_per_m\n0,3\n{},3\n{},3\n") == "");   // it stands still
}

}  // namespace
}  // namespace dresslife::sim
