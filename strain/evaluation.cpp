#include "strain/evaluation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "pipeline/base/constants.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/threads.h"

namespace dresslife::strain {
namespace {

// Per thread, twice as many bundles as have this number of samples may wait to be written: enough to bridge a slow write.
constexpr std::size_t samples_at_a_time = 1 << 14;

std::vector<double> centres(const std::vector<double>& lengths, double start) {
  std::vector<double> arcs;
  for (const double length : lengths) {
    arcs.push_back(start + length / 2);
    start += length;
  }
  return arcs;
}

std::vector<double> places_of_wires(const std::vector<double>& lengths, std::vector<double> arcs, KnownEnds known) {
  if (known[0]) arcs.front() -= lengths.front() / 2;
  if (known[1]) arcs.back() += lengths.back() / 2;
  return arcs;
}

double total(const std::vector<double>& lengths) { return std::accumulate(lengths.begin(), lengths.end(), 0.0); }

double clamped(const SpanPlace& place, const std::vector<double>& lengths) {
  return std::max(place.clamped_length, total(lengths));
}

/// Returns a plan in which all parts inside the cables stick or slide. Cables that slide in the job keep their plan. Cables that
/// stick in the job stick, or slide at their own places, like the parts inside.
std::vector<LayerSlip> bound_plan(const Construction& construction, const std::vector<LayerSlip>& own,
                                  pipeline::Slip inside, double free_length) {
  std::vector<LayerSlip> plan = plan_slip(construction, {inside}, free_length);
  for (std::size_t k = 0; k < plan.size(); ++k) {
    if (!construction.layers()[k].is_cable()) continue;
    const bool slides = own[k].loose || own[k].sliding != Sliding::glued;
    if (slides) {
      plan[k] = own[k];
    } else if (plan[k].loose) {
      plan[k].loose = false;
      plan[k].sliding = Sliding::clamp_to_clamp;
    }
  }
  return plan;
}

bool slips_only(const pipeline::Strain& settings, pipeline::Slip slip) {
  return std::ranges::all_of(settings.slip, [&](pipeline::Slip own) { return own == slip; });
}

/// Returns a measure of the damage of Smith, Watson and Topper for a yielding metal: the sum of (range times stress of the
/// tensile peak)^2.5 between neighbours; stress grows as the fifth root of strain (copper's n' is 0.19). It finds wires that
/// many medium cycles damage, which StrainMeasures::cycle_sum misses.
float yielding_cycle_sum(std::span<const float> strains) {
  float sum = 0;
  for (std::size_t k = 1; k < strains.size(); ++k) {
    const float range = std::abs(strains[k] - strains[k - 1]);
    const float peak = std::max(0.0f, std::max(strains[k], strains[k - 1]));
    sum += range * range * std::sqrt(range * peak);
  }
  return sum;
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

Evaluation::Evaluation(const Construction& construction, const pipeline::Strain& settings, std::vector<double> lengths,
                       std::size_t samples, std::size_t threads, const SpanPlace& place, const Scratch& scratch)
    : construction_(construction),
      place_(place),
      lengths_(std::move(lengths)),
      arcs_(centres(lengths_, place.first_arc)),
      places_(places_of_wires(lengths_, arcs_, place.known_ends)),
      samples_(samples),
      fibres_(strain::surface_fibres(settings.surface_fibres)),
      surface_fibres_(settings.surface_fibres),
      scan_{static_cast<int>(fibres_.size()), static_cast<float>(settings.gate), counts_shear(settings.equivalent),
            settings.surface_fibres == 0},
      with_planes_(judges_planes(settings.equivalent)),
      means_(construction, plan_slip(construction, settings.slip, clamped(place, lengths_)), lengths_, arcs_, samples),
      stick_{{construction, bound_plan(construction, means_.plan(), pipeline::Slip::stick, clamped(place, lengths_)),
              lengths_, arcs_, samples},
             slips_only(settings, pipeline::Slip::stick)},
      free_{{construction, bound_plan(construction, means_.plan(), pipeline::Slip::free, clamped(place, lengths_)),
             lengths_, arcs_, samples},
            slips_only(settings, pipeline::Slip::free)},
      cables_(construction, free_.means.plan(),
              {rubs(settings.slip.front()), !slides(settings.slip.front()), place.free_tool_end,
               static_cast<std::size_t>(settings.cable_elements), place.known_ends, place.relief_stiffness,
               place.stiffness_factor},
              lengths_, arcs_, samples, scratch),
      scratch_(scratch) {
  if (place_.segments_in_all == 0) place_.segments_in_all = lengths_.size();
  place_.levels = std::max(place_.levels, construction.levels());
  const std::string before = place_.name.empty() ? "" : place_.name + "/";
  for (std::size_t k = 0; k < threads; ++k) workers_.push_back({{construction, scan_}, {}, {}, {}});
  add_held(means_);
  for (std::size_t b = 0; b < construction.bundles().size(); ++b) {
    const Bundle& bundle = construction.bundles()[b];
    first_wire_.push_back(wires_.size());
    for (const int layer : bundle.wire_layers)
      for (int number = 1; number <= construction.layers()[layer].count; ++number)
        wires_.push_back(
            {static_cast<int>(b), layer, number, before + construction.wire_path(layer, number, bundle.part)});
  }
  find_probes(settings.probes);
}

void Evaluation::find_probes(const std::vector<pipeline::ProbeRequest>& probes) {
  for (const pipeline::ProbeRequest& probe : probes) {
    const auto wire = std::ranges::find(wires_, probe.component, &Wire::path);
    if (wire == wires_.end())
      throw pipeline::InputError({},
                                 fmt::format("strain.probes: no wire is called '{}' (a path from the outermost part "
                                             "inward)",
                                             probe.component),
                                 wires_.empty() ? "leave it out: the dresspack has no wires"
                                                : fmt::format("write it like '{}'", wires_.front().path));
    const int segments = static_cast<int>(place_.segments_in_all);
    if (probe.segment_from_tool < 1 || probe.segment_from_tool > segments)
      throw pipeline::InputError({},
                                 fmt::format("strain.probes: there is no segment {} from the tool (the dresspack has "
                                             "{})",
                                             probe.segment_from_tool, segments),
                                 "count from 1 at the tool");
    const std::size_t segment = place_.segments_in_all - probe.segment_from_tool;
    if (segment >= place_.first_segment && segment < place_.first_segment + lengths_.size())
      probes_.push_back({segment - place_.first_segment, {static_cast<std::size_t>(wire - wires_.begin()), 0}});
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

std::string Evaluation::name_of_layer(int layer) const {
  std::string name;
  for (; layer != dresspack_itself; layer = construction_.layers()[layer].parent) {
    const Layer& of = construction_.layers()[layer];
    name = (of.label.empty() ? "" : of.label + "/") + of.name + (name.empty() ? "" : "/" + name);
  }
  return (place_.name.empty() ? "" : place_.name + "/") + name;
}

std::string Evaluation::summary(std::size_t sites) const {
  if (worst_range_ < 0) return "no wire was evaluated";
  return fmt::format("{} sites; largest strain range {:.3f} %, segment {} from the tool, {}", sites, 100 * worst_range_,
                     place_.segments_in_all - place_.first_segment - worst_segment_, wires_[worst_.wire].path);
}

void Evaluation::add(const SpanBlock& block) {
  Evaluation* const alone = this;
  add({&alone, 1}, block);
}

void Evaluation::add(std::span<Evaluation* const> all, const SpanBlock& block) {
  std::vector<CablePaths*> cables;
  for (Evaluation* const of : all) cables.push_back(&of->cables_);
  CablePaths::add(cables, block);
  for (Evaluation* const of : all) {
    of->add_bends(block.deformation);
    of->keep_bends(block);
    if (!of->cables_.remembers()) of->add_means(block.deformation);
  }
}

void Evaluation::lead_in(std::span<Evaluation* const> all, const SpanBlock& block) {
  std::vector<CablePaths*> cables;
  for (Evaluation* const of : all) cables.push_back(&of->cables_);
  CablePaths::lead_in(cables, block);
}

void Evaluation::end_repeat(std::span<Evaluation* const> all, double further) {
  std::vector<CablePaths*> cables;
  for (Evaluation* const of : all) cables.push_back(&of->cables_);
  CablePaths::end_repeat(cables, further);
}

void Evaluation::repeat() {
  cables_.repeat();
  for (ClampMeans* means : {&means_, &stick_.means, &free_.means}) means->repeat();
  meant_ = 0;
  if (hose_bends_) hose_bends_->clear();
}

void Evaluation::record_net_bend() {
  net_bend_.emplace(construction_, means_.plan(), lengths_, arcs_, clamped(place_, lengths_));
}

/// Loose cables have bends of their own.
void Evaluation::keep_bends(const SpanBlock& block) {
  const auto& plan = means_.plan();
  if (std::ranges::all_of(construction_.cables(),
                          [&](int part) { return plan[construction_.parts()[part].layer].loose; }))
    return;
  const std::size_t rows = lengths_.size() + 2;
  if (!hose_bends_) hose_bends_.emplace(rows, 2, samples_, scratch_);
  hose_bends_->begin(block.deformation.samples());
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t end = row == 0 ? 0 : 1, segment = std::clamp<std::size_t>(row, 1, rows - 2) - 1;
    const DeformationColumns here = block.deformation.columns(segment);
    const bool known = (row == 0 || row + 1 == rows) && place_.known_ends[end];
    for (std::size_t t = 0; t < block.deformation.samples(); ++t) {
      const auto [k1, k2] = known ? std::pair(block.ends[2 * t + end].curvature1, block.ends[2 * t + end].curvature2)
                                  : std::pair(here.curvature1[t], here.curvature2[t]);
      hose_bends_->at(row, 0, t) = static_cast<float>(k1);
      hose_bends_->at(row, 1, t) = static_cast<float>(k2);
    }
  }
  hose_bends_->end();
}

BentCables Evaluation::bent_cables() const {
  const auto part = [this](std::size_t cable) { return construction_.cables()[cable]; };
  return {lengths_,
          arcs_,
          places_,
          samples_,
          [=, this](std::size_t cable, std::size_t row, int about, std::size_t first, std::size_t count, double* to) {
            if (cables_.read_curvature(part(cable), row, about, first, count, to)) return;
            hose_bends_->read(row, about, first, count, to);
          },
          [=, this](std::size_t cable, std::size_t segment, std::size_t first, std::size_t count, double* to) {
            cables_.read_strain(part(cable), segment, first, count, to);
          }};
}

std::shared_ptr<const LongWaves> Evaluation::lines_rubbing(double factor, const std::vector<LayerSlip>& plan,
                                                           const std::vector<int>& layers) const {
  Scratch scratch = scratch_;
  scratch.room = static_cast<std::size_t>(share_of_lines * static_cast<double>(scratch.room));
  return std::make_shared<const LongWaves>(construction_, plan, layers, bent_cables(), factor, scratch);
}

/// A rig that evaluates a part of its cable does not have the bends of the others.
void Evaluation::find_lines() {
  if (samples_ == 0) return;
  std::vector<double> limits;
  for (std::size_t cable = 0; cable < construction_.cables().size(); ++cable) {
    const double wave = bend_wave(bent_cables(), cable);
    limits.push_back(believable_evening * wave);
    evening_.bend_wave = std::min(evening_.bend_wave, wave);
  }
  if (place_.clamped_length > total(lengths_) || is_thesis(construction_.kinematics())) return;
  plan_of_lines_ = means_.plan();
  line_layers_ = LongWaves::layers_of(construction_, plan_of_lines_, limits);
  const std::vector<LayerSlip> free = free_.means.plan();
  const std::vector<int> free_layers = LongWaves::layers_of(construction_, free, limits);
  if (!free_layers.empty()) free_.means.set_lines(free_layers, lines_rubbing(1, free, free_layers));
  if (line_layers_.empty()) return;
  const bool same = free == plan_of_lines_;
  means_.set_lines(line_layers_, same ? free_.means.lines() : lines_rubbing(1, plan_of_lines_, line_layers_));
}

std::vector<LineWave> Evaluation::lines_of(const Bundle& bundle, std::size_t segment, const ClampMeans& means) const {
  std::vector<LineWave> lines;
  for (const int layer : bundle.wire_layers)
    if (means.lines()) lines.push_back(means.lines()->of(layer, bundle.part, segment));
  return lines;
}

LineWave Evaluation::line_of(Site site, std::size_t segment, const ClampMeans& means) const {
  const Wire& wire = wires_[site.wire];
  if (!means.lines()) return {};
  return means.lines()->of(wire.layer, construction_.bundles()[wire.bundle].part, segment);
}

double Evaluation::angle_of(Site site) const {
  const Wire& wire = wires_[site.wire];
  return 2 * pi * (wire.number - 1) / construction_.layers()[wire.layer].count;
}

void Evaluation::add_bends(const DeformationHistory& block) {
  if (net_bend_) net_bend_->add(block);
  bends_.resize(2 * lengths_.size());
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const DeformationColumns here = block.columns(i);
    const DeformationColumns next = block.columns(std::min(i + 1, lengths_.size() - 1));
    for (std::size_t t = 0; t < block.samples(); ++t) {
      bends_[2 * i].add({here.curvature1[t], here.curvature2[t]});
      bends_[2 * i + 1].add({next.curvature1[t] - here.curvature1[t], next.curvature2[t] - here.curvature2[t]});
    }
  }
}

void Evaluation::end_first_pass() {
  cables_.finish();
  if (std::exchange(first_pass_ended_, true)) return;
  double bends = 0, slopes = 0;  // mean squares, summed over the length
  for (std::size_t i = 0; 2 * i < bends_.size(); ++i) {
    bends += lengths_[i] * bends_[2 * i].variance();
    if (i + 1 < lengths_.size()) slopes += bends_[2 * i + 1].variance() / (arcs_[i + 1] - arcs_[i]);
  }
  // Poses give curvatures with an error of up to 1e-9 1/m. A bend of 1e-6 1/m strains the jacket of a hose of 0.1 m by 5e-8.
  const bool bent = bends > 1e-12 * total(lengths_);
  if (bent && slopes > 0) evening_.bend_wave = 2 * std::numbers::pi * std::sqrt(bends / slopes);
  find_lines();
  const ShortenedPlan of = means_.shorten(evening_.bend_wave);
  evening_.layer = of.longest;
  evening_.longest = of.evening;
  if (of.longest < 0) return;
  evening_.straight =
      of.plan[of.longest].sliding == Sliding::clamp_to_clamp && std::isinf(construction_.layers()[of.longest].pitch());
  constexpr double slant = 1.2;  // a lay along its helix of up to 33 deg, over the same along the cable
  evening_.own_lay = of.evening <= slant * construction_.layers()[of.longest].pitch();
}

void Evaluation::add_again(const DeformationHistory& block) {
  cables_.finish();
  add_means(block);
}

void Evaluation::add_means(const DeformationHistory& block) {
  for (ClampMeans* means : {&means_, &stick_.means, &free_.means}) {
    if (!means->needed()) continue;
    for (int round = 0; round < means->rounds(); ++round) {
      for (std::size_t segment = 0; segment < lengths_.size(); ++segment)
        means->add(round, segment, keeper_.of(cables_, segment, block.columns(segment), meant_, block.samples()));
      means->end_round(round);
    }
    means->next_block();
  }
  meant_ += block.samples();
}

const SegmentMotion& Evaluation::motion_at_wires(std::size_t segment, const DeformationHistory& history,
                                                 std::size_t row) {
  const DeformationColumns hose = history.columns(row);
  const bool same_place = at_wires_segment_ == segment && at_wires_row_ == row;
  if (at_wires_ && same_place && at_wires_->hose.curvature1 == hose.curvature1) return *at_wires_;
  at_wires_segment_ = segment, at_wires_row_ = row;
  at_wires_ = &keeper_at_wires_.of(cables_, segment, hose, 0, history.samples(), true);
  return *at_wires_;
}

bool Evaluation::mixed(const ClampMeans& means) const {
  return scan_.with_shear || std::ranges::any_of(means.plan(), &LayerSlip::friction);
}

bool Evaluation::rubs_inside() const {
  return std::ranges::any_of(plan_of_lines_.empty() ? means_.plan() : plan_of_lines_, &LayerSlip::friction);
}

void Evaluation::add_held(const ClampMeans& means) {
  for (Worker& worker : workers_)
    worker.held.push_back(std::make_unique<HeldStrains>(construction_, means, worker.deviations, order_for(fibres_)));
}

bool Evaluation::holds_down_to(int part, const ClampMeans& means) const {
  const std::vector<int> line = construction_.ancestry(part);
  return std::ranges::any_of(line,
                             [&](int above) { return means.plan()[construction_.parts()[above].layer].friction; });
}

HeldStrains* Evaluation::held_of(const ClampMeans& means, Worker& worker) const {
  if (&means == &means_) return worker.held[0].get();
  for (std::size_t k = 0; k < rubbing_.size(); ++k)
    if (&means == rubbing_[k].second.get()) return worker.held[1 + k].get();
  return nullptr;
}

const DeformationColumns& Evaluation::columns_of(Site site, const ClampMeans& means,
                                                 const SegmentMotion& motion) const {
  return motion.columns(construction_, means.plan(), construction_.bundles()[wires_[site.wire].bundle].part);
}

BundleNesting Evaluation::part_nesting(int part, std::size_t segment, const ClampMeans& means,
                                       const SegmentMotion& motion, const std::vector<Fibre>& fibres,
                                       Worker& worker) const {
  BundleNesting nesting = nesting_to(construction_, means.plan(), part, places_[segment], fibres);
  means.attach(nesting, part, motion);
  if (HeldStrains* const held = held_of(means, worker)) held->attach(nesting, part);
  return nesting;
}

BundleNesting Evaluation::layer_nesting(const Bundle& bundle, std::size_t segment, const ClampMeans& means,
                                        const SegmentMotion& motion, Worker& worker) const {
  BundleNesting nesting = part_nesting(bundle.part, segment, means, motion, fibres_, worker);
  nesting.nodes.reserve(waves_per_layer * bundle.wire_layers.size());
  for (const int layer : bundle.wire_layers) {
    add_wire_layer(construction_, means.plan(), nesting, layer, bundle.part, places_[segment]);
    WireNode* const nodes = &nesting.nodes[nesting.nodes.size() - waves_per_layer];
    for (int node = 0; node < waves_per_layer; ++node)
      if (nodes[node].slide.sliding == Sliding::clamp_to_clamp)
        nodes[node].slide.clamp_strain = means.of_node(bundle.part, layer, node);
  }
  return nesting;
}

/// Returns whether every part that the nesting moves along its pitch is the parent of the nesting's last part or lies in it.
bool parent_suffices(const BundleNesting& nesting) {
  const int steps = static_cast<int>(nesting.steps.size());
  auto reaches_above = [&](const SlidingNumbers& slide) {
    return slide.sliding == Sliding::along_ancestor && slide.helical_level < steps;
  };
  return steps > 0 && !reaches_above(nesting.steps.back().slide) &&
         std::ranges::none_of(nesting.nodes, [&](const WireNode& node) { return reaches_above(node.slide); });
}

BundlePointers Evaluation::from_parent(const BundleNesting& nesting, int part, std::size_t segment,
                                       const ClampMeans& means, const SegmentMotion& motion, Worker& worker) const {
  BundlePointers from = pointers(nesting);
  const int parent = part == dresspack_itself ? dresspack_itself : construction_.parts()[part].parent;
  if (parent == dresspack_itself || !parent_suffices(nesting)) return from;
  const bool rubbed = held_of(means, worker) && !holds_down_to(parent, means);
  const ParentKey wanted{parent, nesting.order + 1, rubbed ? &means_ : &means};
  const bool in_double = !single_suffices(nesting.steps.back(), from.nodes, from.node_count, nesting.order);
  if (worker.parent_is != wanted || (in_double && !worker.parent.in_double())) {
    BundleNesting to_parent = part_nesting(parent, segment, means, motion, fibres_, worker);
    to_parent.order = nesting.order + 1;
    worker.parent.fill(to_parent, motion.columns(construction_, means.plan(), parent), motion.samples, in_double);
    worker.parent_is = wanted;
  }
  worker.parent.lend(from);
  return from;
}

void Evaluation::scan_bundle(std::size_t b, std::size_t segment, const ClampMeans& means, const SegmentMotion& motion,
                             bool with_rows, Worker& worker, BundleSites& out) const {
  const Bundle& bundle = construction_.bundles()[b];
  const BundleNesting nesting = layer_nesting(bundle, segment, means, motion, worker);
  const BundlePointers from = from_parent(nesting, bundle.part, segment, means, motion, worker);
  const DeformationColumns& columns = motion.columns(construction_, means.plan(), bundle.part);
  out.rows.clear();
  out.seen.clear();
  const auto site_of = [&](std::size_t wire, int fibre) { return Site{first_wire_[b] + wire, fibre}; };
  if (!with_rows) {
    worker.scan.rank(bundle, means.plan(), from, mixed(means), columns, motion.samples,
                     lines_of(bundle, segment, means));
    worker.scan.for_each_rank([&](std::size_t wire, int fibre, const StrainMeasures& of) {
      out.seen.push_back(seen(site_of(wire, fibre), of));
    });
    return;
  }
  worker.scan.run(bundle, means.plan(), from, mixed(means), columns, motion.samples, lines_of(bundle, segment, means));
  const std::vector<double> helix = helix_of(bundle.part, segment);
  worker.scan.for_each_site([&](std::size_t wire, int fibre, std::span<const TurningPoint> points) {
    append_site(out.rows, site_of(wire, fibre), segment, helix);
    const std::span<const float> strains = append_points(out.rows, points);
    out.seen.push_back(seen(site_of(wire, fibre), kernels().measures(strains.data(), strains.size())));
    if (with_planes_) out.seen.back().by[Worst::yielding_cycles] = yielding_cycle_sum(strains);
  });
}

void Evaluation::scan_bundles(std::size_t segment, const ClampMeans& means, const SegmentMotion& motion, bool with_rows,
                              const std::function<void(const BundleSites&)>& use) {
  const std::size_t bundles = construction_.bundles().size(), threads = workers_.size();
  const std::size_t each = std::max<std::size_t>(1, samples_at_a_time / motion.samples);
  const std::size_t ahead = threads == 1 ? 1 : std::min(bundles, 2 * threads * each);
  for (Worker& worker : workers_) worker.parent_is = {};
  if (found_.size() < ahead) found_.resize(ahead);
  pipeline::in_order(
      threads, bundles, ahead,
      [&](std::size_t part, std::size_t b) {  // no shared state: the thread has no influence on the result
        scan_bundle(b, segment, means, motion, with_rows, workers_[part], found_[b % ahead]);
      },
      [&](std::size_t b) { use(found_[b % ahead]); });
}

BundleNesting Evaluation::site_nesting(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                                       const SegmentMotion& motion, std::vector<std::vector<double>>& sliding,
                                       Worker& worker) const {
  const int part = construction_.bundles()[wires_[sites[0].wire].bundle].part;
  BundleNesting nesting = part_nesting(part, segment, means, motion, {fibres_[sites[0].fibre]}, worker);
  sliding.resize(sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const Wire& wire = wires_[sites[k].wire];
    WireNode& node = nesting.nodes.emplace_back(
        node_at(construction_, means.plan(), nesting, wire.layer, wire.number, part, places_[segment], 0));
    if (node.slide.sliding != Sliding::clamp_to_clamp) continue;
    sliding[k] =
        means.at_angle(part, wire.layer, 2 * pi * (wire.number - 1) / construction_.layers()[wire.layer].count);
    node.slide.clamp_strain = sliding[k].data();
  }
  return nesting;
}

namespace {

/// Replaces the strain by the equivalent strain with shear.
void count_shear(FibreHistory& both) {
  for (std::size_t t = 0; t < both.strain.size(); ++t)
    both.strain[t] = std::copysign(std::hypot(both.strain[t], both.shear[t] / std::numbers::sqrt3), both.strain[t]);
}

}  // namespace

std::vector<std::vector<double>> Evaluation::histories_of(std::span<const Site> sites, std::size_t segment,
                                                          const ClampMeans& means, const SegmentMotion& motion,
                                                          Worker& worker) const {
  const std::size_t samples = motion.samples, stride = padded(samples);
  std::vector<std::vector<double>> histories;
  if (mixed(means)) {
    for (FibreHistory& both : fibre_histories(sites, segment, means, motion, scan_.with_shear, worker)) {
      if (scan_.with_shear) count_shear(both);
      histories.push_back(std::move(both.strain));
    }
    return histories;
  }
  std::vector<std::vector<double>> sliding;
  const BundleNesting nesting = site_nesting(sites, segment, means, motion, sliding, worker);
  std::vector<double> strain(sites.size() * stride);
  kernels().node_strains(pointers(nesting), columns_of(sites[0], means, motion), 0, samples, strain.data(), stride);
  for (auto from = strain.begin(); from != strain.end(); from += stride) histories.emplace_back(from, from + samples);
  for (std::size_t k = 0; k < sites.size(); ++k)
    line_of(sites[k], segment, means).add_to(histories[k].data(), angle_of(sites[k]));
  return histories;
}

void Evaluation::list_turns(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                            const SegmentMotion& motion, Worker& worker, std::span<TurningList> lists) const {
  const auto list = [&](std::span<const float> strain, TurningList& to) {
    TurningPoints points(scan_.gate);
    points.next(strain, to);
    points.finish(to);
  };
  if (mixed(means)) {
    const auto histories = histories_of(sites, segment, means, motion, worker);
    std::vector<float> in_single(motion.samples);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      std::ranges::transform(histories[k], in_single.begin(), [](double strain) { return static_cast<float>(strain); });
      list(in_single, lists[k]);
    }
    return;
  }
  std::vector<std::vector<double>> sliding;
  const BundleNesting nesting = site_nesting(sites, segment, means, motion, sliding, worker);
  const int part = construction_.bundles()[wires_[sites[0].wire].bundle].part;
  const BundlePointers from = from_parent(nesting, part, segment, means, motion, worker);
  const std::size_t stride = padded(motion.samples);
  std::vector<float> strain(sites.size() * stride);
  kernels().node_strains_in_single(from, columns_of(sites[0], means, motion), 0, motion.samples, strain.data(), stride);
  for (std::size_t k = 0; k < sites.size(); ++k) {
    line_of(sites[k], segment, means).add_to(strain.data() + k * stride, angle_of(sites[k]));
    list({strain.data() + k * stride, motion.samples}, lists[k]);
  }
}

std::vector<FibreHistory> Evaluation::fibre_histories(std::span<const Site> sites, std::size_t segment,
                                                      const ClampMeans& means, const SegmentMotion& motion,
                                                      bool with_shear, Worker& worker) const {
  std::vector<std::vector<double>> sliding;
  const BundleNesting nesting = site_nesting(sites, segment, means, motion, sliding, worker);
  const int part = construction_.bundles()[wires_[sites[0].wire].bundle].part;
  const BundlePointers from = from_parent(nesting, part, segment, means, motion, worker);
  const std::size_t stride = padded(motion.samples), of_one = ingredients(1) * stride;
  std::vector<double> rows(sites.size() * of_one);
  kernels().node_ingredients(from, columns_of(sites[0], means, motion), 0, motion.samples, rows.data(), stride);
  std::vector<FibreHistory> all;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    line_of(sites[k], segment, means).add_to(rows.data() + k * of_one + mean_strain * stride, angle_of(sites[k]));
    all.push_back(mixed_history(nesting.nodes[k], nesting.fibres[0], means.plan()[wires_[sites[k].wire].layer],
                                rows.data() + k * of_one, motion.samples, with_shear));
    all.back().site = site_row(segment, sites[k]);
  }
  return all;
}

/// Does the work of Kernels::mix for one fibre in double precision. rows: its ingredients.
FibreHistory Evaluation::mixed_history(const WireNode& node, const Fibre& fibre, const LayerSlip& slip,
                                       const double* rows, std::size_t samples, bool with_shear) const {
  const std::size_t stride = padded(samples);
  const double *const means = rows + mean_strain * stride, *const deviations = rows + deviation * stride;
  const double *const bending = rows + first_bending * stride, *const shears = rows + shear * stride;
  const double rest_bending = rest_ingredient(node, &fibre), rest_shear = rest_ingredient(node, nullptr);
  const double fibre_scale = shape_of(fibre, node).scale;
  const bool scales = !is_thesis(construction_.kinematics());
  constexpr double glued = std::numeric_limits<double>::infinity();
  const auto cap = [&](std::size_t t) { return slip.sliding == Sliding::glued ? glued : cap_at(slip.cap, means[t]); };
  const auto slides = [&](std::size_t t) { return (1 - slip.elastic) * deviations[t]; };
  Slider slider(slip.friction ? settled_slip(samples, slides, cap) : 0);
  std::vector<double> held(samples);
  for (std::size_t t = 0; t < samples; ++t) held[t] = slider.next(slides(t), cap(t));
  FibreHistory both{0, std::vector<double>(samples), std::vector<double>(with_shear ? samples : 0)};
  for (std::size_t t = 0; t < samples; ++t) {
    const double mean = means[t], away = deviations[t];
    const double axial = mean + held[t] + slip.elastic * away;
    const double scale = scales ? (1 + axial) / (1 + (mean + away) / slip.radial_share) : 1;
    both.strain[t] = (axial + bending[t] * scale - rest_bending) * fibre_scale;
    if (with_shear) both.shear[t] = std::numbers::sqrt3 * (shears[t] * scale - rest_shear) * fibre_scale;
  }
  return both;
}

/// Returns radius, lay angle and phase of every level down to `part`; 0 for the level of the wires and below.
std::vector<double> Evaluation::helix_of(int part, std::size_t segment) const {
  std::vector<double> helix(3 * place_.levels, 0.0);
  for (int inner = part; inner != dresspack_itself; inner = construction_.parts()[inner].parent) {
    const Part& in = construction_.parts()[inner];
    const Layer& layer = construction_.layers()[in.layer];
    const double phase = construction_.phase(in.layer, in.number, in.parent, places_[segment]);
    std::ranges::copy(std::array{layer.helix_radius, layer.lay_angle, phase}, helix.begin() + 3 * (layer.level - 1));
  }
  return helix;
}

void Evaluation::append_site(SiteRows& rows, Site site, std::size_t segment, const std::vector<double>& helix) const {
  const Wire& wire = wires_[site.wire];
  const Layer& layer = construction_.layers()[wire.layer];
  const int part = construction_.bundles()[wire.bundle].part;
  rows.segment.push_back(static_cast<std::int32_t>(place_.segments_before + place_.first_segment + segment));
  rows.component.push_back(wire.path);
  rows.material.push_back(layer.material);
  rows.helix.insert(rows.helix.end(), helix.begin(), helix.end());
  const double phase = construction_.phase(wire.layer, wire.number, part, places_[segment]);
  std::ranges::copy(std::array{layer.helix_radius, layer.lay_angle, phase},
                    rows.helix.end() - helix.size() + 3 * (layer.level - 1));
  const bool on_axis = scan_.on_axis || layer.is_hose;
  rows.fibre.insert(rows.fibre.end(), {on_axis ? 0 : layer.part_radius, fibre_angle(site.fibre, surface_fibres_)});
}

/// Returns the strains of the appended points.
std::span<const float> Evaluation::append_points(SiteRows& rows, std::span<const TurningPoint> points) {
  const std::size_t first = rows.strain.size();
  rows.turning.push_back(points.size());
  rows.strain.resize(first + points.size());
  rows.sample.resize(first + points.size());
  float* const strain = rows.strain.data() + first;
  std::uint32_t* const sample = rows.sample.data() + first;
  for (std::size_t k = 0; k < points.size(); ++k) {
    strain[k] = points[k].strain;
    sample[k] = points[k].sample;
  }
  return {strain, points.size()};
}

Evaluation::SiteMeasures Evaluation::seen(Site site, const StrainMeasures& of) {
  const float range = of.highest - of.lowest, tension = std::max(0.0f, of.highest);
  SiteMeasures seen{site, {}};
  seen.by[Worst::range] = range;
  seen.by[Worst::size] = std::max(std::abs(of.lowest), std::abs(of.highest));
  seen.by[Worst::tension] = tension;
  seen.by[Worst::range_times_tension] = range * tension;
  seen.by[Worst::cycles] = of.cycle_sum;
  seen.by[Worst::ranges] = of.range_sum;
  seen.by[Worst::yielding_cycles] = -1;  // set only for wires whose planes are evaluated
  return seen;
}

void Evaluation::Worst::consider(const SiteMeasures& seen) {
  for (int measure = 0; measure < measures; ++measure)
    if (seen.by[measure] > value[measure]) {
      value[measure] = seen.by[measure];
      site[measure] = seen.site;
    }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    auto& most = by_sum[k];
    const float sum = seen.by[sums[k]];
    if (most.size() == most_by_sum && sum <= most.back().first) continue;
    most.insert(std::ranges::upper_bound(most, sum, std::greater<>(), &std::pair<float, Site>::first),
                {sum, seen.site});
    if (most.size() > most_by_sum) most.pop_back();
  }
}

