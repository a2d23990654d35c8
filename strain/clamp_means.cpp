#include "strain/clamp_means.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace dresslife::strain {

ClampMeans::ClampMeans(const Construction& construction, std::vector<LayerSlip> plan, std::vector<double> lengths,
                       std::vector<double> arcs, std::size_t samples)
    : construction_(construction),
      plan_(std::move(plan)),
      lengths_(std::move(lengths)),
      arcs_(std::move(arcs)),
      stride_(padded(samples) + padding) {  // a block may end within a pack
  list_group(dresspack_itself);
  for (std::size_t part = 0; part < construction_.parts().size(); ++part) list_group(static_cast<int>(part));
}

std::size_t ClampMeans::add_row() {
  strain_.emplace_back(stride_, 0.0);
  return strain_.size() - 1;
}

void ClampMeans::list_group(int parent) {
  std::vector<PathMember> members;
  std::vector<std::size_t> rows;
  const int parent_layer = parent == dresspack_itself ? dresspack_itself : construction_.parts()[parent].layer;
  const auto& parts = construction_.parts();
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].parent == parent && plan_[parts[k].layer].sliding == Sliding::clamp_to_clamp &&
        !construction_.layers()[parts[k].layer].is_cable()) {
      members.push_back({parts[k].layer, parts[k].number, 0});
      part_row_[static_cast<int>(k)] = add_row();
      rows.push_back(strain_.size() - 1);
    }
  for (std::size_t k = 0; k < construction_.layers().size(); ++k) {
    const Layer& layer = construction_.layers()[k];
    if (!layer.is_wire || layer.parent != parent_layer || plan_[k].sliding != Sliding::clamp_to_clamp) continue;
    layer_row_[{parent, static_cast<int>(k)}] = strain_.size();
    for (int node = 0; node < waves_per_layer; ++node) {
      members.push_back({static_cast<int>(k), 1, 2 * std::numbers::pi * node / waves_per_layer});
      rows.push_back(add_row());
    }
  }
  if (members.empty()) return;
  int round = 0;
  if (parent != dresspack_itself)
    for (const int above : construction_.ancestry(parent)) round += part_row_.contains(above) ? 1 : 0;
  rounds_ = std::max(rounds_, round + 1);
  groups_.push_back({parent, round, {construction_, plan_, parent, members, lengths_, arcs_}, rows});
}

void ClampMeans::add(int round, std::size_t segment, const SegmentMotion& motion) {
  const std::size_t stride = padded(motion.samples);
  assert(next_ + motion.samples <= stride_);
  in_block_ = motion.samples;
  for (Group& group : groups_) {
    if (group.round != round) continue;
    const std::size_t members = group.rows.size();
    group.path.resize(members * stride, 0.0);
    group.rest.resize(members, 0.0);
    const DeformationColumns& columns = motion.columns(construction_, plan_, group.parent);
    group.rates.add(
        segment, columns, motion.samples, [&](BundleNesting& nesting) { attach(nesting, group.parent, motion, next_); },
        group.path.data(), stride);
    for (std::size_t n = 0; n < members; ++n) group.rest[n] += group.rates.rest(segment, n);
  }
}

void ClampMeans::end_round(int round) {
  const std::size_t stride = padded(in_block_);
  for (Group& group : groups_) {
    if (group.round != round) continue;
    for (std::size_t n = 0; n < group.rows.size(); ++n)
      for (std::size_t t = 0; t < in_block_; ++t)
        strain_[group.rows[n]][next_ + t] = group.path[n * stride + t] / group.rest[n] - 1;
    group.path.clear();
    group.rest.clear();
  }
}

const double* ClampMeans::of_part(int part) const {
  const auto found = part_row_.find(part);
  return found == part_row_.end() ? nullptr : strain_[found->second].data();
}

const double* ClampMeans::of_node(int part, int layer, int node) const {
  const auto found = layer_row_.find({part, layer});
  return found == layer_row_.end() ? nullptr : strain_[found->second + node].data();
}

std::vector<double> ClampMeans::at_angle(int part, int layer, double turn) const {
  std::vector<double> strain(stride_, 0.0);
  for (int node = 0; node < waves_per_layer; ++node) {
    // value at one angle of the five waves through the nodes: Dirichlet's kernel
    const double away = turn - 2 * std::numbers::pi * node / waves_per_layer;
    const double share = (1 + 2 * std::cos(away) + 2 * std::cos(2 * away)) / waves_per_layer;
    const double* of = of_node(part, layer, node);
    assert(of);
    for (std::size_t t = 0; t < stride_; ++t) strain[t] += share * of[t];
  }
  return strain;
}

void ClampMeans::attach(BundleNesting& nesting, int part, const SegmentMotion& motion, std::size_t first) const {
  const std::vector<int> line = construction_.ancestry(part);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (nesting.steps[k].slide.sliding == Sliding::clamp_to_clamp)
      nesting.steps[k].slide.clamp_strain =
          k == 0 ? motion.strain[construction_.cable_of(line[k])] : of_part(line[k]) + first;
}

ShortenedPlan ClampMeans::shorten(double bend_wave) {
  const ShortenedPlan result = shortened(construction_, plan_, bend_wave);
  plan_ = result.plan;
  return result;
}

void ClampMeans::set_lines(const std::vector<int>& layers, std::shared_ptr<const LongWaves> lines) {
  lines_ = std::move(lines);
  for (const int layer : layers) {
    plan_[layer].friction = false;
    plan_[layer].cap = {};
    plan_[layer].elastic = 0;
  }
}

ClampMeans ClampMeans::rubbing(double factor) const {
  ClampMeans means = *this;
  for (LayerSlip& slip : means.plan_)
    slip.cap =
        factor == glued ? FrictionCap{glued, 0} : FrictionCap{slip.cap.constant * factor, slip.cap.per_mean * factor};
  return means;
}

}  // namespace dresslife::strain
