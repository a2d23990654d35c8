#include "strain/bundle_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/constants.h"
#include "strain/kernels/lane_groups.h"

namespace dresslife::strain {
namespace {

// Strains of two groups, 8 kB, stay in the first-level cache between mixing and scanning, beside the waves of their layer.
constexpr std::size_t mixed_at_once = 64;

/// Returns the share of node `node` in the value at one angle of the waves through a layer's nodes: Dirichlet's kernel.
double nodal_share(double angle, int node) {
  const double away = angle - 2 * pi * node / waves_per_layer;
  return (1 + 2 * std::cos(away) + 2 * std::cos(2 * away)) / waves_per_layer;
}

}  // namespace

double rest_ingredient(const WireNode& node, const Fibre* fibre) {
  const double length = rest_length(node.place.kinematics, node.rest);
  if (fibre == nullptr) return node.strain_factor * node.shear_radius / std::numbers::sqrt3 * node.rest.twist / length;
  const FibreShape shape = shape_of(*fibre, node);
  return shape.by_bend1 * node.rest.bend1 + shape.by_bend2 * node.rest.bend2;
}

FibreShape shape_of(const Fibre& fibre, const WireNode& node) {
  if (fibre.on_axis) return {};
  return fibre_shape(node.place.kinematics, node.rest, node.wire_radius, fibre.phi_sine, fibre.phi_cosine);
}

MixedLanes BundleScan::mixed_lanes(const WireNode* nodes, const Fibre* fibres, const LayerSlip& slip,
                                   const std::vector<double>& angles) const {
  MixedLanes mixed;
  constexpr float glued = std::numeric_limits<float>::infinity();
  mixed.cap = slip.sliding == Sliding::glued ? glued : static_cast<float>(slip.cap.constant);
  mixed.cap_per_mean = static_cast<float>(slip.cap.per_mean);
  mixed.elastic = static_cast<float>(slip.elastic);
  mixed.inverse_radial_share = static_cast<float>(1 / slip.radial_share);
  mixed.scales = !is_thesis(construction_.kinematics());
  mixed.with_shear = settings_.with_shear;
  mixed.on_axis = settings_.on_axis;
  mixed.used = static_cast<int>(angles.size());
  mixed.rest.resize(1 + settings_.fibre_count);
  mixed.fibre_scale.resize(settings_.fibre_count);
  std::vector<double> at_rest;  // (kind, node)
  for (int kind = 0; kind <= settings_.fibre_count; ++kind)
    for (int node = 0; node < waves_per_layer; ++node)
      at_rest.push_back(rest_ingredient(nodes[node], kind == 0 ? nullptr : &fibres[kind - 1]));
  for (int lane = 0; lane < lanes; ++lane) {
    const double angle = angles[lane < static_cast<int>(angles.size()) ? lane : 0];
    std::array<double, waves_per_layer> shares;
    for (int node = 0; node < waves_per_layer; ++node) shares[node] = nodal_share(angle, node);
    mixed.slip[lane] = 0;
    mixed.least_slip[lane] = -glued;
    mixed.most_slip[lane] = glued;
    mixed.shape[0][lane] = static_cast<float>(std::sin(angle));
    mixed.shape[1][lane] = static_cast<float>(std::cos(angle));
    mixed.shape[2][lane] = static_cast<float>(std::sin(2 * angle));
    mixed.shape[3][lane] = static_cast<float>(std::cos(2 * angle));
    for (int kind = 0; kind <= settings_.fibre_count; ++kind) {
      double rest = 0;
      for (int node = 0; node < waves_per_layer; ++node) rest += shares[node] * at_rest[kind * waves_per_layer + node];
      mixed.rest[kind][lane] = static_cast<float>(rest);
      if (kind > 0) mixed.fibre_scale[kind - 1][lane] = mixed.scales ? static_cast<float>(1 / (1 + rest)) : 1.0f;
    }
  }
  return mixed;
}

void BundleScan::list_groups(const std::vector<int>& layers) {
  layers_ = layers;
  groups_.clear();
  place_.clear();
  std::size_t lists = 0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const int count = construction_.layers()[layers[k]].count;
    const std::size_t first_wire = place_.size();
    place_.resize(first_wire + count);
    for (const LaneGroup& lane_group : lane_groups(count, kernels().wires_at_once)) {
      Group& group = groups_.emplace_back(Group{k, lane_group.mirrors, {}, {}, {}, lists});
      for (const int wire : lane_group.wires) {
        place_[first_wire + wire] = {groups_.size() - 1, group.angles.size()};
        const int turned = lane_group.mirrors ? wire - count : wire;  // exactly the opposite angle of its image
        group.angles.push_back(2 * pi * turned / count);
      }
      for (int f = 0; f < settings_.fibre_count; ++f) group.scans.emplace_back(group.angles, settings_.gate);
      lists += settings_.fibre_count * group.angles.size();
    }
  }
  lists_.resize(lists);
}

