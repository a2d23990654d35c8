#include "strain/cable_paths.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "pipeline/base/constants.h"
#include "pipeline/cable/shares.h"
#include "pipeline/job/strain.h"

namespace dresslife::strain {
namespace {

constexpr std::size_t most_offset_samples = 64;  // at which places of cables are stored for pictures
// Least number of elements of a loose cable in a segment. The segment's curvature is their mean; one element alone would have
// only the curvatures of its ends.
constexpr std::size_t least_elements = 2;
// Exceeds the forces of any cable: a limit of this size means glued. It is finite so that limits can be added.
constexpr double no_force_reaches = 1e7;  // [N]

constexpr double settled = 1e-6;  // [strain] change from repeat to repeat: 1 N in a cable of 1 MN
constexpr double closed = 1e-12;  // [strain] change by rounding only: one more repeat would give the same strains
// Between a grip and friction, each repeat leaves a share of the remaining error. With friction alone a few repeats are enough.
constexpr int most_repeats = 30;
// The limit depends on the tension by the friction of a node's bend, mu kappa l, 0.05 at 1 1/m and 64 segments. Each attempt
// leaves this share of the error.
constexpr int most_attempts = 20;

// Time in which cables with another slack get this slack [s]. All of it at once would lie in short waves.
constexpr double feeding = 15;
// Only cables are evaluated whose sum of eighth powers is at least this share of the largest sum: 0.42 of the largest change of
// curvature. Tension and constant bends, which the sum does not contain, can make their wires the worst.
constexpr double bent_share = 1e-3;

/// Returns the place of a part in the cross-section at an arc along the dresspack.
std::array<double, 2> place_of(const Construction& construction, int part, double arc) {
  const Part& in = construction.parts()[part];
  const double radius = construction.layers()[in.layer].helix_radius;
  const double phase = construction.phase(in.layer, in.number, in.parent, arc);
  return {radius * std::cos(phase), radius * std::sin(phase)};
}

/// Returns the hose between end and centre of the outermost segment. share: 1 at the end, 0 at the centre.
HoseNode between_end(const Deformation& end, const DeformationColumns& centre, std::size_t t, double share) {
  const auto between = [&](double from, double to) { return from + share * (to - from); };
  return {between(centre.curvature1[t], end.curvature1),
          between(centre.curvature2[t], end.curvature2),
          between(centre.twist[t], end.twist),
          between(centre.elongation[t], end.elongation),
          {}};
}

}  // namespace

CablePaths::CablePaths(const Construction& construction, const std::vector<LayerSlip>& plan, const CablesInJob& job,
                       std::vector<double> lengths, const std::vector<double>& arcs, std::size_t samples,
                       const Scratch& scratch)
    : construction_(construction),
      lengths_(std::move(lengths)),
      stride_(padded(samples) + padding),
      all_(samples),
      known_ends_(job.known_ends),
      relief_stiffness_(job.relief_stiffness),
      stiffness_factor_(job.stiffness_factor) {
  const std::size_t segments = lengths_.size();
  std::vector<LooseCable> loose;
  std::vector<PathMember> held;
  for (const int part : construction.cables()) {
    const Part& in = construction.parts()[part];
    const Layer& layer = construction.layers()[in.layer];
    if (plan[in.layer].sliding == Sliding::glued && !plan[in.layer].loose) continue;
    const auto grip =
        [&](const std::optional<double>& force) {  // elastic force at the strain that the grip force causes
          return force ? layer.axial_stiffness * layer.force.strain_at(*force) : without_limit;
        };
    Cable cable{part,
                plan[in.layer].loose,
                false,
                job.rub && (layer.friction > 0 || layer.jacket_stiffness > 0),
                job.stick,
                layer.axial_stiffness,
                layer.laying.slack / 100,
                layer.friction,
                layer.line_load,
                grip(layer.laying.base_grip),
                job.free_tool_end ? grip(layer.laying.tool_grip.value_or(0)) : grip(layer.laying.tool_grip),
                radial_share(layer.axial_stiffness, layer.lay_angle, layer.helix_radius, layer.radial_stiffness),
                elastic_share(layer.jacket_stiffness, layer.axial_stiffness,
                              std::accumulate(lengths_.begin(), lengths_.end(), 0.0))};
    cable.pulled = {layer.force,
                    {},
                    {place_of(construction, part, arcs.front() - lengths_.front() / 2),
                     place_of(construction, part, arcs.back() + lengths_.back() / 2)}};
    cable.remembers = cable.rubs || std::min(cable.base_grip, cable.tool_grip) < without_limit;
    cable.strain.assign(stride_, 0.0);
    if (cable.sticks)
      for (std::vector<double>& of : cable.pulled.strain) of.assign(samples, 0.0);
    if (cable.rubs) {
      cable.along.assign(segments * samples, 0.0);
      cable.pressing.assign(segments * samples, 0.0f);
    }
    if (cable.loose) {
      LooseCable& lies = loose.emplace_back();
      lies.place = cable.pulled.place[0];
      if (layer.helix_radius > 0) lies.lay_rate = layer.lay_tangent / layer.helix_radius;
      lies.radius = layer.part_radius;
      lies.axial_stiffness = layer.axial_stiffness;
      lies.bending_stiffness = layer.force.bending_stiffness();
      lies.mass_per_length = layer.laying.mass.value_or(layer.force.mass_per_length());
      lies.slack = cable.slack;
      lies.grip = std::min(cable.base_grip, cable.tool_grip);
      lies.play = layer.laying.play.value_or(without_limit);
      if (job.rub && layer.friction > 0) {
        lies.drag *= layer.friction / LooseCable::friction_of_drag;
        lies.friction = layer.friction;
        lies.line_load = layer.line_load;
      }
      loosened_.push_back(cables_.size());
    } else {
      held.push_back({in.layer, in.number});
      held_.push_back(cables_.size());
    }
    cables_.push_back(std::move(cable));
  }
  if (!held.empty()) rates_.emplace(construction, plan, dresspack_itself, held, lengths_, arcs);
  if (!loose.empty()) {
    fit_in_hose(loose, construction.section());
    const double length = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
    const std::size_t of_waves = (elements_of_waves(loose, length) + node_segments() - 1) / node_segments();
    const std::size_t per_segment =
        job.elements_per_segment > 0 ? job.elements_per_segment
                                     : std::clamp<std::size_t>(of_waves, least_elements, pipeline::most_cable_elements);
    loose_ = std::make_shared<LooseCables>(
        loose, LooseSettings{length, node_segments() * per_segment, construction.rest_curvature(),
                             std::ranges::any_of(cables_, &Cable::rubs)});
    nodes_.resize(loose_->nodes());
    for (std::size_t k = 0; k < loosened_.size(); ++k) cables_[loosened_[k]].room = winding_radius(loose_->cable(k));
    curvature_ = std::make_shared<SegmentRows>(segments + 2, 2 * loosened_.size(), samples, scratch);
  }
  if (!any()) return;
  hose_curvature_.assign(4 * samples, 0.0f);
  hose_twist_.assign(samples, 0.0);
}

const std::string& CablePaths::name(std::size_t cable) const { return construction_.parts()[cables_[cable].part].path; }

int CablePaths::component(std::size_t cable) const {
  return construction_.layers()[construction_.parts()[cables_[cable].part].layer].component;
}

ChangedPlace CablePaths::most_changed() const {
  const ChangedPlace most = loose_->most_changed();
  return {loosened_[most.cable], most.arc};
}

void CablePaths::record_rubbing() {
  assert(next_ == 0);
  for (Cable& cable : cables_)
    if (cable.rubs) cable.rubbing.emplace(lengths_.size(), all_);
}

void CablePaths::share_loose(const CablePaths& other) {
  assert(next_ == 0 && other.next_ == 0);
  if (!loose_ || !other.loose_ || !loose_->same_cables(*other.loose_)) return;
  loose_ = other.loose_;
  curvature_ = other.curvature_;
}

void CablePaths::go_on_from(const CablePaths& other) {
  if (!loose_ || loose_ == other.loose_) return;
  loose_->go_on_from(*other.loose_);
  first_share_ = 1;
  for (std::size_t k = 0; k < loose_->cables(); ++k)
    if (loose_->cable(k).slack > 0) first_share_ = other.loose_->cable(k).slack / loose_->cable(k).slack;
  fed_ = 0;
}

/// Feeds in the slack of one step of a lead-in. step: [s].
void CablePaths::feed_slack(double step) {
  if (first_share_ == 1) return;
  fed_ += step;
  const double fed = std::min(1.0, fed_ / feeding);
  loose_->feed_in(first_share_ + fed * (1 - first_share_));
  if (fed == 1) first_share_ = 1;
}

void CablePaths::add(const SpanBlock& block) {
  CablePaths* const alone = this;
  add({&alone, 1}, block);
}

void CablePaths::add(std::span<CablePaths* const> all, const SpanBlock& block) {
  std::vector<CablePaths*> loose;
  for (CablePaths* const of : all) {
    if (!of->any()) continue;
    of->add_hose(block);
    if (of->rates_) of->add_held(block);
    if (of->loose_) loose.push_back(of);
  }
  if (!loose.empty()) add_loose(loose, block);
  for (CablePaths* const of : all)
    if (of->any()) of->next_ += block.deformation.samples();
}

void CablePaths::add_hose(const SpanBlock& block) {
  assert(next_ + block.deformation.samples() <= all_);
  const std::size_t last = lengths_.size() - 1;
  for (int clamp = 0; clamp < 2; ++clamp) {
    const DeformationColumns at = block.deformation.columns(clamp == 0 ? 0 : last);
    for (std::size_t t = 0; t < block.deformation.samples(); ++t) {
      const bool known = known_ends_[clamp];
      const Deformation* const end = known ? &block.ends[2 * t + clamp] : nullptr;
      hose_curvature_[(2 * clamp) * all_ + next_ + t] = static_cast<float>(known ? end->curvature1 : at.curvature1[t]);
      hose_curvature_[(2 * clamp + 1) * all_ + next_ + t] =
          static_cast<float>(known ? end->curvature2 : at.curvature2[t]);
    }
  }
  for (std::size_t t = 0; t < block.deformation.samples(); ++t) hose_twist_[next_ + t] = mean_twist(block, t);
}

/// Returns the mean twist along the hose at sample t of the block [rad/m].
double CablePaths::mean_twist(const SpanBlock& block, std::size_t t) const {
  double turned = 0, length = 0;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    turned += lengths_[i] * block.deformation.columns(i).twist[t];
    length += lengths_[i];
  }
  return turned / length;
}

