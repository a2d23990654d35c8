// Motions with a clamp between the ends, and dresspacks delivered bent: which parts slide, and which shape is free of strain.
#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "strain/strain_file.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using pipeline::FileReader;
using pipeline::FileWriter;
using pipeline::Scratch;

namespace {

constexpr std::size_t samples = 24;
constexpr double l = 0.1;                                                     // of a segment [m]
using Rate = std::function<Eigen::Vector3d(double arc, std::size_t sample)>;  ///< of rotation along the hose [1/m]

/// Writes a hose with this number of segments per span. Its segments lie along a curve, and a clamp separates the spans.
void write_motion(const std::filesystem::path& name, const std::vector<int>& spans, double first_arc,
                  const Rate& rate) {
  int segments = 0;
  std::vector<std::int32_t> before{0};
  for (const int n : spans) before.push_back(segments += n);
  FileWriter file(name, pipeline::motion_format());
  file.set_axis("segment", segments);
  file.set_axis("clamp", before.size());
  for (std::size_t t = 0; t < samples; ++t) {
    std::vector<double> position, orientation, clamp_position, clamp_orientation;
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Eigen::Vector3d x(0, 0, 0);
    double arc = first_arc;
    const auto put = [&](std::vector<double>& positions, std::vector<double>& orientations) {
      positions.insert(positions.end(), {x.x(), x.y(), x.z()});
      orientations.insert(orientations.end(), {q.w(), q.x(), q.y(), q.z()});
    };
    const auto advance = [&](double by) {
      const Eigen::Vector3d turn = by * rate(arc + by / 2, t);
      if (turn.norm() > 0) q = q * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      arc += by;
    };
    const auto tangent = [&] { return Eigen::Vector3d(q * Eigen::Vector3d::UnitZ()); };
    put(clamp_position, clamp_orientation);
    for (const int n : spans) {
      advance(l / 2);
      x += l / 2 * tangent();
      for (int i = 0; i < n; ++i) {
        put(position, orientation);
        const Eigen::Vector3d from = tangent();
        if (i + 1 < n) {
          advance(l);  // the ends meet a little outside a bend (sim/rod/theory.md, S17)
          x += l / 2 * (1 + (1 - from.dot(tangent())) / 12) * (from + tangent());
        }
      }
      x += l / 2 * tangent();
      advance(l / 2);
      put(clamp_position, clamp_orientation);
    }
    file.append("/time", std::vector<double>{0.04 * t});
    file.append("/segment/position", position);
    file.append("/segment/orientation", orientation);
    file.append("/clamp/position", clamp_position);
    file.append("/clamp/orientation", clamp_orientation);
    file.append("/program/step", std::vector<std::int32_t>{0});
    file.append("/contact/count", std::vector<std::int32_t>{0});
    file.append("/contact/max_depth", std::vector<double>{0});
    file.append("/energy", std::vector<double>{0, 0, 0});
    file.append("/tension", std::vector<double>(segments, 0.0));
  }
  if (spans.size() > 1) file.append("/clamp/segment", before);
  file.append("/segment/length", std::vector<double>(segments, l));
  file.append("/program/text", std::vector<std::string>{"nod"});
  file.attribute("job", "");
  file.attribute("history", "made for a test");
  file.attribute("input_sha256", "");
  file.commit();
}

pipeline::Job job_with(const std::string& dresspack, const std::vector<std::string>& sets) {
  std::string text = pipeline::sample_job;
  const std::size_t begin = text.find("    - name: cable"), end = text.find("routing:");
  text.replace(begin, end - begin, dresspack);
  return pipeline::job_from(pipeline::parse_yaml(text, "job.yaml"), sets);
}

const std::string straight_wires =
    "    - {name: wire, count: 6, radius_mm: 0.1, helix_radius_mm: 18, material: copper}\n";
const std::string cables =
    "    - {name: cable, count: 3, radius_mm: 5, helix_radius_mm: 18.45, components: [{name: wire, count: 6, "
    "radius_mm: "
    "0.1, helix_radius_mm: 2.5, lay_angle_deg: 25, hand: left, material: copper}]}\n";

struct Strains {
  std::vector<std::int32_t> segment;
  std::vector<std::string> component;
  std::vector<std::uint64_t> offset;
  std::vector<float> strain;
  std::vector<std::uint32_t> probe_site;
};

/// Returns the strains of a motion. Precondition: the job's hose is as long as the motion's.
Strains evaluate(const std::filesystem::path& motion, pipeline::Job job) {
  const std::filesystem::path out = motion.string() + ".strain";
  {
    const FileReader reader(motion, pipeline::motion_format());
    job.dresspacks.front().routing.free_length = l * static_cast<double>(reader.rows("/segment/length"));
    FileWriter writer(out, pipeline::strain_format());
    strain::write_strain(reader, job, writer, 1, [](double) {});
    for (const char* attribute : {"job", "history", "input_sha256"}) writer.attribute(attribute, "");
    writer.commit();
  }
  const FileReader file(out, pipeline::strain_format());
  return {file.read<std::int32_t>("/site/segment"), file.read<std::string>("/site/component"),
          file.read<std::uint64_t>("/reversal/offset"), file.read<float>("/reversal/strain"),
          file.read<std::uint32_t>("/probe/site")};
}

}  // namespace

