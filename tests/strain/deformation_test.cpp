#include "strain/deformation.h"

#include <Eigen/Geometry>
#include <functional>
#include <optional>

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::strain;
using dresslife::pipeline::DeformationMeasure;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double rounding = 1e-9;  // differences of poses of order one over links of order 1e-2; machine epsilon 2e-16

/// Poses of a chain, and the storage of the numbers to which a ChainPose points.
struct Chain {
  std::vector<double> position, orientation, clamp_position, clamp_orientation, lengths;

  ChainPose pose() const { return {position, orientation, clamp_position, clamp_orientation}; }
  std::optional<Vector3d> free_end{};
  std::vector<Deformation> measure(DeformationMeasure measure) const {
    DeformationGauge gauge(lengths, measure, free_end);
    std::vector<Deformation> out(lengths.size());
    gauge.measure(pose(), out);
    return out;
  }
};

void append(std::vector<double>& to, const Vector3d& v) { to.insert(to.end(), {v.x(), v.y(), v.z()}); }
void append(std::vector<double>& to, const Quaterniond& q) { to.insert(to.end(), {q.w(), q.x(), q.y(), q.z()}); }

using Rate = std::function<Vector3d(double s)>;  // rotation rate in the body frame [1/m]

/// Returns the poses at segment centres and clamps of the curve with frame rate `rate` and stretch `stretch`. The integration
/// steps are so small that their error is far below that of the measures.
Chain chain_on_curve(double length, int segments, const Rate& rate, double stretch = 1) {
  const int steps = 2 * 500;  // per segment; even, so that a step ends at each centre
  const double h = length / segments / steps;
  Chain chain;
  Quaterniond q = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  Vector3d x(0.1, 0.2, 0.3);
  auto put_clamp = [&] {
    append(chain.clamp_position, x);
    append(chain.clamp_orientation, q);
  };
  put_clamp();
  for (int i = 0; i < segments; ++i) {
    for (int k = 0; k < steps; ++k) {
      if (k == steps / 2) {
        append(chain.position, x);
        append(chain.orientation, q);
      }
      const Vector3d turn = rate((i * steps + k + 0.5) * h) * h;
      auto turned = [&](double share) {
        const double angle = turn.norm();
        return angle == 0 ? q : q * Quaterniond(Eigen::AngleAxisd(share * angle, turn / angle));
      };
      x += stretch * h * (turned(0.5) * Vector3d::UnitZ());
      q = turned(1).normalized();
    }
    chain.lengths.push_back(length / segments);
  }
  put_clamp();
  return chain;
}

/// Returns the largest difference of the measured rotation rate from the curve's at the segment centres, without `ends`
/// segments at either end.
double worst_error(const Chain& chain, const Rate& rate, DeformationMeasure measure, std::size_t ends = 0) {
  double worst = 0, start = 0;
  const auto measured = chain.measure(measure);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Vector3d expected = rate(start + chain.lengths[i] / 2);
    start += chain.lengths[i];
    if (i < ends || i + ends >= measured.size()) continue;
    const Vector3d got(measured[i].curvature1, measured[i].curvature2, measured[i].twist);
    worst = std::max(worst, (got - expected).norm());
  }
  return worst;
}

Vector3d rate_of(const Deformation& of) { return {of.curvature1, of.curvature2, of.twist}; }

/// Returns the deformation at the places where wires are evaluated: for the outermost segments, at the known ends.
std::vector<Deformation> at_wires(const Chain& chain, DeformationMeasure measure) {
  DeformationGauge gauge(chain.lengths, measure, chain.free_end);
  std::vector<Deformation> found(chain.lengths.size());
  gauge.measure(chain.pose(), found);
  gauge.move_to_ends(found);
  return found;
}

/// Returns a chain of the simulator's kind with the rotation `rotation` at each link: rigid segments whose ends meet, in
/// bends a little outside the curve (sim/rod/theory.md, S17).
Chain jointed_chain(double segment_length, const std::vector<Vector3d>& rotation) {
  Chain chain;
  Quaterniond q = Quaterniond::Identity();
  Vector3d x = Vector3d::Zero();
  append(chain.clamp_position, x);
  append(chain.clamp_orientation, q);
  auto turn = [&](const Vector3d& phi) {
    if (phi.norm() > 0) q = q * Quaterniond(Eigen::AngleAxisd(phi.norm(), phi.normalized()));
  };
  turn(rotation.front());
  x += segment_length / 2 * (q * Vector3d::UnitZ());
  for (std::size_t i = 0; i + 1 < rotation.size(); ++i) {
    append(chain.position, x);
    append(chain.orientation, q);
    chain.lengths.push_back(segment_length);
    const Vector3d before = q * Vector3d::UnitZ();
    if (i + 2 == rotation.size()) {
      x += segment_length / 2 * before;
      break;
    }
    turn(rotation[i + 1]);
    const Vector3d after = q * Vector3d::UnitZ();
    x += segment_length / 2 * (1 + (1 - before.dot(after)) / 12) * (before + after);
  }
  turn(rotation.back());
  append(chain.clamp_position, x);
  append(chain.clamp_orientation, q);
  return chain;
}

}  // namespace