void CablePaths::add_held(const SpanBlock& block) {
  const std::size_t count = block.deformation.samples(), stride = padded(count), n = held_.size();
  std::vector<double> path(n * stride, 0.0), in_segment(n * stride);
  std::vector<double> rest(n, 0.0);
  const auto attach = [](BundleNesting&) {};
  for (std::size_t segment = 0; segment < lengths_.size(); ++segment) {
    const DeformationColumns columns = block.deformation.columns(segment);
    const bool apart = std::ranges::any_of(held_, [&](std::size_t c) { return cables_[c].rubs || cables_[c].sticks; });
    if (!apart) {
      rates_->add(segment, columns, count, attach, path.data(), stride);
    } else {
      std::ranges::fill(in_segment, 0.0);
      rates_->add(segment, columns, count, attach, in_segment.data(), stride);
      for (std::size_t k = 0; k < path.size(); ++k) path[k] += in_segment[k];
    }
    for (std::size_t k = 0; k < n; ++k) {
      rest[k] += rates_->rest(segment, k);
      Cable& cable = cables_[held_[k]];
      if (cable.sticks)
        add_stuck(cable, segment, columns.twist, std::span(in_segment).subspan(k * stride, count),
                  rates_->rest(segment, k));
      if (!cable.rubs) continue;
      const Layer& layer = construction_.layers()[construction_.parts()[cable.part].layer];
      const double sine = std::sin(layer.lay_angle);
      const double coiled = layer.helix_radius > 0 ? sine * sine / layer.helix_radius : 0;
      for (std::size_t t = 0; t < count; ++t) {
        const std::size_t at = along_at(segment, next_ + t);
        const double ratio = in_segment[k * stride + t] / rates_->rest(segment, k);
        cable.along[at] = cable.radial_share * (ratio / (1 + cable.slack) - 1);
        cable.pressing[at] = static_cast<float>(std::hypot(columns.curvature1[t], columns.curvature2[t]) + coiled);
        if (cable.rubbing) cable.rubbing->touch(segment, next_ + t, columns.curvature2[t], -columns.curvature1[t]);
      }
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    Cable& cable = cables_[held_[k]];
    for (std::size_t t = 0; t < count; ++t)
      cable.strain[next_ + t] = cable.radial_share * (path[k * stride + t] / rest[k] / (1 + cable.slack) - 1);
  }
}

double CablePaths::pulled_by_twist(const Cable& cable, double twist) const {
  const Layer& layer = construction_.layers()[construction_.parts()[cable.part].layer];
  return layer.shortening.at(twist * layer.lay_cosine * layer.lay_cosine);
}

/// path: length in the segment (sample of the block) [m]. rest: length at rest [m]. twist: of the hose (sample) [rad/m].
void CablePaths::add_stuck(Cable& cable, std::size_t segment, const double* twist, std::span<const double> path,
                           double rest) {
  auto& [largest, at_base, at_tool] = cable.pulled.strain;
  for (std::size_t t = 0; t < path.size(); ++t) {
    const double strain = cable.radial_share * (path[t] / rest - 1) + pulled_by_twist(cable, twist[t]);
    if (std::abs(strain) > std::abs(largest[next_ + t])) largest[next_ + t] = strain;
    if (segment == 0) at_base[next_ + t] = strain;
    if (segment + 1 == lengths_.size()) at_tool[next_ + t] = strain;
  }
}

void CablePaths::lead_in(std::span<CablePaths* const> all, const SpanBlock& block) {
  std::vector<CablePaths*> own;
  std::vector<LooseCables*> cables;
  for (CablePaths* const of : all)
    if (of->loose_ && std::ranges::find(cables, of->loose_.get()) == cables.end()) {  // one of those that share
      own.push_back(of);
      cables.push_back(&*of->loose_);
    }
  const std::size_t samples = own.empty() ? 0 : block.deformation.samples();
  for (std::size_t t = 0; t < samples; ++t) {
    own.front()->find_nodes(block, t);
    const double twist = own.front()->mean_twist(block, t);
    for (CablePaths* const of : own) {
      of->shorten_loose(twist);
      of->feed_slack(block.step);
    }
    LooseCables::advance(cables, own.front()->nodes_, block.step, t + 1 == samples);
  }
}

void CablePaths::end_repeat(std::span<CablePaths* const> all, double further) {
  std::vector<LooseCables*> cables;
  for (CablePaths* const of : all) {
    if (!of->loose_ || std::ranges::find(cables, of->loose_.get()) != cables.end()) continue;
    cables.push_back(of->loose_.get());
    if (of->first_share_ == 1)
      of->loose_->end_repeat(further);
    else
      of->loose_->begin_repeat();
  }
}

void CablePaths::add_loose(std::span<CablePaths* const> all, const SpanBlock& block) {
  std::vector<CablePaths*> moved;  // the first of each set that shares loose cables
  std::vector<LooseCables*> cables;
  for (CablePaths* const of : all) {
    if (std::ranges::find(cables, of->loose_.get()) != cables.end()) continue;
    of->curvature_->begin(block.deformation.samples());
    moved.push_back(of);
    cables.push_back(of->loose_.get());
  }
  CablePaths& first = *all.front();
  for (std::size_t t = 0; t < block.deformation.samples(); ++t) {
    first.find_nodes(block, t);
    for (CablePaths* const of : moved) of->shorten_loose(first.hose_twist_[first.next_ + t]);
    for (CablePaths* const of : all) of->see_gains(first.nodes_, t);
    LooseCables::advance(cables, first.nodes_, block.step);
    for (CablePaths* const of : moved) of->put_curvature(t);
    for (CablePaths* const of : all) of->put_loose(t);
  }
  for (CablePaths* const of : moved) of->curvature_->end();
}

/// Writes the hose's state at all nodes, at sample t of the block.
void CablePaths::find_nodes(const SpanBlock& block, std::size_t t) {
  const std::size_t segments = lengths_.size(), elements = nodes_.size() - 1;
  const DeformationHistory& deformation = block.deformation;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    // linear between two segment centres or a centre and a known end; extrapolated beyond the outermost centres
    const double along = static_cast<double>(i) / static_cast<double>(elements) * segments - 0.5;
    const auto low =
        segments < 2 ? 0 : std::min(static_cast<std::size_t>(std::max(0.0, std::floor(along))), segments - 2);
    const std::size_t high = std::min(low + 1, segments - 1);
    const double share = along - static_cast<double>(low);
    const DeformationColumns a = deformation.columns(low), b = deformation.columns(high);
    const auto between = [&](const double* x, const double* y) { return x[t] + share * (y[t] - x[t]); };
    HoseNode& node = nodes_[i];
    node = {between(a.curvature1, b.curvature1),
            between(a.curvature2, b.curvature2),
            between(a.twist, b.twist),
            between(a.elongation, b.elongation),
            {}};
    if (along < 0 && known_ends_[0])
      node = between_end(block.ends[2 * t], a, t, -2 * along);
    else if (along > static_cast<double>(segments - 1) && known_ends_[1])
      node = between_end(block.ends[2 * t + 1], b, t, 2 * (along - static_cast<double>(segments - 1)));
    if (block.pull.empty()) continue;
    const double* pull_a = block.pull.data() + (t * segments + low) * 2;
    const double* pull_b = block.pull.data() + (t * segments + high) * 2;
    for (int d = 0; d < 2; ++d) node.pull[d] = pull_a[d] + share * (pull_b[d] - pull_a[d]);
  }
}