std::vector<Evaluation::Worst> Evaluation::worst_of(std::size_t segment, const ClampMeans& means,
                                                    const SegmentMotion& motion,
                                                    const std::function<void(const SiteRows&)>& sink) {
  std::vector<Worst> worst(construction_.layers().size());
  scan_bundles(segment, means, motion, sink != nullptr, [&](const BundleSites& bundle) {
    for (const SiteMeasures& seen : bundle.seen) worst[wires_[seen.site.wire].layer].consider(seen);
    if (sink) sink(bundle.rows);
  });
  return worst;
}

std::vector<const Evaluation::Worst*> Evaluation::of_wires(const std::vector<Worst>& worst) const {
  std::vector<const Worst*> wires;
  for (std::size_t layer = 0; layer < worst.size(); ++layer)
    if (!construction_.layers()[layer].is_hose && worst[layer].value[Worst::range] >= 0) wires.push_back(&worst[layer]);
  return wires;
}

void Evaluation::find_likely(const std::vector<const Worst*>& wires) {
  likely_.clear();
  const auto kind_of = [&](const Worst* worst) {  // its failure mode and what its wires withstand
    const Layer& wire = construction_.layers()[wires_[worst->site[Worst::range].wire].layer];
    const Layer* outermost = &wire;
    while (outermost->parent != dresspack_itself) outermost = &construction_.layers()[outermost->parent];
    return std::pair<std::string_view, std::string_view>(outermost->name, wire.material);
  };
  std::map<std::pair<std::string_view, std::string_view>, float> most;
  for (const Worst* const layer : wires) {
    float& of = most[kind_of(layer)];
    of = std::max(of, layer->value[Worst::cycles]);
  }
  constexpr float near =
      1e-2f;  // share of a sum of sixth powers: layers with less than half of the largest strain are dropped
  for (const Worst* const layer : wires) {
    if (layer->value[Worst::cycles] < near * most[kind_of(layer)]) continue;
    for (const Worst::By by : {Worst::range, Worst::range_times_tension}) likely_.push_back(layer->site[by]);
    constexpr std::size_t by_cycles = 2;
    const auto& list = layer->by_sum.front();
    for (std::size_t k = 0; k < std::min(by_cycles, list.size()); ++k) likely_.push_back(list[k].second);
  }
  std::ranges::sort(likely_);
  likely_.erase(std::unique(likely_.begin(), likely_.end()), likely_.end());
}

