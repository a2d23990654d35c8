#include "strain/net_bend.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dresslife::strain {

void RangeOfVector::add(double x, double y) {
  static const std::array<std::complex<double>, directions> unit = [] {
    std::array<std::complex<double>, directions> all;
    for (int k = 0; k < directions; ++k) all[k] = std::polar(1.0, std::numbers::pi * k / directions);
    return all;
  }();
  for (int k = 0; k < directions; ++k) {
    const double along = unit[k].real() * x + unit[k].imag() * y;
    low_[k] = any_ ? std::min(low_[k], along) : along;
    high_[k] = any_ ? std::max(high_[k], along) : along;
  }
  any_ = true;
}

double RangeOfVector::largest() const {
  double range = 0;
  for (int k = 0; k < directions; ++k) range = std::max(range, high_[k] - low_[k]);
  return range;
}

NetBend::NetBend(const Construction& construction, const std::vector<LayerSlip>& plan,
                 const std::vector<double>& lengths, const std::vector<double>& arcs, double free_length)
    : bends_(lengths.size()) {
  const std::vector<Layer>& layers = construction.layers();
  std::vector<double> wire_radius(layers.size(), 0.0);
  for (std::size_t k = layers.size(); k-- > 0;) {  // parents come first
    if (layers[k].is_wire) wire_radius[k] = layers[k].part_radius;
    if (layers[k].parent != dresspack_itself)
      wire_radius[layers[k].parent] = std::max(wire_radius[layers[k].parent], wire_radius[k]);
  }
  // path length and turn [rad] per length of the dresspack
  std::vector<double> path(layers.size()), turn(layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Layer& layer = layers[k];
    const bool outermost = layer.parent == dresspack_itself;
    const double along = outermost ? 1 : path[layer.parent];
    path[k] = along / layer.lay_cosine;
    turn[k] = outermost ? 0 : turn[layer.parent];
    if (layer.is_cable() && layer.loose) continue;  // it does not turn about itself
    if (layer.helix_radius > 0) turn[k] += along * std::tan(layer.lay_angle) / layer.helix_radius;
    if (plan[k].sliding != Sliding::over_pitch || wire_radius[k] == 0) continue;
    OfLayer of{static_cast<int>(k), layer.pitch(), wire_radius[k], {}, {}};
    const double per_bend = layer.helix_radius * std::pow(layer.lay_cosine, 2) * plan[k].radial_share / free_length;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const double half = turn[k] * lengths[i] / 2, mean = half == 0 ? 1 : std::sin(half) / half;
      of.weights.push_back(std::polar(1.0, -turn[k] * arcs[i]) * (per_bend * lengths[i] * mean));
    }
    layers_.push_back(std::move(of));
  }
}

void NetBend::add(const DeformationHistory& block) {
  std::vector<std::complex<double>> net(layers_.size() * block.samples());
  for (std::size_t i = 0; i < bends_.size(); ++i) {
    const DeformationColumns here = block.columns(i);
    for (std::size_t t = 0; t < block.samples(); ++t) {
      const std::complex<double> bend(here.curvature1[t], here.curvature2[t]);
      bends_[i].add(bend.real(), bend.imag());
      for (std::size_t k = 0; k < layers_.size(); ++k) net[t * layers_.size() + k] += bend * layers_[k].weights[i];
    }
  }
  for (std::size_t t = 0; t < block.samples(); ++t)
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      const std::complex<double> of = net[t * layers_.size() + k];
      layers_[k].range.add(of.real(), of.imag());
    }
}

NetBend::Largest NetBend::largest(const std::vector<int>& without) const {
  double bend = 0;
  for (const RangeOfVector& range : bends_) bend = std::max(bend, range.largest());
  Largest most;
  for (const OfLayer& of : layers_) {
    if (std::ranges::find(without, of.layer) != without.end()) continue;
    const double strain = of.range.largest(), own = of.wire_radius * bend;
    if (strain * most.own >= most.strain * own && strain > 0) most = {of.layer, of.lay, strain, own};
  }
  return most;
}

}  // namespace dresslife::strain