void CablePaths::see_gain(Cable& cable, std::size_t sample, double gain, double relief) {
  gain += pulled_by_twist(cable, hose_twist_[sample]);
  cable.path_gain[0] = std::min(cable.path_gain[0], gain + relief);
  cable.path_gain[1] = std::max(cable.path_gain[1], gain - relief);
}

/// Updates path_gain of loose cables at sample t of the block, by (W32) with b = 0. nodes: of the hose at this sample.
void CablePaths::see_gains(const std::vector<HoseNode>& nodes, std::size_t t) {
  const double count = static_cast<double>(nodes.size());
  HoseNode mean;
  double bent = 0, twisted = 0;  // means of |k| and of the twist's square
  for (const HoseNode& node : nodes) {
    mean.curvature1 += node.curvature1 / count;
    mean.curvature2 += node.curvature2 / count;
    mean.twist += node.twist / count;
    mean.elongation += node.elongation / count;
    bent += std::hypot(node.curvature1, node.curvature2) / count;
    twisted += node.twist * node.twist / count;
  }
  for (std::size_t k = 0; k < loosened_.size(); ++k) {
    const LooseCable& lies = loose_->cable(k);
    const auto [a1, a2] = lies.place;
    const double square = a1 * a1 + a2 * a2, lay = lies.lay_rate;
    double across = mean.curvature1 * a2 - mean.curvature2 * a1;
    if (lay != 0) {  // the place rotates along the hose
      across = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double turn = lay * loose_->length() * static_cast<double>(i) / (count - 1);
        const double c = std::cos(turn), s = std::sin(turn);
        across += (nodes[i].curvature1 * (s * a1 + c * a2) - nodes[i].curvature2 * (c * a1 - s * a2)) / count;
      }
    }
    const double gain = mean.elongation + across + square * (lay * lay + 2 * lay * mean.twist + twisted) / 2;
    // A cable alone around the axis can go to any side of it; its own place then has no influence.
    const bool around = lies.ring == no_ring && lies.play == without_limit;
    const double relief = around ? lies.farthest : std::min(lies.play, lies.ring == no_ring ? without_limit : lies.gap);
    see_gain(cables_[loosened_[k]], next_ + t, (1 + gain - (around ? across : 0)) / (1 + loose_->laid_in(k)) - 1,
             relief * bent);
  }
}