std::vector<Evaluation::Site> Evaluation::sites_to_probe(const std::vector<const Worst*>& wires, std::size_t segment) {
  std::vector<Site> sites;
  const auto of_range =
      std::ranges::max_element(wires, {}, [](const Worst* layer) { return layer->value[Worst::range]; });
  if (of_range != wires.end()) {
    const Worst& widest = **of_range;
    sites.push_back(widest.site[Worst::range]);
    if (widest.value[Worst::range] > worst_range_) {
      worst_range_ = widest.value[Worst::range];
      worst_ = widest.site[Worst::range];
      worst_segment_ = segment;
    }
  }
  // Two of each sum: in three of the four shipped programs the wire with the largest damage is among them, in the fourth it is
  // the 19th by cycles.
  constexpr std::size_t by_sum = 2;
  for (std::size_t sum = 0; sum < Worst::sums.size(); ++sum) {
    std::vector<std::pair<float, Site>> most;
    for (const Worst* const layer : wires) {
      const auto& list = layer->by_sum[sum];
      most.insert(most.end(), list.begin(), list.begin() + static_cast<std::ptrdiff_t>(std::min(by_sum, list.size())));
    }
    std::ranges::stable_sort(most, std::greater(), &std::pair<float, Site>::first);
    most.resize(std::min(by_sum, most.size()));
    for (const auto& [value, site] : most)
      if (value > 0 && std::ranges::find(sites, site) == sites.end()) sites.push_back(site);
  }
  for (const auto& [at, site] : probes_)
    if (at == segment) sites.push_back(site);
  return sites;
}

