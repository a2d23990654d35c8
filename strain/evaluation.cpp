#include "strain/evaluation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "pipeline/errors.h"

namespace dresslife::strain {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t block_samples = 256;    // waves of five layers: 26 kB, within the first-level cache
constexpr std::size_t thinned_samples = 256;  // at least so many of them pick the wires of the bounds

std::vector<double> centres(const std::vector<double>& lengths) {
  std::vector<double> arcs;
  double start = 0;
  for (const double length : lengths) {
    arcs.push_back(start + length / 2);
    start += length;
  }
  return arcs;
}

double total(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

/// Share of node `node` in the value at one angle of the waves through a layer's nodes: Dirichlet's kernel.
double nodal_share(double angle, int node) {
  const double away = angle - 2 * pi * node / waves_per_layer;
  return (1 + 2 * std::cos(away) + 2 * std::cos(2 * away)) / waves_per_layer;
}

/// Shear (fibre null) or bending of the undeformed wire, as the ingredients hold them.
double rest_ingredient(const WireNode& node, const Fibre* fibre) {
  if (fibre == nullptr) return node.strain_factor * node.shear_radius / std::numbers::sqrt3 * node.rest.twist;
  if (fibre->on_axis) return 0;
  return fibre_strain(node.rest.bend1, node.rest.bend2, node.wire_radius, fibre->phi_sine, fibre->phi_cosine);
}

}  // namespace

void SiteRows::clear() {
  segment.clear();
  component.clear();
  helix.clear();
  fibre.clear();
  material.clear();
  turning.clear();
  strain.clear();
  sample.clear();
}

Evaluation::Evaluation(const Construction& construction, const pipeline::Strain& settings,
                       std::vector<double> lengths, std::size_t samples)
    : construction_(construction),
      lengths_(std::move(lengths)),
      arcs_(centres(lengths_)),
      samples_(samples),
      fibres_(strain::surface_fibres(settings.surface_fibres)),
      surface_fibres_(settings.surface_fibres),
      fibre_count_(static_cast<int>(fibres_.size())),
      gate_(static_cast<float>(settings.gate)),
      with_shear_(settings.equivalent == pipeline::Equivalent::shear_included),
      means_(construction, plan_slip(construction, settings.slip, total(lengths_)), lengths_, arcs_, samples),
      stick_{{construction, plan_slip(construction, {pipeline::Slip::stick}, total(lengths_)), lengths_,
              arcs_, samples},
             {}},
      free_{{construction, plan_slip(construction, {pipeline::Slip::free}, total(lengths_)), lengths_, arcs_,
             samples},
            {}} {
  for (std::size_t b = 0; b < construction.bundles().size(); ++b) {
    const Bundle& bundle = construction.bundles()[b];
    first_wire_.push_back(wires_.size());
    for (const int layer : bundle.wire_layers)
      for (int number = 1; number <= construction.layers()[layer].count; ++number)
        wires_.push_back(
            {static_cast<int>(b), layer, number, construction.wire_path(layer, number, bundle.part)});
  }
  find_probes(settings.probes);
}

void Evaluation::find_probes(const std::vector<pipeline::Probe>& probes) {
  for (const pipeline::Probe& probe : probes) {
    const auto wire =
        std::find_if(wires_.begin(), wires_.end(), [&](const Wire& w) { return w.path == probe.component; });
    if (wire == wires_.end())
      throw pipeline::InputError(
          {},
          fmt::format("strain.probes: no wire is called '{}' (a path from the outermost part "
                      "inward)",
                      probe.component),
          fmt::format("write it like '{}'", wires_.empty() ? "" : wires_.front().path));
    const int segments = static_cast<int>(lengths_.size());
    if (probe.segment_from_tool < 1 || probe.segment_from_tool > segments)
      throw pipeline::InputError(
          {},
          fmt::format("strain.probes: there is no segment {} from the tool (the dresspack has "
                      "{})",
                      probe.segment_from_tool, segments),
          "count from 1 at the tool");
    probes_.push_back(
        {lengths_.size() - probe.segment_from_tool, {static_cast<std::size_t>(wire - wires_.begin()), 0}});
  }
}

std::size_t Evaluation::longest_path() const {
  std::size_t longest = 0;
  for (const Wire& wire : wires_) longest = std::max(longest, wire.path.size());
  return longest;
}

std::size_t Evaluation::longest_material() const {
  std::size_t longest = 0;
  for (const Layer& layer : construction_.layers()) longest = std::max(longest, layer.material.size());
  return longest;
}

std::string Evaluation::summary() const {
  if (worst_range_ < 0) return "no wire was evaluated";
  return fmt::format("{} sites; largest strain range {:.3f} %, segment {} from the tool, {}", sites(),
                     100 * worst_range_, segments() - worst_segment_, wires_[worst_.wire].path);
}

void Evaluation::add(const DeformationHistory& block) {
  for (ClampMeans* means : {&means_, &stick_.means, &free_.means}) means->add(block);
}

bool Evaluation::mixed(const ClampMeans& means) const {
  return with_shear_ || std::any_of(means.plan().begin(), means.plan().end(),
                                    [](const LayerSlip& slip) { return slip.friction; });
}

BundleChain Evaluation::part_chain(int part, std::size_t segment, const ClampMeans& means,
                                   const std::vector<Fibre>& fibres) const {
  BundleChain chain = chain_to(construction_, means.plan(), part, arcs_[segment], fibres);
  means.attach(chain, part);
  if (held_ && &means == &means_) held_->attach(chain, part);
  return chain;
}

BundleChain Evaluation::layer_chain(const Bundle& bundle, std::size_t segment,
                                    const ClampMeans& means) const {
  BundleChain chain = part_chain(bundle.part, segment, means, fibres_);
  for (const int layer : bundle.wire_layers)
    for (int node = 0; node < waves_per_layer; ++node) {
      WireNode at = node_at(construction_, means.plan(), chain, layer, 1, bundle.part, arcs_[segment],
                            2 * pi * node / waves_per_layer);
      if (at.slide.sliding == Sliding::clamp_to_clamp)
        at.slide.clamp_strain = means.of_node(bundle.part, layer, node);
      chain.nodes.push_back(at);
    }
  return chain;
}

/// Up to sixteen wires of one layer. Their turning points fibre by fibre.
struct Evaluation::Group {
  std::size_t layer;  ///< in the bundle
  std::size_t first_wire;
  MixedLanes mixed;
  std::vector<LaneScan> scans;                    ///< (fibre)
  std::vector<std::vector<TurningList>> turning;  ///< (fibre, wire)
};

MixedLanes Evaluation::mixed_lanes(const BundleChain& chain, std::size_t layer_in_bundle,
                                   const LayerSlip& slip, const std::vector<double>& angles) const {
  MixedLanes mixed;
  constexpr float glued = std::numeric_limits<float>::infinity();
  mixed.cap = slip.sliding == Sliding::glued ? glued : static_cast<float>(slip.cap.constant);
  mixed.cap_per_mean = static_cast<float>(slip.cap.per_mean);
  mixed.scales = construction_.kinematics() == pipeline::Kinematics::exact;
  mixed.with_shear = with_shear_;
  mixed.on_axis = surface_fibres_ == 0;
  mixed.rest.resize(1 + fibre_count_);
  const WireNode* nodes = chain.nodes.data() + layer_in_bundle * waves_per_layer;
  for (int lane = 0; lane < lanes; ++lane) {
    const double angle = angles[lane < static_cast<int>(angles.size()) ? lane : 0];
    mixed.slip[lane] = 0;
    mixed.shape[0][lane] = static_cast<float>(std::sin(angle));
    mixed.shape[1][lane] = static_cast<float>(std::cos(angle));
    mixed.shape[2][lane] = static_cast<float>(std::sin(2 * angle));
    mixed.shape[3][lane] = static_cast<float>(std::cos(2 * angle));
    for (int kind = 0; kind <= fibre_count_; ++kind) {
      double rest = 0;
      for (int node = 0; node < waves_per_layer; ++node)
        rest +=
            nodal_share(angle, node) * rest_ingredient(nodes[node], kind == 0 ? nullptr : &fibres_[kind - 1]);
      mixed.rest[kind][lane] = static_cast<float>(rest);
    }
  }
  return mixed;
}

void Evaluation::run_blocks(const BundleChain& chain, const DeformationColumns& columns, std::size_t samples,
                            bool is_mixed, bool keep, std::vector<Group>& groups) const {
  const std::size_t layers = chain.nodes.size() / waves_per_layer;
  const int kinds = is_mixed ? ingredients(fibre_count_) : fibre_count_;
  std::vector<float> waves(layers * kinds * waves_per_layer * block_samples);
  std::vector<float> strains(is_mixed ? fibre_count_ * block_samples * lanes : 0);
  for (std::size_t first = 0; first < samples; first += block_samples) {
    const std::size_t count = std::min(block_samples, samples - first);
    const auto fill = is_mixed ? kernels().ingredient_waves : kernels().layer_waves;
    fill(pointers(chain), columns, first, count, waves.data(), block_samples);
    for (Group& group : groups) {
      const float* of_layer = waves.data() + group.layer * kinds * waves_per_layer * block_samples;
      if (is_mixed) kernels().mix(group.mixed, of_layer, block_samples, count, fibre_count_, strains.data());
      for (int f = 0; keep && f < fibre_count_; ++f) {
        if (is_mixed) {
          group.scans[f].scan_strains(strains.data() + f * count * lanes, count, group.turning[f]);
          continue;
        }
        Waves of;
        for (int w = 0; w < waves_per_layer; ++w)
          of.at[w] = of_layer + (f * waves_per_layer + w) * block_samples;
        group.scans[f].scan(of, count, group.turning[f]);
      }
    }
  }
}

void Evaluation::scan_bundle(
    std::size_t b, std::size_t segment, const ClampMeans& means, const DeformationHistory& history,
    std::size_t row, float gate,
    const std::function<void(Site, const Extremes&, const TurningList&)>& found) const {
  const Bundle& bundle = construction_.bundles()[b];
  const BundleChain chain = layer_chain(bundle, segment, means);
  const bool is_mixed = mixed(means);
  std::vector<Group> groups;
  std::size_t wire = first_wire_[b];
  bool settles = false;
  for (std::size_t k = 0; k < bundle.wire_layers.size(); ++k) {
    const int count = construction_.layers()[bundle.wire_layers[k]].count;
    const LayerSlip& slip = means.plan()[bundle.wire_layers[k]];
    settles = settles || slip.friction;
    for (int first = 0; first < count; first += lanes) {
      std::vector<double> angles;
      for (int j = first; j < std::min(count, first + lanes); ++j) angles.push_back(2 * pi * j / count);
      Group& group = groups.emplace_back(Group{k, wire + first, {}, {}, {}});
      if (is_mixed) group.mixed = mixed_lanes(chain, k, slip, angles);
      for (int f = 0; f < fibre_count_; ++f) {
        group.scans.emplace_back(angles, gate);
        group.turning.emplace_back(angles.size());
      }
    }
    wire += count;
  }
  if (settles) run_blocks(chain, history.columns(row), history.samples(), is_mixed, false, groups);
  run_blocks(chain, history.columns(row), history.samples(), is_mixed, true, groups);
  for (Group& group : groups) {
    for (int f = 0; f < fibre_count_; ++f) group.scans[f].finish(group.turning[f]);
    for (int lane = 0; lane < group.scans[0].wires(); ++lane)
      for (int f = 0; f < fibre_count_; ++f)
        found({group.first_wire + lane, f}, {group.scans[f].lowest(lane), group.scans[f].highest(lane)},
              group.turning[f][lane]);
  }
}

std::vector<double> Evaluation::history_of(Site site, std::size_t segment, const ClampMeans& means,
                                           const DeformationHistory& history, std::size_t row) const {
  const Wire& wire = wires_[site.wire];
  const int part = construction_.bundles()[wire.bundle].part;
  BundleChain chain = part_chain(part, segment, means, {fibres_[site.fibre]});
  chain.nodes.push_back(
      node_at(construction_, means.plan(), chain, wire.layer, wire.number, part, arcs_[segment], 0));
  std::vector<double> sliding;
  if (chain.nodes[0].slide.sliding == Sliding::clamp_to_clamp) {
    sliding = means.at_angle(part, wire.layer,
                             2 * pi * (wire.number - 1) / construction_.layers()[wire.layer].count);
    chain.nodes[0].slide.clamp_strain = sliding.data();
  }
  const std::size_t samples = history.samples(), stride = padded(samples);
  if (mixed(means)) return mixed_history(chain, means.plan()[wire.layer], history.columns(row), samples);
  std::vector<double> strain(stride);
  kernels().node_strains(pointers(chain), history.columns(row), 0, samples, strain.data(), stride);
  strain.resize(samples);
  return strain;
}

/// What Kernels::mix does, of one fibre in double precision.
std::vector<double> Evaluation::mixed_history(const BundleChain& chain, const LayerSlip& slip,
                                              const DeformationColumns& columns, std::size_t samples) const {
  const std::size_t stride = padded(samples);
  std::vector<double> rows(ingredients(1) * stride), strain(samples);
  kernels().node_ingredients(pointers(chain), columns, 0, samples, rows.data(), stride);
  const WireNode& node = chain.nodes[0];
  const Fibre& fibre = chain.fibres[0];
  const double rest_bending = rest_ingredient(node, &fibre), rest_shear = rest_ingredient(node, nullptr);
  const bool scales = construction_.kinematics() == pipeline::Kinematics::exact;
  constexpr double glued = std::numeric_limits<double>::infinity();
  Slider slider;
  for (int run = 0; run < (slip.friction ? 2 : 1); ++run)
    for (std::size_t t = 0; t < samples; ++t) {
      const double mean = rows[mean_strain * stride + t], away = rows[deviation * stride + t];
      const double cap = slip.sliding == Sliding::glued ? glued : cap_at(slip.cap, mean);
      const double axial = mean + slider.next(away, cap);
      const double scale = scales ? (1 + axial) / (1 + mean + away) : 1;
      strain[t] = axial + (fibre.on_axis ? 0 : rows[first_bending * stride + t] * scale - rest_bending);
      if (!with_shear_) continue;
      const double torsion = rows[shear * stride + t] * scale - rest_shear;
      strain[t] = std::copysign(std::hypot(strain[t], torsion), strain[t]);
    }
  return strain;
}

void Evaluation::append(SiteRows& rows, Site site, std::size_t segment, const TurningList& turning) const {
  const Wire& wire = wires_[site.wire];
  const Layer& layer = construction_.layers()[wire.layer];
  const int part = construction_.bundles()[wire.bundle].part;
  rows.segment.push_back(static_cast<std::int32_t>(segment));
  rows.component.push_back(wire.path);
  rows.material.push_back(layer.material);
  const std::size_t helix = rows.helix.size();
  rows.helix.resize(helix + 3 * construction_.levels(), 0.0);
  auto put_level = [&](const Layer& of, double phase) {
    double* at = rows.helix.data() + helix + 3 * (of.level - 1);
    at[0] = of.helix_radius;
    at[1] = of.lay_angle;
    at[2] = phase;
  };
  for (int inner = part; inner != dresspack_itself; inner = construction_.parts()[inner].parent) {
    const Part& in = construction_.parts()[inner];
    put_level(construction_.layers()[in.layer],
              construction_.phase(in.layer, in.number, in.parent, arcs_[segment]));
  }
  put_level(layer, construction_.phase(wire.layer, wire.number, part, arcs_[segment]));
  const bool on_axis = surface_fibres_ == 0 || layer.is_hose;
  rows.fibre.insert(rows.fibre.end(),
                    {on_axis ? 0 : layer.part_radius, fibre_angle(site.fibre, surface_fibres_)});
  rows.turning.push_back(turning.size());
  for (const TurningPoint& point : turning.points()) {
    rows.strain.push_back(point.strain);
    rows.sample.push_back(point.sample);
  }
}

/// Something like the damage of Smith, Watson and Topper between turning points: ranges times tensile peaks,
/// to a power between those of short (1.4) and long (4.5) lives of the thesis' copper.
float cycle_sum(const TurningList& turning) {
  float sum = 0;
  const auto points = turning.points();
  for (std::size_t k = 1; k < points.size(); ++k) {
    const float peak = std::max({points[k].strain, points[k - 1].strain, 0.0f});
    const float product = peak * std::abs(points[k].strain - points[k - 1].strain);
    sum += product * product * product;
  }
  return sum;
}

void Evaluation::Worst::consider(Site at, const Extremes& extremes, const TurningList& turning) {
  const float high = std::max(0.0f, extremes.high);
  const std::array<float, measures> of{extremes.range(), extremes.size(), high, extremes.range() * high,
                                       cycle_sum(turning)};
  for (int by = 0; by < measures; ++by)
    if (of[by] > value[by]) {
      value[by] = of[by];
      site[by] = at;
    }
}

void Evaluation::evaluate(std::size_t segment, const DeformationHistory& history, std::size_t row,
                          const Sink& sink) {
  const std::size_t bundles = construction_.bundles().size();
  std::vector<Worst> worst(construction_.layers().size());
  SiteRows rows;
  held_.reset();
  if (std::any_of(means_.plan().begin(), means_.plan().end(),
                  [](const LayerSlip& slip) { return slip.friction; }))
    held_.emplace(construction_, means_, arcs_[segment], history.columns(row), history.samples());
  for (std::size_t b = 0; b < bundles; ++b) {
    rows.clear();
    scan_bundle(b, segment, means_, history, row, gate_,
                [&](Site site, const Extremes& extremes, const TurningList& turning) {
                  append(rows, site, segment, turning);
                  worst[wires_[site.wire].layer].consider(site, extremes, turning);
                });
    sink.sites(rows);
    if (sink.progress)
      sink.progress((static_cast<double>(segment) + (b + 1.0) / bundles) / static_cast<double>(segments()));
  }
  for (Bound* bound : {&stick_, &free_}) {
    const bool same = bound->means.plan() == means_.plan();
    put_bound(same ? worst : worst_of(*bound, segment, history, row), bound->means, segment, history, row,
              bound == &stick_ ? sink.bound_stick : sink.bound_free);
  }
  auto probe = [&](Site site) {
    const std::size_t index = (segment * wires_.size() + site.wire) * fibre_count_ + site.fibre;
    sink.probe({index, history_of(site, segment, means_, history, row)});
  };
  const auto of_all = std::max_element(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) {
    return a.value[Worst::range] < b.value[Worst::range];
  });
  if (of_all != worst.end() && of_all->value[Worst::range] >= 0) {
    probe(of_all->site[Worst::range]);
    if (of_all->value[Worst::range] > worst_range_) {
      worst_range_ = of_all->value[Worst::range];
      worst_ = of_all->site[Worst::range];
      worst_segment_ = segment;
    }
  }
  for (const auto& [at, site] : probes_)
    if (at == segment) probe(site);
}