/// Updates path_gain of held cables. Call before they slide along their paths.
void CablePaths::see_held_gains() {
  const double length = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
  for (const std::size_t k : held_) {
    Cable& cable = cables_[k];
    for (std::size_t t = 0; t < next_; ++t) {
      double strain = cable.strain[t];
      if (cable.rubs) {
        strain = 0;
        for (std::size_t i = 0; i < lengths_.size(); ++i) strain += cable.along[along_at(i, t)] * lengths_[i] / length;
      }
      see_gain(cable, t, (1 + strain / cable.radial_share) * (1 + cable.slack) - 1, 0);
    }
  }
}

/// twist: of the hose [rad/m].
void CablePaths::shorten_loose(double twist) {
  for (std::size_t k = 0; k < loosened_.size(); ++k) loose_->shorten(k, pulled_by_twist(cables_[loosened_[k]], twist));
}

void CablePaths::put_loose(std::size_t t) {
  for (std::size_t k = 0; k < loosened_.size(); ++k) put_loose(loosened_[k], k, next_ + t);
  if ((next_ + t) % std::max<std::size_t>(1, all_ / most_offset_samples) == 0) put_offsets(next_ + t);
}

void CablePaths::put_offsets(std::size_t sample) {
  const std::size_t segments = lengths_.size(), elements = nodes_.size() - 1;
  offset_samples_.push_back(sample);
  offsets_.resize(offset_samples_.size() * cables_.size() * segments * 2, 0.0);
  double* const of_sample = offsets_.data() + (offset_samples_.size() - 1) * cables_.size() * segments * 2;
  for (std::size_t k = 0; k < loosened_.size(); ++k)
    for (std::size_t i = 0; i < segments; ++i)
      for (std::size_t d = 0; d < 2; ++d) {
        const std::vector<double>& offset = loose_->state(k).offset;
        of_sample[(loosened_[k] * segments + i) * 2 + d] =
            (offset[2 * (i * elements / segments) + d] + offset[2 * ((i + 1) * elements / segments) + d]) / 2;
      }
}