void Evaluation::evaluate(std::size_t segment, const DeformationHistory& history, std::size_t row, const Sink& sink) {
  end_first_pass();
  const SegmentMotion& motion = motion_at_wires(segment, history, row);
  for (Worker& worker : workers_) worker.held[0]->begin(places_[segment], motion);
  const std::vector<Worst> worst = worst_of(segment, means_, motion, sink.sites);
  for (Bound* bound : {&stick_, &free_}) {
    const bool same = bound->means.plan() == means_.plan() && bound->means.lines() == means_.lines();
    const std::vector<Site> sites = sites_of_bound(same ? worst : worst_of(segment, bound->means, motion, {}), *bound);
    put_bound(sites, bound->means, segment, motion, bound == &stick_ ? sink.bound_stick : sink.bound_free);
  }
  const std::vector<const Worst*> wires = of_wires(worst);
  find_likely(wires);
  put_probes(sites_to_probe(wires, segment), segment, motion, sink);
  if (!with_planes_) return;
  std::set<Site> likely;
  for (const Worst* const layer : wires)
    for (int by = 0; by < Worst::measures; ++by)
      if (layer->value[by] >= 0) likely.insert(layer->site[by]);
  const std::vector<Site> list(likely.begin(), likely.end());
  std::vector<FibreHistory> found(workers_.size());
  pipeline::in_order(
      workers_.size(), list.size(), found.size(),
      [&](std::size_t part, std::size_t k) {
        found[k % found.size()] = fibre_histories({&list[k], 1}, segment, means_, motion, true, workers_[part])[0];
      },
      [&](std::size_t k) { sink.fibre(found[k % found.size()]); });
}