TEST_CASE("wires beside a clamp have the strain at the clamp, where a hose bends most") {
  const Scratch scratch;
  constexpr double decay = 3 * l;  // decay length of a hose's bend at its clamps under tension, sqrt(E I / T)
  const auto bend = [](double arc, std::size_t t) { return 2 * std::exp(-arc / decay) * std::sin(0.3 * double(t)); };
  // The simulated chain bends at links, by the curvature there over 5/12 of a segment at a clamp and 13/12 at the next link.
  // Each call gives the middle of a link's length. At a clamp this length is half a segment.
  write_motion(scratch / "motion", {10}, 0, [&](double arc, std::size_t t) {
    const double from_end = std::min(arc, 10 * l - arc);
    const bool at_clamp = from_end < l / 2, next = !at_clamp && from_end < 1.5 * l;
    const double link = at_clamp ? (arc < l ? 0 : 10 * l) : arc;
    return Eigen::Vector3d(0, (at_clamp ? 5. / 6 : next ? 13. / 12 : 1) * bend(link, t), 0);
  });
  const pipeline::Job job = job_with(
      straight_wires, {"strain.slip=stick", "strain.surface_fibres=0", "strain.gate=1e-6", "strain.probes=[]"});
  const Strains found = evaluate(scratch / "motion", job);
  const FileReader file(scratch / "motion.strain", pipeline::strain_format());
  std::vector<double> places = file.read<double>("/segment/wires_at"), expected{0};
  for (int i = 1; i < 9; ++i) expected.push_back((i + 0.5) * l);
  expected.push_back(10 * l);
  for (std::size_t i = 0; i < places.size(); ++i) CHECK(places[i] == Approx(expected[i]).margin(1e-12));

  double lowest = 1, highest = -1;  // sin(0.3 t) reaches both of its peaks within 0.2 %
  std::vector<double> range(10, 0.0);
  for (std::size_t site = 0; site < found.segment.size(); ++site) {
    const auto [low, high] =
        std::minmax_element(found.strain.begin() + static_cast<std::ptrdiff_t>(found.offset[site]),
                            found.strain.begin() + static_cast<std::ptrdiff_t>(found.offset[site + 1]));
    range[found.segment[site]] = std::max<double>(range[found.segment[site]], *high - *low);
  }
  for (std::size_t t = 0; t < samples; ++t)
    lowest = std::min(lowest, std::sin(0.3 * double(t))), highest = std::max(highest, std::sin(0.3 * double(t)));
  // Two of six wires lie 18 mm from the axis of the bend. The parabola through an exponential that decays over three segments is
  // 1.1 % too low at the clamp. The curvature at the centre of the first segment is 15 % lower than at its clamp.
  for (const std::size_t segment : {0, 1, 5})
    CHECK(range[segment] ==
          Approx(0.018 * 2 * std::exp(-expected[segment] / decay) * (highest - lowest)).epsilon(0.02));
}