void CablePaths::put_curvature(std::size_t t) {
  const std::size_t segments = lengths_.size(), elements = nodes_.size() - 1;
  for (std::size_t k = 0; k < loosened_.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d) {
      const std::vector<double>& curvature = loose_->state(k).curvature;
      for (const std::size_t clamp : {0, 1})
        curvature_->at(segments + clamp, 2 * k + d, t) = static_cast<float>(loose_->state(k).clamped[2 * clamp + d]);
      for (std::size_t i = 0; i < segments; ++i) {
        const std::size_t first = i * elements / segments, end = std::max(first + 1, (i + 1) * elements / segments);
        double sum = 0;  // trapezoidal rule over the elements
        for (std::size_t e = first; e < end; ++e) sum += (curvature[2 * e + d] + curvature[2 * (e + 1) + d]) / 2;
        curvature_->at(i, 2 * k + d, t) = static_cast<float>(sum / (end - first));
      }
    }
}

void CablePaths::put_loose(std::size_t index, std::size_t state_index, std::size_t sample) {
  Cable& cable = cables_[index];
  const CableState& state = loose_->state(state_index);
  const std::size_t segments = lengths_.size(), elements = nodes_.size() - 1;
  const double free_length = (1 + cable.slack) * (1 + loose_->laid_in(state_index));
  double mean = 0;
  for (const double gain : state.gain) mean += gain / static_cast<double>(elements);
  cable.strain[sample] = (1 + mean) / free_length - 1;
  for (std::size_t i = 0; cable.rubs && i < segments; ++i) {
    const std::size_t first = i * elements / segments, end = std::max(first + 1, (i + 1) * elements / segments);
    double gain = 0, press = 0;
    for (std::size_t e = first; e < end; ++e) {
      gain += state.gain[e] / (end - first);
      press += (state.press[e] + state.press[e + 1]) / 2 / (end - first);
    }
    cable.along[along_at(i, sample)] = (1 + gain) / free_length - 1;
    cable.pressing[along_at(i, sample)] = static_cast<float>(press);
  }
  if (cable.rubbing)
    cable.rubbing->move_across(sample, loose_->cable(state_index), state, cable.line_load,
                               loose_->length() / static_cast<double>(elements));
}