std::vector<Evaluation::Worst> Evaluation::worst_of_bent(std::size_t segment, const DeformationHistory& history,
                                                         std::size_t row) {
  std::vector<Worst> worst(construction_.layers().size());
  const std::vector<int> cables = cables_.bent_most(segment);
  if (cables.empty()) return worst;
  end_first_pass();
  const SegmentMotion& motion = motion_at_wires(segment, history, row);
  Worker& worker = workers_[0];
  worker.held[0]->begin(places_[segment], motion);
  worker.parent_is = {};
  BundleSites found;
  for (std::size_t b = 0; b < construction_.bundles().size(); ++b) {
    const std::vector<int> line = construction_.ancestry(construction_.bundles()[b].part);
    if (std::ranges::find_first_of(line, cables) == line.end()) continue;
    scan_bundle(b, segment, means_, motion, false, worker, found);
    for (const SiteMeasures& seen : found.seen) worst[wires_[seen.site.wire].layer].consider(seen);
  }
  return worst;
}

const std::vector<Evaluation::Site>& Evaluation::likely_of_bent(std::size_t segment, const DeformationHistory& history,
                                                                std::size_t row) {
  if (segment < likely_of_bent_.size()) return likely_of_bent_[segment];
  find_likely(of_wires(worst_of_bent(segment, history, row)));
  return likely_;
}

