// Strain histories of every wire in every segment, their turning points, bounds and probes ((W10) to (W15) in
// strain/theory.md).
//
// The motion is passed twice. The first pass (`add`) takes blocks of samples of all segments and computes the means of the
// parts that slide from clamp to clamp. The second pass (`evaluate`) computes one segment over its whole history, bundle by
// bundle, in blocks of samples that stay in cache. Results go to a Sink as soon as they are computed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "strain/bundle_scan.h"
#include "strain/cable_paths.h"
#include "strain/friction.h"
#include "strain/net_bend.h"
#include "strain/part_states.h"

namespace dresslife::strain {

/// Sites with their turning points: rows of strain.h5.
struct SiteRows {
  std::vector<std::int32_t> segment;
  std::vector<std::string> component;
  std::vector<double> helix;  ///< (site, level, 3) radius [m], lay angle [rad], phase [rad]
  std::vector<double> fibre;  ///< (site, 2) radius [m], angle [rad]
  std::vector<std::string> material;
  std::vector<std::uint64_t> turning;  ///< (site) number of turning points
  std::vector<float> strain;           ///< turning points of all sites, one site after the other
  std::vector<std::uint32_t> sample;

  void clear();
};

struct Probe {
  std::size_t site;            ///< row among the job's own sites
  std::vector<double> strain;  ///< (sample) equivalent strain, as the turning points are found on it
  std::vector<double> shear;   ///< (sample) gamma of the surface, from the wire's torsion
};

/// Strain and shear of one fibre. The evaluation of planes needs both.
struct FibreHistory {
  std::size_t site;                   ///< row among the job's own sites
  std::vector<double> strain, shear;  ///< (sample) strain along the fibre, and gamma
};

/// Receives the results. The rows are valid until the called function returns.
struct Sink {
  std::function<void(const SiteRows&)> sites, bound_stick, bound_free;
  std::function<void(const Probe&)> probe;
  std::function<void(const FibreHistory&)> fibre;  ///< the worst wires by each measure; for critical_plane only
};

/// Position of the evaluated segments in the dresspack: one span between two clamps. Both clamps hold the parts that slide.
struct SpanPlace {
  std::size_t first_segment = 0;    ///< index in its dresspack
  std::size_t segments_in_all = 0;  ///< number of segments of its dresspack; 0: the span is the whole dresspack
  double first_arc = 0;             ///< arc of the span's base end, from the dresspack's base clamp [m]
  double clamped_length =
      0;  ///< length of a rig's cable, of which the span is a part [m]; 0: the span is the whole cable
  bool free_tool_end = false;  ///< no clamp holds the tool end
  KnownEnds known_ends{};
  std::array<double, 2> relief_stiffness{};  ///< see CablesInJob
  double stiffness_factor = 1;               ///< see CablesInJob
  // Sums over the dresspacks before this one in the file:
  std::size_t segments_before = 0, sites_before = 0;
  std::size_t dresspack = 0;
  std::string
      name{};  ///< name of its dresspack among several, with which the paths of its wires begin; empty: one dresspack
  int levels = 0;  ///< levels of the file's helix table; 0: those of the construction
};

class Evaluation {
 public:
  /// A fibre of a wire, in any segment.
  struct Site {
    std::size_t wire = 0;
    int fibre = 0;
    auto operator<=>(const Site&) const = default;
  };

  /// lengths: rest lengths of the segments [m]. threads: number of threads that share the bundles of a segment; the result
  /// does not depend on it. Errors: InputError for a probe that names no existing wire or segment.
  Evaluation(const Construction& construction, const pipeline::Strain& settings, std::vector<double> lengths,
             std::size_t samples, std::size_t threads = 1, const SpanPlace& place = {}, const Scratch& scratch = {});

  std::size_t segments() const { return lengths_.size(); }
  const std::vector<double>& lengths() const { return lengths_; }  ///< (segment) [m]
  const std::vector<double>& arcs() const {
    return arcs_;
  }  ///< (segment) arc of the centre from the dresspack's base clamp [m]
  /// (segment) arc from the dresspack's base clamp at which its wires are evaluated [m].
  const std::vector<double>& places() const { return places_; }
  std::size_t sites() const {
    return place_.segments_in_all * wires_.size() * scan_.fibre_count;
  }  ///< number of sites of the dresspack
  std::size_t sites_so_far() const {
    return place_.sites_before + sites();
  }  ///< number of sites of the file up to the end of this dresspack