namespace {

/// Sum of (range between turning points)^8. The first and the last value are turning points.
class BendingSum {
 public:
  explicit BendingSum(double first) : last_(first), turned_at_(first) {}
  void add(double curvature) {
    if ((curvature - last_) * direction_ < 0) {
      sum_ += range();
      turned_at_ = last_;
    }
    if (curvature != last_) direction_ = curvature - last_;
    last_ = curvature;
  }
  double sum() const { return sum_ + range(); }

 private:
  double range() const { return std::pow(last_ - turned_at_, 8); }

  double last_, turned_at_, direction_ = 0, sum_ = 0;
};

}  // namespace

/// Returns the row of curvature_ at which the wires of a segment are evaluated.
std::size_t CablePaths::wires_at(std::size_t segment) const {
  const std::size_t last = lengths_.size() - 1;
  return known_ends_[0] && segment == 0 ? last + 1 : known_ends_[1] && segment == last ? last + 2 : segment;
}

void CablePaths::find_bent() {
  bending_sums_.clear();
  std::vector<double> one(next_), other(next_);
  for (std::size_t segment = 0; segment < lengths_.size(); ++segment)
    for (std::size_t k = 0; k < loosened_.size(); ++k) {
      curvature_->read(wires_at(segment), 2 * k, 0, next_, one.data());
      curvature_->read(wires_at(segment), 2 * k + 1, 0, next_, other.data());
      double most = 0;
      for (int direction = 0; direction < 4; ++direction) {
        const double c = std::cos(direction * pi / 4), s = std::sin(direction * pi / 4);
        BendingSum sum(c * one[0] + s * other[0]);
        for (std::size_t t = 1; t < next_; ++t) sum.add(c * one[t] + s * other[t]);
        most = std::max(most, sum.sum());
      }
      bending_sums_.push_back(most);
    }
}

bool CablePaths::read_curvature(int part, std::size_t row, int about, std::size_t first, std::size_t count,
                                double* to) const {
  for (std::size_t k = 0; k < loosened_.size(); ++k) {
    if (cables_[loosened_[k]].part != part) continue;
    const std::size_t last = lengths_.size();
    curvature_->read(row == 0 ? last : row > last ? last + 1 : row - 1, 2 * k + about, first, count, to);
    return true;
  }
  return false;
}

void CablePaths::read_strain(int part, std::size_t segment, std::size_t first, std::size_t count, double* to) const {
  std::fill_n(to, count, 0.0);
  for (const Cable& cable : cables_)
    if (cable.part == part)
      for (std::size_t t = 0; t < count; ++t)
        to[t] = cable.rubs ? cable.along[along_at(segment, first + t)] : cable.strain[first + t];
}

double CablePaths::largest_curvature(std::size_t cable) const {
  const auto k = static_cast<std::size_t>(std::ranges::find(loosened_, cable) - loosened_.begin());
  std::vector<double> one(next_), other(next_);
  double most = 0;
  for (std::size_t segment = 0; segment < lengths_.size() && k < loosened_.size(); ++segment) {
    curvature_->read(wires_at(segment), 2 * k, 0, next_, one.data());
    curvature_->read(wires_at(segment), 2 * k + 1, 0, next_, other.data());
    for (std::size_t t = 0; t < next_; ++t) most = std::max(most, std::hypot(one[t], other[t]));
  }
  return most;
}