float Evaluation::damage_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row) {
  const std::vector<Worst> worst = worst_of_bent(segment, history, row);
  find_likely(of_wires(worst));
  likely_of_bent_.push_back(likely_);
  float most = 0;
  for (const Worst& layer : worst) most = std::max(most, layer.value[Worst::cycles]);
  return most;
}

void Evaluation::put_probes(const std::vector<Site>& sites, std::size_t segment, const SegmentMotion& motion,
                            const Sink& sink) {
  std::vector<Probe> found(workers_.size());
  const auto probe = [&](Site site, Worker& worker) -> Probe {
    FibreHistory both = std::move(fibre_histories({&site, 1}, segment, means_, motion, true, worker)[0]);
    if (!mixed(means_))
      both.strain = std::move(histories_of({&site, 1}, segment, means_, motion, worker)[0]);
    else if (scan_.with_shear)
      count_shear(both);
    return {site_row(segment, site), std::move(both.strain), std::move(both.shear)};
  };
  pipeline::in_order(
      workers_.size(), sites.size(), found.size(),
      [&](std::size_t part, std::size_t k) { found[k % found.size()] = probe(sites[k], workers_[part]); },
      [&](std::size_t k) { sink.probe(found[k % found.size()]); });
}

std::vector<Evaluation::Site> Evaluation::sites_of_bound(const std::vector<Worst>& worst, Bound& bound) const {
  constexpr float nearly =
      0.7f;  // in the free bound hundreds of wires have sums this near the largest, and any of them can be the worst
  bound.most.resize(worst.size());
  std::set<Site> sites;
  for (std::size_t k = 0; k < worst.size(); ++k) {
    for (int by = 0; by < Worst::measures; ++by)
      if (worst[k].value[by] >= 0) sites.insert(worst[k].site[by]);
    for (std::size_t sum = 0; !bound.own && sum < Worst::sums.size(); ++sum) {
      const auto& list = worst[k].by_sum[sum];
      float& most = bound.most[k][sum];
      if (!list.empty()) most = std::max(most, list.front().first);
      for (std::size_t i = 0; i < list.size(); ++i)
        if (i < Worst::always_by_sum || list[i].first >= nearly * most) sites.insert(list[i].second);
    }
  }
  return {sites.begin(), sites.end()};
}