TEST_CASE("straight wires slide from one clamp to the next and no further") {
  const Scratch scratch;
  // Bent near the base only, and twisted near the tool only.
  const Rate rate = [](double arc, std::size_t t) {
    const double wave = std::sin(0.6 * t);
    return Eigen::Vector3d(arc < 0.7 ? 2 * wave : 0.2 * wave, 0.5 * wave * arc, arc > 0.8 ? 1.5 * wave : 0);
  };
  const pipeline::Job job = job_with(straight_wires, {"strain.slip=free", "strain.probes=[]", "strain.gate=1e-7"});
  write_motion(scratch / "whole.h5", {6, 8}, 0, rate);
  write_motion(scratch / "first.h5", {6}, 0, rate);
  const Strains whole = evaluate(scratch / "whole.h5", job), first = evaluate(scratch / "first.h5", job);
  REQUIRE(whole.segment.size() == 14 * 6);
  REQUIRE(first.segment.size() == 6 * 6);
  CHECK(whole.segment.back() == 13);
  // The strains of the first span are bit-identical to those of the first span alone.
  const std::size_t points = first.strain.size();
  CHECK(std::vector<float>(whole.strain.begin(), whole.strain.begin() + static_cast<long>(points)) == first.strain);
  // The axial strain of a slipped wire is constant within a span (its own bending is 1e-4 of it). Compared: the largest strain
  // of each segment, equal within a span, different across the clamp.
  const auto largest = [](const Strains& s, std::size_t site) {
    float most = 0;
    for (std::size_t k = s.offset[site]; k < s.offset[site + 1]; ++k) most = std::max(most, std::abs(s.strain[k]));
    return most;
  };
  const float near = largest(whole, 0), far = largest(whole, 13 * 6);
  const float own_bending = 2.5e-4f;  // 0.1 mm of radius times 2.1 1/m
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(largest(whole, i * 6) - near) < own_bending);
  for (std::size_t i = 6; i < 14; ++i) CHECK(std::abs(largest(whole, i * 6) - far) < own_bending);
  // Without the clamp all segments have the same axial strain.
  write_motion(scratch / "one.h5", {14}, 0, rate);
  const Strains one = evaluate(scratch / "one.h5", job);
  CHECK(std::abs(largest(one, 0) - largest(one, 13 * 6)) < own_bending);
  CHECK(std::abs(near - largest(one, 0)) > 4 * own_bending);
}

TEST_CASE("probes and segments count through the spans") {
  const Scratch scratch;
  const Rate rate = [](double, std::size_t t) { return Eigen::Vector3d(std::sin(0.5 * t), 0, 0); };
  write_motion(scratch / "motion.h5", {5, 7}, 0, rate);
  const Strains all = evaluate(
      scratch / "motion.h5",
      job_with(straight_wires, {"strain.slip=stick", "strain.probes=[{segment_from_tool: 9, component: wire 2}]"}));
  // One probe per segment for its worst site, and the probe of the job: segment 3 from the base, in the first span.
  REQUIRE(all.probe_site.size() >= 13);
  CHECK(std::count(all.probe_site.begin(), all.probe_site.end(), 3 * 6 + 1) >= 1);
  for (std::size_t k = 0; k + 1 < all.segment.size(); ++k) CHECK(all.segment[k] <= all.segment[k + 1]);
}

TEST_CASE("a dresspack in the shape in which it was delivered is free of strain") {
  const Scratch scratch;
  const double rest = 1.5;
  // The motion goes from the delivered shape to straight and back.
  const Rate rate = [&](double, std::size_t t) { return Eigen::Vector3d(0, t % 2 == 0 ? rest : 0, 0); };
  write_motion(scratch / "motion.h5", {8}, 0, rate);
  for (const std::string& parts : {straight_wires, cables})
    for (const std::string slip : {"stick", "free"}) {
      CAPTURE(parts, slip);
      const Strains s = evaluate(scratch / "motion.h5", job_with(parts, {"strain.slip=" + slip, "strain.probes=[]",
                                                                         "dresspack.rest_curvature_1_per_m=1.5"}));
      const float rounding = 1e-7f;
      float most = 0;
      for (std::size_t site = 0; site + 1 < s.offset.size(); ++site) {
        CHECK(std::abs(s.strain[s.offset[site]]) < rounding);
        for (std::size_t k = s.offset[site]; k < s.offset[site + 1]; ++k) most = std::max(most, std::abs(s.strain[k]));
      }
      CHECK(most > 1e-4f);
    }
  // A glued wire on the inside of the bend, at angle 0 (toward x): rest length 1 - R kappa_0, straight length 1.
  const Strains s = evaluate(scratch / "motion.h5", job_with(straight_wires, {"strain.slip=stick", "strain.probes=[]",
                                                                              "strain.surface_fibres=0",
                                                                              "dresspack.rest_curvature_1_per_m=1.5"}));
  CHECK(s.strain[s.offset[0] + 1] == Approx(1 / (1 - 0.018 * rest) - 1).epsilon(1e-5));
}