std::vector<Evaluation::Worst> Evaluation::worst_of(Bound& bound, std::size_t segment,
                                                    const DeformationHistory& history,
                                                    std::size_t row) const {
  const std::size_t every = std::max<std::size_t>(1, history.samples() / thinned_samples);
  if (!bound.thin) bound.thin.emplace(bound.means.thinned(every));
  const DeformationHistory thin = history.thinned(row, every);
  std::vector<Worst> worst(construction_.layers().size());
  for (std::size_t b = 0; b < construction_.bundles().size(); ++b)
    scan_bundle(b, segment, *bound.thin, thin, 0, gate_,
                [&](Site site, const Extremes& extremes, const TurningList& turning) {
                  worst[wires_[site.wire].layer].consider(site, extremes, turning);
                });
  return worst;
}

void Evaluation::put_bound(const std::vector<Worst>& worst, const ClampMeans& means, std::size_t segment,
                           const DeformationHistory& history, std::size_t row,
                           const std::function<void(const SiteRows&)>& sink) const {
  std::set<Site> sites;
  for (const Worst& layer : worst)
    for (int by = 0; by < Worst::measures; ++by)
      if (layer.value[by] >= 0) sites.insert(layer.site[by]);
  SiteRows rows;
  for (const Site site : sites) {
    TurningPoints points(gate_);
    TurningList turning;
    for (const double strain : history_of(site, segment, means, history, row))
      points.next(static_cast<float>(strain), turning);
    points.finish(turning);
    append(rows, site, segment, turning);
  }
  sink(rows);
}

}  // namespace dresslife::strain