/// Prepares a bundle. The groups are kept if the previous bundle has the same layers.
void BundleScan::start(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
                       bool mixed) {
  if (bundle.wire_layers != layers_) list_groups(bundle.wire_layers);
  for (TurningList& list : lists_) list.clear();
  for (Group& group : groups_) {
    for (LaneScan& scan : group.scans) scan.restart();
    if (mixed)
      group.mixed = mixed_lanes(nesting.nodes + group.layer * waves_per_layer, nesting.fibres,
                                plan[bundle.wire_layers[group.layer]], group.angles);
  }
}

std::span<TurningList> BundleScan::lists_of(const Group& group, int fibre) {
  const std::size_t wires = group.scans[0].wires();
  return std::span(lists_).subspan(group.first_list + fibre * wires, wires);
}

LaneRun& BundleScan::add_run(Group& group, int fibre, std::size_t count, Wanted wanted) {
  LaneScan& scan = group.scans[fibre];
  return runs_.emplace_back(wanted == Wanted::turns ? scan.next(count, lists_of(group, fibre)) : scan.next_to_rank());
}

void BundleScan::scan_waves(std::size_t count, Wanted wanted) {
  const int fibres = settings_.fibre_count;
  runs_.clear();
  for (int f = 0; f < fibres; ++f)  // groups in the inner loop: image groups directly follow their wires
    for (Group& group : groups_) {
      LaneRun& run = add_run(group, f, count, wanted);
      run.mirrors = group.mirrors;
      run.waves = waves_.data() + (group.layer * fibres + f) * waves_per_layer * block_samples;
    }
  const auto scan = wanted == Wanted::turns ? kernels().scan : kernels().rank;
  scan(runs_.data(), runs_.size(), count);
  if (wanted != Wanted::turns) return;
  for (Group& group : groups_)
    for (int f = 0; f < fibres; ++f) group.scans[f].done(lists_of(group, f));
}

void BundleScan::scan_mixed(std::size_t count, Wanted wanted) {
  const std::size_t of_layer = ingredients(settings_.fibre_count) * waves_per_layer * block_samples;
  strains_.resize(2 * settings_.fibre_count * mixed_at_once * lanes);
  for (std::size_t g = 0; g < groups_.size();) {
    const std::size_t together = g + 1 < groups_.size() && groups_[g + 1].mirrors ? 2 : 1;
    const std::span<Group> here(groups_.data() + g, together);
    for (std::size_t first = 0; first < count; first += mixed_at_once)
      scan_mixed_groups(here, waves_.data() + here[0].layer * of_layer + first, std::min(mixed_at_once, count - first),
                        wanted);
    g += together;
  }
}

void BundleScan::scan_mixed_groups(std::span<Group> here, const float* waves, std::size_t count, Wanted wanted) {
  const int fibres = settings_.fibre_count;
  const auto scan = wanted == Wanted::turns ? kernels().scan_strains : kernels().rank_strains;
  const std::size_t of_group = fibres * mixed_at_once * lanes;
  kernels().mix(here[0].mixed, here.size() == 2 ? &here[1].mixed : nullptr, waves, block_samples, count, fibres,
                strains_.data(), strains_.data() + of_group);
  runs_.clear();
  for (std::size_t k = 0; k < here.size(); ++k)
    for (int f = 0; f < fibres; ++f)
      add_run(here[k], f, count, wanted).strain = strains_.data() + k * of_group + f * count * lanes;
  scan(runs_.data(), runs_.size(), count);
  for (Group& group : here)
    for (int f = 0; wanted == Wanted::turns && f < fibres; ++f) group.scans[f].done(lists_of(group, f));
}

void BundleScan::add_lines(bool mixed, std::size_t first, std::size_t count) {
  const int fibres = settings_.fibre_count, kinds = mixed ? ingredients(fibres) : fibres;
  for (std::size_t layer = 0; layer < lines_->size(); ++layer) {
    const LineWave& line = (*lines_)[layer];
    if (line.cos_row.empty()) continue;
    const auto c = static_cast<float>(std::cos(line.phase)), s = static_cast<float>(std::sin(line.phase));
    for (int kind = 0; kind < (mixed ? 1 : fibres); ++kind) {
      float* const sines = waves_.data() + ((layer * kinds + kind) * waves_per_layer + 1) * block_samples;
      float* const cosines = sines + block_samples;
      for (std::size_t t = 0; t < count; ++t) {
        const float one = line.cos_row[first + t], other = line.sin_row[first + t];
        sines[t] += c * other - s * one;
        cosines[t] += c * one + s * other;
      }
    }
  }
}