void Evaluation::put_bound(const std::vector<Site>& list, const ClampMeans& means, std::size_t segment,
                           const SegmentMotion& motion, const std::function<void(const SiteRows&)>& sink) {
  const std::vector<TurningList> turning = std::move(turning_of(list, segment, {&means}, motion)[0]);
  SiteRows rows;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const int part = construction_.bundles()[wires_[list[k].wire].bundle].part;
    append_site(rows, list[k], segment, helix_of(part, segment));
    append_points(rows, turning[k].points());
  }
  sink(rows);
}

std::vector<std::vector<TurningList>> Evaluation::turning_of(const std::vector<Site>& list, std::size_t segment,
                                                             const std::vector<const ClampMeans*>& ways,
                                                             const SegmentMotion& motion) {
  std::vector<std::size_t> cuts;  // indices at which the fibre or the bundle changes: one nesting serves a whole piece
  const auto piece = [&](std::size_t k) { return std::pair(list[k].fibre, wires_[list[k].wire].bundle); };
  for (std::size_t k = 0; k < list.size(); ++k)
    if (k == 0 || piece(k) != piece(k - 1)) cuts.push_back(k);
  cuts.push_back(list.size());
  std::vector<std::vector<TurningList>> turning(ways.size());
  for (std::vector<TurningList>& of_way : turning) of_way.resize(list.size());
  for (Worker& worker : workers_) worker.parent_is = {};
  std::atomic<std::size_t> next = 0;
  pipeline::in_parallel(workers_.size(), [&](std::size_t part) {
    for (std::size_t cut = next++; cut + 1 < cuts.size(); cut = next++) {
      const std::size_t first = cuts[cut], count = cuts[cut + 1] - first;
      for (std::size_t way = 0; way < ways.size(); ++way)
        list_turns(std::span(list).subspan(first, count), segment, *ways[way], motion, workers_[part],
                   std::span(turning[way]).subspan(first, count));
    }
  });
  return turning;
}

