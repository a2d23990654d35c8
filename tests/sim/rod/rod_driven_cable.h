// The driven cable: both ends clamped, one end moves in space for 20 s. Other codes have solved it, for comparison.
//
// L 2 m, 2.5 kg/m, EI = GJ = 3 N m2, EA 1e5 N, tau 0.01 s, straight along x at t = 0. Gravity and the driven end start with
// the quintic q(u) = u^3 (10 - 15 u + 6 u^2), so all inputs are smooth. Curvature is compared over t = 4..24 s.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/contact/world.h"
#include "tests/sim/rod/smooth.h"

namespace dresslife::sim::test {

struct DrivenCable {
  static constexpr double begin = 4, end = 24;  ///< of the compared time [s]

  static RodProperties properties(int segments) {
    RodProperties p;
    p.segments = segments;
    p.length = 2;
    p.mass_per_length = 2.5;
    p.diameter = 0.06;
    p.bending_stiffness = p.torsional_stiffness = 3;
    p.axial_stiffness = 1e5;
    p.damping_time = 0.01;
    p.gravity.setZero();  // applied as a load that starts smoothly
    return p;
  }
  static Frame base() { return {Vector3::Zero(), Quaternion(Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitY()))}; }
  static ClampFrames clamps(double t) {
    const double pi = std::acos(-1.0), r = smooth(t / 3), s = smooth(t - 4), a = pi * (t - 4);
    Frame tool = base();
    tool.position = {2 - 0.9 * r + 0.3 * s * std::sin(a), 0.5 * s * std::cos(a), 0.3 * s * std::sin(a + 4 * pi / 3)};
    const Vector3 turn = (s * pi / 4 * std::sin(a) / std::sqrt(3.0)) * Vector3(1, 1, 1);
    tool.orientation = rotation(turn) * tool.orientation;
    return {base(), tool};
  }
  static void weigh(const Rod& rod, double t, std::vector<Load>& loads) {
    loads.resize(rod.segments());
    for (Load& load : loads) load.force = {0, 0, -9.81 * smooth(t / 0.3) * rod.segment_mass()};
  }
};

/// Result of a run per link: bending curvature over the compared time [1/m].
struct CurvatureRecord {
  std::vector<double> largest, mean_square;
  std::vector<std::vector<double>> history;  ///< (sample, link), every 0.1 s
};

/// Runs a driven cable in the world until `until` [s]. Returns its curvatures.
inline CurvatureRecord run_driven_cable(const RodProperties& properties, double h, double until) {
  const Rod rod(properties);
  WorldSettings settings;
  settings.time_step = h;
  World world(rod, settings, rod.straight(DrivenCable::base()));
  CurvatureRecord record;
  record.largest.assign(rod.links(), 0);
  record.mean_square.assign(rod.links(), 0);
  std::vector<Load> loads;
  const int steps = static_cast<int>(std::lround(until / h)), every = static_cast<int>(std::lround(0.1 / h));
  int counted = 0;
  for (int k = 0; k < steps; ++k) {
    DrivenCable::weigh(rod, k * h, loads);
    if (!world.advance(DrivenCable::clamps((k + 1) * h), {}, loads).finite) break;
    std::vector<double> curvature(rod.links());
    for (int j = 0; j < rod.links(); ++j)
      curvature[j] = rod.link_state(world.state(), j).turn.head<2>().norm() / rod.bending_length(j);
    if ((k + 1) % every == 0) record.history.push_back(curvature);
    if ((k + 1) * h < DrivenCable::begin - h / 2) continue;
    ++counted;
    for (int j = 0; j < rod.links(); ++j) {
      record.largest[j] = std::max(record.largest[j], curvature[j]);
      record.mean_square[j] += curvature[j] * curvature[j];
    }
  }
  for (double& x : record.mean_square) x /= std::max(counted, 1);
  return record;
}

inline CurvatureRecord run_driven_cable(int segments, double h, double until = DrivenCable::end) {
  return run_driven_cable(DrivenCable::properties(segments), h, until);
}

/// Returns the root mean square, over links and time from 4 s on, of the difference of two histories of curvature, relative to
/// b. Before 4 s the cable is pulled taut with a jerk, which has no order of convergence. Every `stride`-th link of b belongs
/// to a link of a. The end links are left out, because their kappa is not at the clamp's s.
inline double curvature_distance(const CurvatureRecord& a, const CurvatureRecord& b, int stride = 1) {
  double difference = 0, size = 0;
  for (size_t k = 40; k < a.history.size(); ++k)
    for (size_t j = 1; j + 1 < a.history[k].size(); ++j) {
      const double x = a.history[k][j], y = b.history[k][j * stride];
      difference += (x - y) * (x - y), size += y * y;
    }
  return std::sqrt(difference / size);
}