std::vector<int> CablePaths::bent_most(std::size_t segment) const {
  std::vector<int> parts;
  const std::size_t loose = loosened_.size();
  for (std::size_t k = 0; k < loose; ++k) {
    double most = 0;
    for (std::size_t of = 0; of < bending_sums_.size(); ++of)
      if (component(loosened_[of % loose]) == component(loosened_[k])) most = std::max(most, bending_sums_[of]);
    if (bending_sums_[segment * loose + k] >= bent_share * most) parts.push_back(cables_[loosened_[k]].part);
  }
  return parts;
}

bool CablePaths::remembers() const { return std::ranges::any_of(cables_, &Cable::remembers); }

void CablePaths::repeat() {
  assert(!finished_);
  next_ = 0;
  for (Cable& cable : cables_)
    if (cable.rubbing) cable.rubbing.emplace(lengths_.size(), all_);
  offset_samples_.clear();
  offsets_.clear();
  if (!loose_) return;
  loose_->begin_repeat();
  curvature_->clear();
}

void CablePaths::finish() {
  if (finished_) return;
  finished_ = true;
  see_held_gains();
  for (Cable& cable : cables_)
    if (cable.remembers) slide(cable);
  if (any() && next_ > 0) ask_for_forces();
}

/// Repeats the motion until it ends in the state in which the previous repeat ended. This state is the start of the repeat that
/// counts. Usually the last quarter of the motion (repeat -1) leads to it, and repeat 0 closes. Otherwise repeat 1 starts
/// at the first sample without any memory.
void CablePaths::slide(Cable& cable) {
  const std::size_t segments = cable.rubs ? lengths_.size() : 1;
  std::vector<double> lengths = lengths_;
  if (!cable.rubs) lengths = {std::accumulate(lengths_.begin(), lengths_.end(), 0.0)};
  const SlidingLine at_first(lengths, cable.axial_stiffness, cable.base_grip, cable.tool_grip);
  SlidingLine line = at_first;
  std::vector<double> unslid(segments), limits(segments), held(segments, 0.0);
  const double length = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
  std::vector<double>& strain = cable.rubs ? cable.along : cable.strain;
  std::vector<double> slid(strain.size()), ended(segments, without_limit);
  double moved = without_limit;
  bool last = false;
  for (int repeat = -1; !last && !(moved < closed); ++repeat) {
    if (repeat == 1) {
      line = at_first;
      std::ranges::fill(limits, 0.0);
      std::ranges::fill(ended, without_limit);
    }
    last = repeat > 1 && (moved < settled || repeat == most_repeats);
    const std::array<double, 2> before{line.travel_at_base(), line.travel_at_tool()};
    if (cable.rubbing) cable.rubbing->begin_repeat();
    for (std::size_t t = repeat < 0 ? next_ - next_ / 4 : 0; t < next_; ++t) {
      const double by_twist = pulled_by_twist(cable, hose_twist_[t]);
      if (!cable.rubs) {
        unslid[0] = cable.strain[t] + by_twist;
        line.next(unslid, limits);
      } else {
        double mean = 0;
        for (std::size_t i = 0; i < segments; ++i) mean += cable.along[along_at(i, t)] * lengths_[i] / length;
        for (std::size_t i = 0; i < segments; ++i) {
          held[i] = cable.elastic * (cable.along[along_at(i, t)] - mean);
          unslid[i] = cable.along[along_at(i, t)] + by_twist - held[i];
        }
        for (int attempt = 0; attempt < most_attempts; ++attempt) {  // limits depend on the tension
          double changed = 0;
          for (std::size_t i = 1; i < segments; ++i) {
            const double pressing = (cable.pressing[along_at(i - 1, t)] + cable.pressing[along_at(i, t)]) / 2;
            const double tension = std::max(0.0, (line.force()[i - 1] + line.force()[i]) / 2);
            const double load = cable.line_load + (cable.loose ? pressing : tension * pressing);
            const double limit =
                std::min(no_force_reaches, cable.friction * load * (lengths_[i - 1] + lengths_[i]) / 2);
            changed = std::max(changed, std::abs(limit - limits[i]));
            limits[i] = limit;
          }
          if (attempt > 0 && changed < settled * cable.axial_stiffness) break;
          line.attempt(unslid, limits);
          if (cable.loose) break;  // the limits of a loose cable do not depend on its tension
        }
        line.keep();
        if (cable.rubbing) record_slide(cable, line, unslid, t);
      }
      if (!cable.rubs) slid[t] = line.strain(0) - by_twist;
      for (std::size_t i = 0; cable.rubs && i < segments; ++i)
        slid[along_at(i, t)] = line.strain(i) - by_twist + held[i];
    }
    cable.grip_slip = {line.travel_at_base() - before[0], line.travel_at_tool() - before[1]};
    moved = 0;
    for (std::size_t i = 0; i < segments; ++i) {
      moved = std::max(moved, std::abs(line.strain(i) - ended[i]));
      ended[i] = line.strain(i);
    }
  }
  strain = std::move(slid);
}

