#include "tests/strain/strand_contact.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/errors.h"

namespace dresslife::strain {
namespace {

constexpr int nodes = 45;                // over a quarter; the last node, at pi/2, does not move
constexpr double step = pi / 2 / nodes;  // [rad]
constexpr double rigid = 1e4;  // stiffness of a rigid contact / the layer's own against a wave over the section
constexpr double poisson_ratio = 0.33;
constexpr int most_rounds = 200;  // of the search for the sliding crossings

double section(const StrandLayer& layer) { return pi * layer.wire_radius * layer.wire_radius; }

/// Returns K of (W24), of the crossings of two layers, per length of the strand and radian. load: radial, per same unit.
double crossing_stiffness(const StrandLayer& inner, const StrandLayer& outer, double load) {
  const auto turns = [](const StrandLayer& layer) { return std::tan(layer.lay_angle) / (2 * pi * layer.helix_radius); };
  const double crossings = inner.count * outer.count * (turns(inner) + turns(outer)) / (2 * pi);
  const double radius = std::sqrt(inner.wire_radius * outer.wire_radius) / std::sin(inner.lay_angle + outer.lay_angle);
  const double compliance = 1 / inner.youngs_modulus + 1 / outer.youngs_modulus;
  const double normal_modulus = 1 / ((1 - poisson_ratio * poisson_ratio) * compliance);
  const double shear_modulus = 1 / (2 * (2 - poisson_ratio) * (1 + poisson_ratio) * compliance);
  const double contact = std::cbrt(3 * load / crossings * radius / (4 * normal_modulus));
  return crossings * 8 * contact * shear_modulus;
}

}  // namespace

StrandContact::StrandContact(const Strand& strand, Contacts contacts) {
  double stretch_stiffness = 0;
  for (const StrandLayer& layer : strand.layers) {
    const double cosine = std::cos(layer.lay_angle), EA = layer.youngs_modulus * section(layer);
    stretch_stiffness += layer.count * EA * std::pow(cosine, 3);
    own_stiffness_ += layer.count * EA * layer.wire_radius * layer.wire_radius / 4 * cosine;
  }
  double load = 0;  // radial, of this layer and those outside, per length and radian [N/m]
  for (std::size_t k = strand.layers.size(); k-- > 1;) {
    const StrandLayer &layer = strand.layers[k], &inner = strand.layers[k - 1];
    assert(layer.helix_radius > 0 && layer.lay_angle > 0);
    const double R = layer.helix_radius, EA = layer.youngs_modulus * section(layer);
    const double sine = std::sin(layer.lay_angle), cosine = std::cos(layer.lay_angle);
    const double turn = sine / cosine / R;  // kappa_i
    if (layer.jacket_stiffness > 0)
      throw pipeline::InputError({}, "a strand on contacts that give has no jacket that holds its wires elastically",
                                 "leave out jacket_stiffness, or use StrandBending, which has it");
    const double own_press = strand.tension * EA * cosine * cosine / stretch_stiffness * sine * sine / R;
    load += layer.count / (2 * pi) * (own_press + layer.line_load) / cosine;
    const Layer own{cosine * cosine * R, layer.count * EA * cosine * R, turn * cosine,
                    layer.count * EA * turn / (2 * pi)};
    const bool lines = inner.helix_radius == 0;
    const double stiffness = lines || contacts == Contacts::rigid ? rigid * own.force * own.gradient
                                                                  : crossing_stiffness(inner, layer, load);
    layers_.insert(layers_.begin(), own);
    interfaces_.insert(interfaces_.begin(), {stiffness, strand.friction * load, std::vector<double>(nodes, 0.0),
                                             std::vector<int>(nodes, 0)});
  }
}

/// Solves (W24) for the displacements (layer, node), with the marked crossings sliding. Strains are defined between the nodes.
/// At phi = 0 a wire has no strain, at pi/2 no displacement.
std::vector<std::vector<double>> StrandContact::displacements(double curvature) const {
  const int count = static_cast<int>(layers_.size()), size = count * nodes;
  const auto at = [&](int layer, int node) { return node * count + layer; };
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < count; ++i) {
    const Layer& layer = layers_[i];
    const double spring = layer.force * layer.gradient / step;
    for (int m = 0; m < nodes; ++m) {
      const int row = at(i, m);
      const auto plane = [&](int cell) {
        return layer.force * layer.strain_per_curvature * curvature * std::sin((cell + 0.5) * step);
      };
      left(row, row) -= spring;
      if (m + 1 < nodes) left(row, at(i, m + 1)) += spring;
      right[row] -= plane(m);
      if (m > 0) {
        left(row, row) -= spring;
        left(row, at(i, m - 1)) += spring;
        right[row] += plane(m - 1);
      }
      const double width = m == 0 ? step / 2 : step;
      for (const int face : {i, i + 1}) {  // inner, outer
        if (face == count) continue;
        const Interface& interface = interfaces_[face];
        if (interface.sliding[m] != 0) {
          right[row] += interface.sliding[m] * interface.cap * width;
          continue;
        }
        left(row, at(face, m)) -= interface.stiffness * width;
        if (face > 0) left(row, at(face - 1, m)) -= interface.stiffness * width;
        right[row] -= interface.stiffness * interface.slip[m] * width;
      }
    }
  }
  const Eigen::VectorXd solved = left.partialPivLu().solve(right);
  std::vector<std::vector<double>> u(count, std::vector<double>(nodes + 1, 0.0));
  for (int i = 0; i < count; ++i)
    for (int m = 0; m < nodes; ++m) u[i][m] = solved[at(i, m)];
  return u;
}