  std::size_t longest_path() const;  ///< longest path of a site's component [bytes]
  std::size_t longest_material() const;
  /// Returns one line on the site with the largest strain range so far. sites: number of sites of the file.
  std::string summary(std::size_t sites) const;
  /// Returns the memory [bytes] of the strains that friction holds; it grows with the motion.
  std::size_t held_bytes() const { return workers_.size() * workers_[0].held[0]->bytes(samples_); }
  float worst_range() const { return worst_range_; }

  /// First pass. Takes the blocks in order of time.
  void add(const SpanBlock& block);
  /// Adds a block to several evaluations of one span and computes their loose cables side by side. Each result is that of a
  /// call with one evaluation. Precondition: `all` contains every evaluation that shares loose cables with one of `all`.
  static void add(std::span<Evaluation* const> all, const SpanBlock& block);
  /// Moves the loose cables through samples before the first one (CablePaths::lead_in()).
  static void lead_in(std::span<Evaluation* const> all, const SpanBlock& block);
  static void end_repeat(std::span<Evaluation* const> all, double further);  ///< see CablePaths
  /// Forgets the samples of add() but not where the loose cables are (CablePaths::repeat()).
  void repeat();
  /// Takes a block that add() does not receive, because a part of the motion that is equal to it stands for it.
  void leave_out(const SpanBlock& block) { add_bends(block.deformation); }
  std::size_t samples() const { return samples_; }  ///< that add() receives
  /// Returns whether the strains of cables depend on the past through clamps and friction, and parts slide in these cables from
  /// clamp to clamp. Then all blocks must be given to add_again() after all have been given to add().
  bool wants_again() const {
    return cables_.remembers() && (means_.needed() || stick_.means.needed() || free_.means.needed());
  }
  void add_again(const DeformationHistory& block);
  bool any_loose() const { return cables_.any_loose(); }
  bool any_cables() const { return cables_.any(); }
  /// Returns the cable's name as in a site's path: behind the name of the dresspack if the file has several.
  std::string name_of_cable(std::size_t cable) const {
    return (place_.name.empty() ? "" : place_.name + "/") + cables_.name(cable);
  }
  /// Returns the path of a layer without numbers: "signal cable/conductor/layer 1/wire".
  std::string name_of_layer(int layer) const;
  std::size_t dresspack() const { return place_.dresspack; }
  /// See CablePaths. Call share_loose(), record_rubbing() and wind() before the first sample.
  void share_loose(const Evaluation& other) { cables_.share_loose(other.cables_); }
  void record_rubbing() { cables_.record_rubbing(); }
  /// Returns paths and forces of the cables. Precondition: end_first_pass() or evaluate(), which calls it.
  const CablePaths& cables() const { return cables_; }
  void wind(std::uint64_t seed) { cables_.wind(seed); }
  void find_bent() { cables_.find_bent(); }  ///< see CablePaths
  void go_on_from(const Evaluation& other) { cables_.go_on_from(other.cables_); }
  void end_first_pass();
  /// bend_wave: least length over which the curvature of the hose and its cables changes, see bend_wave(); infinite: no bend, or an
  /// even one. layer: of the layers on which friction has an effect, the one whose strain evens out over the
  /// greatest length; -1: none. longest: this length (LayerSlip::evening) [m]. straight: this layer evens out from clamp to clamp,
  /// because it has no lay. own_lay: it evens out over its own lay.
  struct BendScale {
    double bend_wave = HUGE_VAL, longest = 0;
    int layer = -1;
    bool straight = false, own_lay = false;
  };
  const BendScale& evening() const { return evening_; }
  /// Returns the strain that bends of incomplete turns would cause, and that a layer which slides over its pitch lacks. Call
  /// record_net_bend() before the first sample.
  NetBend::Largest net_bend() const { return net_bend_.value().largest(line_layers_); }
  void record_net_bend();