TEST_CASE("a circle has the curvature of its radius, about the axis it bends around") {
  const double radius = 0.25;
  const Rate rate = [&](double) { return Vector3d(0.6 / radius, -0.8 / radius, 0); };
  const Chain chain = chain_on_curve(1.0, 20, rate);
  CHECK(worst_error(chain, rate, DeformationMeasure::rotation_vector) < rounding);
  // The tolerance is the error of the integrated positions. The circle through three points of a circle is exact.
  constexpr double integration = 1e-6;
  CHECK(worst_error(chain, rate, DeformationMeasure::thesis) < integration);
}

TEST_CASE("a uniform twist of many turns is found at every segment") {
  const double turns = 5, length = 2;
  const Rate rate = [&](double) { return Vector3d(0, 0, turns * 2 * pi / length); };
  const Chain chain = chain_on_curve(length, 40, rate);
  CHECK(worst_error(chain, rate, DeformationMeasure::rotation_vector) < rounding);
  CHECK(worst_error(chain, rate, DeformationMeasure::thesis) < rounding);
}

TEST_CASE("a bent and twisted dresspack of uniform state is a helix and measured exactly") {
  const Rate rate = [](double) { return Vector3d(3, -2, 4); };
  const Chain chain = chain_on_curve(1.5, 30, rate);
  CHECK(worst_error(chain, rate, DeformationMeasure::rotation_vector) < rounding);
}

TEST_CASE("on samples of a curve the rotation vector's error falls with the square of the segment length") {
  const auto cantilever = [](double s) { return Vector3d(4 * (1 - s) * (1 - s), 0, 0); };
  const auto winding = [](double s) { return Vector3d(3 * std::cos(4 * s), 2 * std::sin(3 * s), 5 * s * s); };
  for (const Rate& rate : {Rate(cantilever), Rate(winding)}) {
    const Chain coarse_chain = chain_on_curve(1, 20, rate), fine_chain = chain_on_curve(1, 40, rate);
    const double coarse = worst_error(coarse_chain, rate, DeformationMeasure::rotation_vector, 3);
    const double fine = worst_error(fine_chain, rate, DeformationMeasure::rotation_vector, 6);
    CAPTURE(coarse, fine);
    CHECK(std::log2(coarse / fine) > 1.9);
    // Tolerance with the end segments: 0.03 times the change of at most 17 1/m2 over a segment, plus second order.
    CHECK(worst_error(fine_chain, rate, DeformationMeasure::rotation_vector) < 0.04 * 17 / 40);
  }
}

TEST_CASE("on a simulated chain the error falls with the third power, ends included") {
  const Rate rate = [](double s) { return Vector3d(3 * std::cos(4 * s), 2 * std::sin(3 * s), 5 * s * s); };
  auto chain = [&](int segments) {
    const double l = 1.0 / segments;
    std::vector<Vector3d> rotation;
    for (int link = 0; link <= segments; ++link) {
      const int from_end = std::min(link, segments - link);
      const double compliance = from_end == 0 ? 5.0 / 12 : from_end == 1 ? 13.0 / 12 : 1;
      rotation.push_back(compliance * l * rate(link * l));
    }
    return jointed_chain(l, rotation);
  };
  const double coarse = worst_error(chain(40), rate, DeformationMeasure::rotation_vector);
  const double fine = worst_error(chain(80), rate, DeformationMeasure::rotation_vector);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) > 2.8);
  CHECK(fine < 1e-4);  // of 3 to 5 1/m

  const auto error_at_ends = [&](int segments) {
    const std::vector<Deformation> found = at_wires(chain(segments), DeformationMeasure::rotation_vector);
    return std::max((rate_of(found.front()) - rate(0)).norm(), (rate_of(found.back()) - rate(1)).norm());
  };
  const double coarse_ends = error_at_ends(40), fine_ends = error_at_ends(80);
  CAPTURE(coarse_ends, fine_ends);
  CHECK(std::log2(coarse_ends / fine_ends) > 2.8);
  CHECK(fine_ends < 1e-3);  // the centre's value differs by half of l times a slope of 12 1/m2: 0.08
}

