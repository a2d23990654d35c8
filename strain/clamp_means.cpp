#include "strain/clamp_means.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace dresslife::strain {

ClampMeans::ClampMeans(const Construction& construction, std::vector<LayerSlip> plan,
                       std::vector<double> lengths, std::vector<double> arcs, std::size_t samples)
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
  struct Member {
    int layer, number;
    double turn;
  };
  std::vector<Member> members;
  Group group{parent, {}, {}};
  const int parent_layer =
      parent == dresspack_itself ? dresspack_itself : construction_.parts()[parent].layer;
  const auto& parts = construction_.parts();
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].parent == parent && plan_[parts[k].layer].sliding == Sliding::clamp_to_clamp) {
      members.push_back({parts[k].layer, parts[k].number, 0});
      part_row_[static_cast<int>(k)] = add_row();
      group.rows.push_back(strain_.size() - 1);
    }
  for (std::size_t k = 0; k < construction_.layers().size(); ++k) {
    const Layer& layer = construction_.layers()[k];
    if (!layer.is_wire || layer.parent != parent_layer || plan_[k].sliding != Sliding::clamp_to_clamp)
      continue;
    layer_row_[{parent, static_cast<int>(k)}] = strain_.size();
    for (int node = 0; node < waves_per_layer; ++node) {
      members.push_back({static_cast<int>(k), 1, 2 * std::numbers::pi * node / waves_per_layer});
      group.rows.push_back(add_row());
    }
  }
  if (members.empty()) return;
  for (std::size_t segment = 0; segment < lengths_.size(); ++segment) {
    const double arc = arcs_[segment];
    BundleNesting nesting = nesting_to(construction_, plan_, parent, arc, surface_fibres(0));
    for (const Member& member : members)
      nesting.nodes.push_back(
          node_at(construction_, plan_, nesting, member.layer, member.number, parent, arc, member.turn));
    group.nestings.push_back(std::move(nesting));
  }
  groups_.push_back(std::move(group));
}

void ClampMeans::add(const DeformationHistory& block) {
  const std::size_t count = block.samples(), stride = padded(count);
  assert(next_ + count <= stride_);
  for (Group& group : groups_) {
    const std::size_t nodes = group.rows.size();
    std::vector<double> path(nodes * stride, 0.0), rest(nodes, 0.0);
    for (std::size_t segment = 0; segment < lengths_.size(); ++segment) {
      BundleNesting& nesting = group.nestings[segment];
      attach(nesting, group.parent, next_);
      kernels().add_path_rates(pointers(nesting), block.columns(segment), 0, count, lengths_[segment],
                               path.data(), stride);
      for (std::size_t n = 0; n < nodes; ++n) rest[n] += lengths_[segment] * nesting.nodes[n].rest_rate;
    }
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t t = 0; t < count; ++t)
        strain_[group.rows[n]][next_ + t] = path[n * stride + t] / rest[n] - 1;
  }
  next_ += count;
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
    // the value at one angle of the five waves through the nodes: Dirichlet's kernel
    const double away = turn - 2 * std::numbers::pi * node / waves_per_layer;
    const double share = (1 + 2 * std::cos(away) + 2 * std::cos(2 * away)) / waves_per_layer;
    const double* of = of_node(part, layer, node);
    assert(of);
    for (std::size_t t = 0; t < stride_; ++t) strain[t] += share * of[t];
  }
  return strain;
}

ClampMeans::ClampMeans(const ClampMeans& whole, std::size_t every)
    : construction_(whole.construction_),
      plan_(whole.plan_),
      lengths_(whole.lengths_),
      arcs_(whole.arcs_),
      stride_(padded((whole.next_ + every - 1) / every) + padding),
      next_(whole.next_),
      part_row_(whole.part_row_),
      layer_row_(whole.layer_row_) {
  for (const std::vector<double>& row : whole.strain_) {
    std::vector<double>& thin = strain_.emplace_back(stride_, 0.0);
    for (std::size_t k = 0; k * every < next_; ++k) thin[k] = row[k * every];
  }
}

void ClampMeans::attach(BundleNesting& nesting, int part, std::size_t first) const {
  const std::vector<int> line = construction_.ancestry(part);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (nesting.steps[k].slide.sliding == Sliding::clamp_to_clamp)
      nesting.steps[k].slide.clamp_strain = of_part(line[k]) + first;
}

}  // namespace dresslife::strain