/// Largest and rms bending curvature [1/m] at s = 0.0125, 0.0375 .. 1.9875 m, computed with Euler-Bernoulli beam elements
/// (Chrono; 80 elements, HHT at 0.5 ms).
inline constexpr double beam_curvature[80][2] = {
    {7.18623, 5.18732}, {7.04455, 4.95839}, {6.84078, 4.71364}, {6.57455, 4.45729}, {6.26171, 4.19308},
    {5.90888, 3.92426}, {5.61475, 3.65362}, {5.35984, 3.38347}, {5.06652, 3.11574}, {4.73967, 2.85203},
    {4.38589, 2.59368}, {4.01149, 2.34193}, {3.62229, 2.09802}, {3.22355, 1.86343}, {2.82039, 1.6402},
    {2.52346, 1.43138}, {2.31922, 1.2418},  {2.11545, 1.07915}, {1.91662, 0.95481}, {1.72899, 0.88291},
    {1.60107, 0.87472}, {1.74718, 0.93059}, {1.93057, 1.03925}, {2.13946, 1.18547}, {2.36739, 1.35633},
    {2.60695, 1.54277}, {2.85447, 1.73863}, {3.1056, 1.93965},  {3.35687, 2.14259}, {3.60529, 2.34479},
    {3.84773, 2.54385}, {4.08088, 2.73748}, {4.30132, 2.92342}, {4.50477, 3.09938}, {4.68701, 3.26311},
    {4.84376, 3.41234}, {4.97229, 3.54491}, {5.06968, 3.6588},  {5.13227, 3.75217}, {5.15877, 3.82348},
    {5.15051, 3.87149}, {5.10736, 3.89534}, {5.11414, 3.89459}, {5.15353, 3.86919}, {5.19075, 3.81952},
    {5.2089, 3.74637},  {5.18888, 3.65086}, {5.12463, 3.53443}, {5.01417, 3.39879}, {4.86175, 3.24585},
    {4.66848, 3.07764}, {4.46132, 2.8963},  {4.28562, 2.704},   {4.07911, 2.50298}, {3.84638, 2.29547},
    {3.59228, 2.08384}, {3.32166, 1.87068}, {3.03926, 1.65903}, {2.74963, 1.45289}, {2.45721, 1.25802},
    {2.16653, 1.08339}, {1.88269, 0.94307}, {1.92233, 0.85682}, {2.04408, 0.8441},  {2.18737, 0.91064},
    {2.34911, 1.04391}, {2.5245, 1.22477},  {2.71155, 1.43774}, {2.90936, 1.67286}, {3.11878, 1.92411},
    {3.34647, 2.18776}, {3.61338, 2.46128}, {3.93154, 2.74271}, {4.38638, 3.03018}, {4.83755, 3.32174},
    {5.26467, 3.61509}, {5.6547, 3.90753},  {5.99685, 4.19585}, {6.28018, 4.47629}, {6.5777, 4.74464},
};

/// Returns a quantity given per link at s [m] along the cable, by the cubic through the four nearest links. (Linear
/// interpolation between links 50 mm apart has an error of up to 2 % at maxima of the curvature.)
inline double along_links(const std::vector<double>& of_link, double s) {
  const int n = static_cast<int>(of_link.size()) - 1;
  const double x = s * n / 2;
  const int first = std::clamp(static_cast<int>(x) - 1, 0, n - 3);
  double value = 0;
  for (int a = 0; a < 4; ++a) {
    double weight = 1;
    for (int b = 0; b < 4; ++b)
      if (b != a) weight *= (x - first - b) / (a - b);
    value += weight * of_link[first + a];
  }
  return value;
}

/// Returns the root mean square, over the beam's places, of the difference in rms curvature, relative to the beam's. For the
/// comparison of 4 to 24 s.
inline double rms_curvature_error(const CurvatureRecord& record) {
  double difference2 = 0, rms2 = 0;
  for (int k = 0; k < 80; ++k) {
    const double rms = std::sqrt(along_links(record.mean_square, 0.0125 + 0.025 * k));
    difference2 += std::pow(rms - beam_curvature[k][1], 2);
    rms2 += std::pow(beam_curvature[k][1], 2);
  }
  return std::sqrt(difference2 / rms2);
}

}  // namespace dresslife::sim::test