TEST_CASE("at a free end the error falls with the third power too") {
  // The rates approach those of the undeformed dresspack at the tip, s = 1, where the chain has no link.
  const Vector3d rest(0, 0.8, 0);
  const Rate rate = [&](double s) {
    return Vector3d(rest + Vector3d(4 * (1 - s) * (1 - s), std::sin(3 * (1 - s)), 2 * (1 - s)));
  };
  const auto chain = [&](int segments) {
    const double l = 1.0 / segments;
    std::vector<Vector3d> rotation;
    for (int link = 0; link < segments; ++link)
      rotation.push_back((link == 0 ? 5.0 / 12 : link == 1 ? 13.0 / 12 : 1) * l * rate(link * l));
    rotation.push_back(Vector3d::Zero());
    Chain hanging = jointed_chain(l, rotation);
    hanging.free_end = rest;
    return hanging;
  };
  const double coarse = worst_error(chain(40), rate, DeformationMeasure::rotation_vector);
  const double fine = worst_error(chain(80), rate, DeformationMeasure::rotation_vector);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) > 2.8);
  CHECK(fine < 1e-4);  // of up to 4 1/m
}

TEST_CASE("ends move to clamps only where a curve through the links is known") {
  const Rate rate = [](double s) { return Vector3d(3 * std::exp(-s / 0.1), 1 - s, 2 * s); };
  const auto moved = [&](Chain chain, DeformationMeasure measure) {
    const std::vector<Deformation> centres = chain.measure(measure), ends = at_wires(chain, measure);
    for (std::size_t i = 1; i + 1 < ends.size(); ++i) CHECK(rate_of(ends[i]) == rate_of(centres[i]));
    return std::array{rate_of(ends.front()) != rate_of(centres.front()),
                      rate_of(ends.back()) != rate_of(centres.back())};
  };
  Chain chain = chain_on_curve(1, 20, rate);
  CHECK(moved(chain, DeformationMeasure::rotation_vector) == std::array{true, true});
  CHECK(moved(chain, DeformationMeasure::thesis) == std::array{false, false});
  CHECK(moved(chain_on_curve(1, 6, rate), DeformationMeasure::rotation_vector) == std::array{false, false});
  chain.free_end = Vector3d(0, 0, 2);
  CHECK(moved(chain, DeformationMeasure::rotation_vector) == std::array{true, false});
  chain.lengths.front() *= 1.1;
  CHECK(moved(chain, DeformationMeasure::rotation_vector) == std::array{false, false});
}

TEST_CASE("few or unequal segments are measured too") {
  const Rate rate = [](double) { return Vector3d(1, -2, 3); };
  for (const int segments : {1, 2, 3, 5})
    CHECK(worst_error(chain_on_curve(0.2, segments, rate), rate, DeformationMeasure::rotation_vector) < rounding);
}

TEST_CASE("the thesis' measure converges at second order inside the chain") {
  const Rate rate = [](double s) { return Vector3d(3 * std::cos(4 * s), 2 * std::sin(3 * s), 0); };
  const double coarse = worst_error(chain_on_curve(1, 20, rate), rate, DeformationMeasure::thesis, 1);
  const double fine = worst_error(chain_on_curve(1, 40, rate), rate, DeformationMeasure::thesis, 1);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) > 1.9);
}

TEST_CASE("a uniformly bent chain with corrected clamp links is uniform in every segment") {
  const double l = 0.04, curvature = 2;
  std::vector<Vector3d> rotation(21, Vector3d(curvature * l, 0, 0.5 * l));
  for (const std::size_t end : {std::size_t{0}, rotation.size() - 1}) rotation[end] *= 5.0 / 12;
  for (const std::size_t next : {std::size_t{1}, rotation.size() - 2}) rotation[next] *= 13.0 / 12;
  const Chain chain = jointed_chain(l, rotation);
  CHECK(worst_error(
            chain, [&](double) { return Vector3d(curvature, 0, 0.5); }, DeformationMeasure::rotation_vector) <
        rounding);
  for (const Deformation& d : chain.measure(DeformationMeasure::rotation_vector))
    CHECK(std::abs(d.elongation) < rounding);
}

TEST_CASE("a stretched dresspack shows its elongation in both measures") {
  const double stretch = 1.003;
  const Chain chain = chain_on_curve(
      1, 20, [](double) { return Vector3d::Zero().eval(); }, stretch);
  for (const auto measure : {DeformationMeasure::rotation_vector, DeformationMeasure::thesis})
    for (const Deformation& d : chain.measure(measure)) CHECK(d.elongation == Approx(stretch - 1).epsilon(1e-9));
}

TEST_CASE("a quaternion and its negative are the same pose") {
  const Rate rate = [](double s) { return Vector3d(2 + s, -1, 3); };
  Chain chain = chain_on_curve(1, 12, rate);
  const auto before = chain.measure(DeformationMeasure::rotation_vector);
  for (std::size_t i = 4; i < 8; ++i) chain.orientation[i] = -chain.orientation[i];
  const auto after = chain.measure(DeformationMeasure::rotation_vector);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].twist == Approx(before[i].twist).margin(rounding));
}