  /// Second pass. Evaluates segment `segment` of the span, whose history is `row` of `history`. Call in the order of
  /// the segments.
  void evaluate(std::size_t segment, const DeformationHistory& history, std::size_t row, const Sink& sink);

  /// Returns whether friction holds any strain inside the cables.
  bool rubs_inside() const;
  /// Returns the sites that can have the largest damage of the segment among the wires of one material in the components of one
  /// name, whatever the other inputs.
  /// Precondition: evaluate() was called for this segment last.
  const std::vector<Site>& likely_worst() const { return likely_; }
  /// Returns the likely worst sites at a rest that is not the job's own. Scans only the cables that bend most. Precondition: find_bent().
  /// Segments as in varied().
  const std::vector<Site>& likely_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Returns the largest sum over turning points of (range times tensile peak)^3 of the cables that bend most, which compares the
  /// rests of one job. Call in the order of the segments; likely_of_bent() then returns the wires of this scan.
  float damage_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Returns site rows and turning points of `sites`, in their order, with friction times each of `factors`: (factor). Segments
  /// as in evaluate(). An evaluation with other slack, play or grips does not need evaluate() before.
  std::vector<SiteRows> varied(const std::vector<Site>& sites, const std::vector<double>& factors, std::size_t segment,
                               const DeformationHistory& history, std::size_t row);
  /// Returns the row of a site among the file's own sites.
  std::size_t row_of(std::size_t segment, Site site) const { return site_row(segment, site); }

 private:
  struct Wire {  ///< one wire of the construction; sites are segment x wire x fibre
    int bundle, layer, number;
    std::string path;
  };
  /// The sites of one wire layer of the construction, over all its bundles, with the largest values of several measures. The
  /// material and the mean-stress correction decide which of them has the shortest life.
  struct SiteMeasures;
  struct Worst {
    enum By { range, size, tension, range_times_tension, cycles, ranges, yielding_cycles, measures };
    std::array<Site, measures> site;
    std::array<float, measures> value{-1, -1, -1, -1, -1, -1, -1};
    /// Sites with the largest sums over cycles and over ranges, the largest first. If a history has many cycles of medium range,
    /// the sums are not accurate enough to find the worst site, therefore several sites are kept.
    static constexpr std::array<By, 2> sums{cycles, ranges};
    static constexpr std::size_t always_by_sum = 12, most_by_sum = 128;
    std::array<std::vector<std::pair<float, Site>>, sums.size()> by_sum;
    void consider(const SiteMeasures& seen);
  };
  struct SiteMeasures {
    Site site;
    std::array<float, Worst::measures> by;
  };
  /// A bound: one manner of sliding of all levels and its data.
  struct Bound {
    ClampMeans means;
    /// Every level of the job slips as in this bound. Then the job's own sites are the bound, and the worst wire does not need
    /// the list.
    bool own;
    std::vector<std::array<float, Worst::sums.size()>> most{};  ///< (layer) the largest sums of the segments so far
  };

  /// Identifies the part whose states a worker holds for the parts inside it.
  struct ParentKey {
    int part = -1, order = 0;           ///< order 0: no states yet
    const ClampMeans* means = nullptr;  ///< the job's own means if the friction makes no difference
    bool operator==(const ParentKey&) const = default;
  };
  /// Data that one thread keeps from bundle to bundle.
  struct Worker {
    BundleScan scan;
    PartStates parent;
    ParentKey parent_is;  ///< part of `parent`, in the present run
    /// Of the present segment: first for the job's own slip, then for other friction factors.
    std::vector<std::unique_ptr<HeldStrains>> held;
    std::shared_ptr<PartDeviations> deviations = std::make_shared<PartDeviations>();
  };
  /// The sites of one bundle, wire by wire.
  struct BundleSites {
    SiteRows rows;
    std::vector<SiteMeasures> seen;
  };