void BundleScan::run_blocks(const BundlePointers& nesting, bool mixed, Wanted wanted, const DeformationColumns& columns,
                            std::size_t samples) {
  const std::size_t layers = nesting.node_count / waves_per_layer;
  const int kinds = mixed ? ingredients(settings_.fibre_count) : settings_.fibre_count;
  waves_.resize(layers * kinds * waves_per_layer * block_samples);
  BundlePointers of = nesting;
  of.with_shear = settings_.with_shear;
  for (std::size_t first = 0; first < samples; first += block_samples) {
    const std::size_t count = std::min(block_samples, samples - first);
    const auto fill = mixed ? kernels().ingredient_waves : kernels().layer_waves;
    fill(of, columns, first, count, waves_.data(), block_samples);
    add_lines(mixed, first, count);
    if (mixed)
      scan_mixed(count, wanted);
    else
      scan_waves(count, wanted);
  }
}

/// Goes back from the end of the motion until the slip there no longer depends on earlier samples.
void BundleScan::settle(const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
                        const DeformationColumns& columns, std::size_t samples) {
  constexpr std::size_t of_layer = (deviation + 1) * waves_per_layer * block_samples;
  waves_.resize(nesting.node_count / waves_per_layer * of_layer);
  std::vector<MixedRun> open;
  for (Group& group : groups_)
    if (plan[layers_[group.layer]].friction) open.push_back({&group.mixed, waves_.data() + group.layer * of_layer});
  const std::vector<MixedRun> all = open;
  for (std::size_t end = samples; end > 0 && !open.empty();) {
    const std::size_t first = (end - 1) / block_samples * block_samples, count = end - first;
    kernels().deviation_waves(nesting, columns, first, count, waves_.data(), block_samples);
    kernels().settle(open.data(), open.size(), block_samples, count);
    std::erase_if(open,
                  [](const MixedRun& run) { return std::ranges::equal(run.state->least_slip, run.state->most_slip); });
    end = first;
  }
  for (const MixedRun& run : all)  // the motion starts without slip
    for (int lane = 0; lane < lanes; ++lane)
      run.state->slip[lane] = std::clamp(0.0f, run.state->least_slip[lane], run.state->most_slip[lane]);
}

void BundleScan::run_all(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
                         bool mixed, const DeformationColumns& columns, std::size_t samples, Wanted wanted) {
  start(bundle, plan, nesting, mixed);
  const bool settles = std::ranges::any_of(bundle.wire_layers, [&](int layer) { return plan[layer].friction; });
  if (settles) settle(plan, nesting, columns, samples);
  run_blocks(nesting, mixed, wanted, columns, samples);
}

void BundleScan::run(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
                     bool mixed, const DeformationColumns& columns, std::size_t samples,
                     const std::vector<LineWave>& lines) {
  lines_ = &lines;
  run_all(bundle, plan, nesting, mixed, columns, samples, Wanted::turns);
  for (Group& group : groups_)
    for (int f = 0; f < settings_.fibre_count; ++f) group.scans[f].finish(lists_of(group, f));
}

void BundleScan::rank(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
                      bool mixed, const DeformationColumns& columns, std::size_t samples,
                      const std::vector<LineWave>& lines) {
  lines_ = &lines;
  run_all(bundle, plan, nesting, mixed, columns, samples, Wanted::ranks);
}

void BundleScan::for_each_site(
    const std::function<void(std::size_t, int, std::span<const TurningPoint>)>& found) const {
  for (std::size_t wire = 0; wire < place_.size(); ++wire) {
    const auto [number, lane] = place_[wire];
    const Group& group = groups_[number];
    for (int f = 0; f < settings_.fibre_count; ++f)
      found(wire, f, lists_[group.first_list + f * group.angles.size() + lane].points());
  }
}

void BundleScan::for_each_rank(const std::function<void(std::size_t, int, const StrainMeasures&)>& found) const {
  for (std::size_t wire = 0; wire < place_.size(); ++wire)
    for (int f = 0; f < settings_.fibre_count; ++f)
      found(wire, f, groups_[place_[wire].group].scans[f].measures(place_[wire].lane));
}

}  // namespace dresslife::strain