std::vector<SiteRows> Evaluation::varied(const std::vector<Site>& sites, const std::vector<double>& factors,
                                         std::size_t segment, const DeformationHistory& history, std::size_t row) {
  end_first_pass();
  const SegmentMotion& motion = motion_at_wires(segment, history, row);
  std::vector<const ClampMeans*> ways;
  for (const double factor : factors) ways.push_back(&means_rubbing(factor));
  for (Worker& worker : workers_)
    for (const ClampMeans* const means : ways) held_of(*means, worker)->begin(places_[segment], motion);
  std::vector<SiteRows> all;
  for (const std::vector<TurningList>& of_way : turning_of(sites, segment, ways, motion)) {
    SiteRows& rows = all.emplace_back();
    for (const TurningList& turning : of_way) append_points(rows, turning.points());
  }
  return all;
}

const ClampMeans& Evaluation::means_rubbing(double factor) {
  if (factor == 1) return means_;
  for (const auto& [known, means] : rubbing_)
    if (known == factor) return *means;
  ClampMeans means = means_.rubbing(factor);
  if (!line_layers_.empty())
    factor == ClampMeans::glued ? means.set_lines({}, nullptr)
                                : means.set_lines(line_layers_, lines_rubbing(factor, plan_of_lines_, line_layers_));
  rubbing_.emplace_back(factor, std::make_unique<const ClampMeans>(std::move(means)));
  add_held(*rubbing_.back().second);
  return *rubbing_.back().second;
}

}  // namespace dresslife::strain