  /// Returns the motion of a segment where its wires are evaluated; valid until the next call. Segments as in evaluate().
  const SegmentMotion& motion_at_wires(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Returns whether strains are composed wire by wire: in layers with friction, and in all layers when shear counts.
  bool mixed(const ClampMeans& means) const;
  void add_bends(const DeformationHistory& block);
  void keep_bends(const SpanBlock& block);
  void find_lines();
  BentCables bent_cables() const;
  /// Returns the strain of the layers in long waves with `factor` times the friction.
  std::shared_ptr<const LongWaves> lines_rubbing(double factor, const std::vector<LayerSlip>& plan,
                                                 const std::vector<int>& layers) const;
  /// Returns one entry per wire layer of the bundle; empty: no layer lies in long waves.
  std::vector<LineWave> lines_of(const Bundle& bundle, std::size_t segment, const ClampMeans& means) const;
  LineWave line_of(Site site, std::size_t segment, const ClampMeans& means) const;
  double angle_of(Site site) const;
  void add_means(const DeformationHistory& block);
  /// Returns the strains that friction holds under these means; null: none.
  HeldStrains* held_of(const ClampMeans& means, Worker& worker) const;
  void add_held(const ClampMeans& means);
  /// Returns whether friction holds any strain of `part` or of a part that contains it.
  bool holds_down_to(int part, const ClampMeans& means) const;
  const ClampMeans& means_rubbing(double factor);
  /// Returns the turning points of the sites under each of several means: (means, site).
  std::vector<std::vector<TurningList>> turning_of(const std::vector<Site>& list, std::size_t segment,
                                                   const std::vector<const ClampMeans*>& ways,
                                                   const SegmentMotion& motion);
  const DeformationColumns& columns_of(Site site, const ClampMeans& means, const SegmentMotion& motion) const;
  void find_probes(const std::vector<pipeline::ProbeRequest>& probes);
  BundleNesting part_nesting(int part, std::size_t segment, const ClampMeans& means, const SegmentMotion& motion,
                             const std::vector<Fibre>& fibres, Worker& worker) const;
  BundleNesting layer_nesting(const Bundle& bundle, std::size_t segment, const ClampMeans& means,
                              const SegmentMotion& motion, Worker& worker) const;
  void scan_bundle(std::size_t bundle, std::size_t segment, const ClampMeans& means, const SegmentMotion& motion,
                   bool with_rows, Worker& worker, BundleSites& out) const;
  /// Calls use() for every bundle, in order. The threads share the work.
  void scan_bundles(std::size_t segment, const ClampMeans& means, const SegmentMotion& motion, bool with_rows,
                    const std::function<void(const BundleSites&)>& use);
  /// Returns the nesting to `part`. Starts from the states of its parent if they suffice.
  BundlePointers from_parent(const BundleNesting& nesting, int part, std::size_t segment, const ClampMeans& means,
                             const SegmentMotion& motion, Worker& worker) const;
  /// Returns whole histories, in double precision, of sites of one bundle and one fibre.
  std::vector<std::vector<double>> histories_of(std::span<const Site> sites, std::size_t segment,
                                                const ClampMeans& means, const SegmentMotion& motion,
                                                Worker& worker) const;
  /// Writes the turning points of sites of one bundle and one fibre, in single precision.
  void list_turns(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                  const SegmentMotion& motion, Worker& worker, std::span<TurningList> lists) const;
  /// Returns the strain along the fibre and, if wanted, the shear of sites of one bundle and one fibre, in double precision.
  std::vector<FibreHistory> fibre_histories(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                                            const SegmentMotion& motion, bool with_shear, Worker& worker) const;
  FibreHistory mixed_history(const WireNode& node, const Fibre& fibre, const LayerSlip& slip, const double* rows,
                             std::size_t samples, bool with_shear) const;
  /// Returns the nesting to sites of one bundle and one fibre, which are its nodes. sliding: receives the clamp means to which
  /// the nodes point.
  BundleNesting site_nesting(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                             const SegmentMotion& motion, std::vector<std::vector<double>>& sliding,
                             Worker& worker) const;
  std::size_t site_row(std::size_t segment, Site site) const {
    return place_.sites_before + ((place_.first_segment + segment) * wires_.size() + site.wire) * scan_.fibre_count +
           site.fibre;
  }
  std::vector<double> helix_of(int part, std::size_t segment) const;
  void append_site(SiteRows& rows, Site site, std::size_t segment, const std::vector<double>& helix) const;
  static std::span<const float> append_points(SiteRows& rows, std::span<const TurningPoint> points);
  static SiteMeasures seen(Site site, const StrainMeasures& of);
  /// Returns the wire layers of which any wire was evaluated; without the hose's wall.
  std::vector<const Worst*> of_wires(const std::vector<Worst>& worst) const;
  void find_likely(const std::vector<const Worst*>& wires);
  std::vector<Worst> worst_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Returns the site with the largest range, the sites with the largest sums and the sites that the job names. The site with
  /// the largest range so far becomes that of summary().
  std::vector<Site> sites_to_probe(const std::vector<const Worst*>& wires, std::size_t segment);
  /// Returns the worst sites of every wire layer. sink: receives all sites; may be empty.
  std::vector<Worst> worst_of(std::size_t segment, const ClampMeans& means, const SegmentMotion& motion,
                              const std::function<void(const SiteRows&)>& sink);
  void put_probes(const std::vector<Site>& sites, std::size_t segment, const SegmentMotion& motion, const Sink& sink);
  std::vector<Site> sites_of_bound(const std::vector<Worst>& worst, Bound& bound) const;
  void put_bound(const std::vector<Site>& sites, const ClampMeans& means, std::size_t segment,
                 const SegmentMotion& motion, const std::function<void(const SiteRows&)>& sink);

  const Construction& construction_;
  SpanPlace place_;
  std::vector<double> lengths_, arcs_;
  std::vector<double>
      places_;  ///< (segment) arc at which its wires are evaluated: arcs_, or the arc of a known end [m]
  std::size_t samples_;
  std::vector<Fibre> fibres_;
  int surface_fibres_;
  ScanSettings scan_;
  bool with_planes_;
  ClampMeans means_;
  Bound stick_, free_;
  std::vector<std::pair<double, std::unique_ptr<const ClampMeans>>>
      rubbing_;  ///< means with other friction, by their friction factor
  std::vector<Site> likely_;
  std::vector<std::vector<Site>> likely_of_bent_;  ///< (segment), where damage_of_bent() was called
  CablePaths cables_;
  CablePaths::Keeper keeper_;
  CablePaths::Keeper keeper_at_wires_;
  const SegmentMotion* at_wires_ = nullptr;  ///< null: none yet
  std::size_t at_wires_segment_ = 0, at_wires_row_ = 0;
  /// Variance over the samples of a vector.
  struct Variance {
    std::array<double, 2> sum{};
    double squares = 0, count = 0;
    void add(const std::array<double, 2>& value) {
      for (const int k : {0, 1}) sum[k] += value[k], squares += value[k] * value[k];
      ++count;
    }
    double variance() const { return (squares - (sum[0] * sum[0] + sum[1] * sum[1]) / count) / count; }
  };
  std::vector<Variance> bends_;  ///< (segment, 2) curvature, and its difference to that of the next segment
  std::optional<NetBend> net_bend_;
  std::vector<int> line_layers_;           ///< layers of wires that slide as lines (W45)
  std::vector<LayerSlip> plan_of_lines_;   ///< the job's own, without lines
  std::optional<SegmentRows> hose_bends_;  ///< curvature about d1 and d2 at base end, segments, tool end [1/m]
  Scratch scratch_;
  bool first_pass_ended_ = false;
  BendScale evening_;
  std::size_t meant_ = 0;                ///< number of samples that the means have received
  std::vector<Worker> workers_;          ///< one per thread
  std::vector<BundleSites> found_;       ///< bundles that are being scanned or wait to be used
  std::vector<Wire> wires_;              ///< bundle by bundle
  std::vector<std::size_t> first_wire_;  ///< (bundle) its first wire
  Site worst_;
  std::size_t worst_segment_ = 0;
  float worst_range_ = -1;
  std::vector<std::pair<std::size_t, Site>> probes_;  ///< (segment of the span, site) named by the job
};

}  // namespace dresslife::strain