/// Records the sliding along the hose of one sample (W41). unslid: strains without sliding.
void CablePaths::record_slide(Cable& cable, const SlidingLine& line, std::span<const double> unslid,
                              std::size_t sample) const {
  double begin = line.let_in_at_base();
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const double end = begin + lengths_[i] * (line.strain(i) - unslid[i]);
    const double pressing = cable.pressing[along_at(i, sample)];
    const double load = cable.line_load + (cable.loose ? pressing : std::max(0.0, line.force()[i]) * pressing);
    cable.rubbing->slide_along(i, sample, (begin + end) / 2, load * lengths_[i]);
    begin = end;
  }
}

/// Stores the strains that cause forces. A cable's force grows with its strain, so the largest strain gives the largest force.
/// Twist also strains its wires. A cable that shortens by this amount is free of force (a weight at its end instead of a
/// second clamp).
void CablePaths::ask_for_forces() {
  const std::size_t last = lengths_.size() - 1;
  for (Cable& cable : cables_) {
    auto& [largest, at_base, at_tool] = cable.pulled.strain;
    for (std::vector<double>& of : cable.pulled.strain) of.resize(next_);
    for (std::size_t t = 0; t < next_ && !cable.sticks; ++t) {
      const double by_twist = pulled_by_twist(cable, hose_twist_[t]);
      largest[t] = at_base[t] = at_tool[t] = cable.rubs ? 0 : cable.strain[t] + by_twist;
      if (!cable.rubs) continue;
      for (std::size_t i = 0; i <= last; ++i)
        if (const double strain = cable.along[along_at(i, t)] + by_twist; std::abs(strain) > std::abs(largest[t]))
          largest[t] = strain;
      at_base[t] = cable.along[along_at(0, t)] + by_twist;
      at_tool[t] = cable.along[along_at(last, t)] + by_twist;
    }
  }
  hose_moment_.assign(next_, 0.0);
  for (int clamp = 0; clamp < 2; ++clamp)
    for (std::size_t t = 0; t < next_; ++t) {
      const float* const bent = hose_curvature_.data() + 2 * clamp * all_ + t;
      hose_moment_[t] = std::max(
          hose_moment_[t], (stiffness_factor_ * construction_.hose_bending_stiffness() + relief_stiffness_[clamp]) *
                               std::hypot(bent[0], bent[all_]));
    }
}

double CablePaths::place_of_force(std::size_t cable, std::size_t sample) const {
  const Cable& of = cables_[cable];
  if (!of.rubs) return -1;
  const double by_twist = pulled_by_twist(of, hose_twist_[sample]);
  double largest = -1, place = 0, begin = 0;
  for (std::size_t i = 0; i < lengths_.size(); begin += lengths_[i++])
    if (const double strain = std::abs(of.along[along_at(i, sample)] + by_twist); strain > largest)
      largest = strain, place = begin + lengths_[i] / 2;
  return place;
}

const SegmentMotion& CablePaths::Keeper::of(const CablePaths& paths, std::size_t segment,
                                            const DeformationColumns& hose, std::size_t first, std::size_t count,
                                            bool at_wires) {
  const std::size_t bends_at = at_wires ? paths.wires_at(segment) : segment;
  motion_.samples = count;
  motion_.hose = hose;
  if (!paths.any()) return motion_;
  const std::size_t cables = paths.construction_.cables().size();
  const std::size_t stride = padded(count) + padding;
  motion_.strain.assign(cables, nullptr);
  motion_.loose.assign(cables, {});
  rows_.resize(3 * paths.cables_.size());
  std::size_t loose = 0;
  for (std::size_t k = 0; k < paths.cables_.size(); ++k) {
    const Cable& cable = paths.cables_[k];
    const auto index = static_cast<std::size_t>(paths.construction_.cable_of(cable.part));
    if (cable.rubs) {
      std::vector<double>& own = rows_[3 * k];
      own.assign(stride, 0.0);
      for (std::size_t t = 0; t < count; ++t) own[t] = cable.along[paths.along_at(segment, first + t)];
    }
    const double* const strain = cable.rubs ? rows_[3 * k].data() : cable.strain.data() + first;
    motion_.strain[index] = strain;
    if (!cable.loose) continue;
    const auto bent = [&](std::size_t about) {
      std::vector<double>& to = rows_[3 * k + 1 + about];
      to.assign(stride, 0.0);
      paths.curvature_->read(bends_at, 2 * loose + about, first, count, to.data());
      return to.data();
    };
    motion_.loose[index] = {bent(0), bent(1), hose.twist, strain};
    ++loose;
  }
  return motion_;
}

}  // namespace dresslife::strain