double StrandContact::traction(const Interface& interface, std::size_t node, double displacement) const {
  return interface.stiffness * (displacement - interface.slip[node]);
}

/// Marks the crossings that slide under these displacements. Returns whether any mark changed.
bool StrandContact::settle(const std::vector<std::vector<double>>& u) {
  constexpr double rounding = 1e-9;
  bool changed = false;
  for (std::size_t j = 0; j < interfaces_.size(); ++j)
    for (std::size_t m = 0; m < static_cast<std::size_t>(nodes); ++m) {
      Interface& face = interfaces_[j];
      const double force = traction(face, m, u[j][m] + (j > 0 ? u[j - 1][m] : 0));
      int& sliding = face.sliding[m];
      const int before = sliding;
      if (sliding == 0 && std::abs(force) > face.cap * (1 + rounding))
        sliding = force > 0 ? 1 : -1;
      else if (sliding != 0 && sliding * force < face.cap * (1 - rounding))
        sliding = 0;
      changed = changed || sliding != before;
    }
  return changed;
}

double StrandContact::moment(double curvature) {
  std::vector<std::vector<double>> u = displacements(curvature);
  for (int round = 0; settle(u) && round < most_rounds; ++round) u = displacements(curvature);
  double sum = own_stiffness_ * curvature;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    double mean = 0;  // of eps sin(phi)
    for (int m = 0; m < nodes; ++m) {
      const double sine = std::sin((m + 0.5) * step);
      const double strain =
          layer.strain_per_curvature * curvature * sine + layer.gradient * (u[i][m + 1] - u[i][m]) / step;
      mean += strain * sine / nodes;
    }
    sum += layer.moment_per_strain * mean;
  }
  for (std::size_t j = 0; j < interfaces_.size(); ++j)  // return mapping: updates the slip
    for (std::size_t m = 0; m < static_cast<std::size_t>(nodes); ++m) {
      Interface& face = interfaces_[j];
      const double displacement = u[j][m] + (j > 0 ? u[j - 1][m] : 0);
      if (face.sliding[m] != 0) face.slip[m] = displacement - face.sliding[m] * face.cap / face.stiffness;
    }
  return sum;
}

}  // namespace dresslife::strain
