// Every wire of every segment: strain histories, their turning points, bounds and probes (README W10 to W15).
//
// Two passes over the motion: the first (`add`) gathers what slides from clamp to clamp, from blocks of
// samples with all segments; the second (`evaluate`) runs each segment over its whole history, bundle by
// bundle in blocks of samples that stay in cache. Results leave through a Sink as they arise.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "strain/bundle_scan.h"
#include "strain/cable_paths.h"
#include "strain/friction.h"
#include "strain/part_states.h"

namespace dresslife::strain {

/// Sites with their turning points, as rows of strain.h5.
struct SiteRows {
  std::vector<std::int32_t> segment;
  std::vector<std::string> component;
  std::vector<double> helix;  ///< (site, level, 3) radius [m], lay angle [rad], phase [rad]
  std::vector<double> fibre;  ///< (site, 2) radius [m], angle [rad]
  std::vector<std::string> material;
  std::vector<std::uint64_t> turning;  ///< (site) how many turning points
  std::vector<float> strain;           ///< of all sites' turning points
  std::vector<std::uint32_t> sample;

  void clear();
};

struct Probe {
  std::size_t site;            ///< row of the job's own sites
  std::vector<double> strain;  ///< (sample) as it is counted
  std::vector<double> shear;   ///< (sample) gamma of the surface, by the wire's torsion
};

/// The strains of a fibre: both are needed to judge planes.
struct FibreHistory {
  std::size_t site;                   ///< row of the job's own sites
  std::vector<double> strain, shear;  ///< (sample) along the fibre, and gamma
};

/// Where results go. Rows are the sink's to read until it returns.
struct Sink {
  std::function<void(const SiteRows&)> sites, bound_stick, bound_free;
  std::function<void(const Probe&)> probe;
  std::function<void(const FibreHistory&)> fibre;  ///< of the likely worst wires, for critical_plane only
};

/// Where the evaluated segments lie: a span between two clamps, which holds what slides at both its ends.
struct SpanPlace {
  std::size_t first_segment = 0;    ///< in its dresspack
  std::size_t segments_in_all = 0;  ///< of its dresspack; 0: the span is all
  double first_arc = 0;             ///< of the span's base end, from the dresspack's base clamp [m]
  double clamped_length = 0;        ///< of a rig's cable, of which the span is a part [m]; 0: the span is all
  bool free_tool_end = false;       ///< no clamp holds it there
  KnownEnds known_ends{};
  std::array<double, 2> relief_stiffness{};  ///< as CablesInJob
  // Of the dresspacks before it in the file:
  std::size_t segments_before = 0, sites_before = 0;
  std::size_t dresspack = 0;
  std::string name{};  ///< of its dresspack among several: begins the paths of its wires; empty: the only one
  int levels = 0;      ///< of the file's helix table; 0: of the construction
};

class Evaluation {
 public:
  /// Of one segment.
  struct Site {
    std::size_t wire = 0;
    int fibre = 0;
    auto operator<=>(const Site&) const = default;
  };

  /// lengths: rest lengths of the segments [m]. threads: share the bundles of a segment; any number gives the
  /// same. Errors: InputError for a probe that names no wire or no segment.
  Evaluation(const Construction& construction, const pipeline::Strain& settings, std::vector<double> lengths,
             std::size_t samples, std::size_t threads = 1, const SpanPlace& place = {},
             const Scratch& scratch = {});

  std::size_t segments() const { return lengths_.size(); }
  const std::vector<double>& lengths() const { return lengths_; }  ///< (segment) [m]
  const std::vector<double>& arcs() const { return arcs_; }  ///< (segment) of centres from the dresspack's base clamp [m]
  /// (segment) arc from the dresspack's base clamp at which its wires are evaluated [m].
  const std::vector<double>& places() const { return places_; }
  std::size_t sites() const {
    return place_.segments_in_all * wires_.size() * scan_.fibre_count;
  }  ///< of the dresspack
  std::size_t sites_so_far() const {
    return place_.sites_before + sites();
  }  ///< of the file, with this dresspack

  std::size_t longest_path() const;  ///< of a site's component [bytes]
  std::size_t longest_material() const;
  /// One line on the site with the largest strain range so far; sites: of the file.
  std::string summary(std::size_t sites) const;
  /// Memory for what friction holds, which grows with the motion.
  std::size_t held_bytes() const { return workers_.size() * workers_[0].held[0]->bytes(samples_); }
  float worst_range() const { return worst_range_; }

  /// First pass, in order of time.
  void add(const SpanBlock& block);
  /// The same for several of one span, whose loose cables go side by side: each gets what it would get alone. All that
  /// share loose cables are among them.
  static void add(std::span<Evaluation* const> all, const SpanBlock& block);
  /// Samples before the first one, for loose cables (CablePaths::rehearse()).
  static void rehearse(std::span<Evaluation* const> all, const SpanBlock& block);
  /// Whether cables remember what clamps and friction did, so that what goes on in them has to wait: the
  /// blocks are then wanted once more, when all have been added.
  bool wants_again() const {
    return cables_.remembers() && (means_.needed() || stick_.means.needed() || free_.means.needed());
  }
  void add_again(const DeformationHistory& block);
  bool any_loose() const { return cables_.any_loose(); }
  bool any_cables() const { return cables_.any(); }
  /// As in a site's path: with the dresspack's name before it where there are several.
  std::string name_of_cable(std::size_t cable) const {
    return (place_.name.empty() ? "" : place_.name + "/") + cables_.name(cable);
  }
  /// The same of a layer, without numbers: "signal cable/conductor/layer 1/wire".
  std::string name_of_layer(int layer) const;
  std::size_t dresspack() const { return place_.dresspack; }
  /// What the cables do. Precondition: end_first_pass(), or evaluate(), which does the same.
  /// Before the first sample, see CablePaths.
  void share_loose(const Evaluation& other) { cables_.share_loose(other.cables_); }
  void record_rubbing() { cables_.record_rubbing(); }
  const CablePaths& cables() const { return cables_; }
  void wind(std::uint64_t seed) { cables_.wind(seed); }
  void find_bent() { cables_.find_bent(); }  ///< see CablePaths
  void go_on_from(const Evaluation& other) { cables_.go_on_from(other.cables_); }
  void end_first_pass();
  /// Wave length over which what varies of the span's curvature changes, 2 pi rms/rms of its slope [m]; infinite: it
  /// does not. The layer that friction holds and whose strain evens out over most, with that length (LayerSlip::evening), and
  /// whether it has no lay; -1: none.
  struct BendScale {
    double bend_wave = 0, longest = 0;
    int layer = -1;
    bool straight = false;
  };
  const BendScale& evening() const { return evening_; }

  /// Second pass: segment `segment` of the span, whose history is `row` of `history`. Call for segments in
  /// order.
  void evaluate(std::size_t segment, const DeformationHistory& history, std::size_t row, const Sink& sink);

  /// Whether friction holds anything inside the cables.
  bool rubs_inside() const;
  /// Those that a segment's damage may go by once something is known better. Precondition: it was evaluated
  /// last.
  const std::vector<Site>& likely_worst() const { return likely_; }
  /// The same of a place of rest that is not the job's own: only cables that bend most are scanned. Precondition:
  /// find_bent(). Segments as in varied().
  const std::vector<Site>& likely_of_bent(std::size_t segment, const DeformationHistory& history,
                                          std::size_t row);
  /// The largest sum over turning points of (range times tensile peak)^3 of these wires: for comparing rests of one job. Segments
  /// in order; likely_of_bent() gives the wires of this scan.
  float damage_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// The wires' site rows and turning points, in the order of `sites`, with friction times each of `factors`,
  /// (factor). Segments as in evaluate(); of an evaluation with other slack, play or grips there is no need
  /// to evaluate anything before.
  std::vector<SiteRows> varied(const std::vector<Site>& sites, const std::vector<double>& factors,
                               std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Row of the file's own sites.
  std::size_t row_of(std::size_t segment, Site site) const { return site_row(segment, site); }

 private:
  struct Wire {  ///< one wire of the construction; sites are segment x wire x fibre
    int bundle, layer, number;
    std::string path;
  };
  /// The sites of one wire layer of the construction, over all its bundles, that see most, by each of several
  /// measures. Which of them lives shortest depends on the material and the mean-stress correction.
  struct SiteMeasures;
  struct Worst {
    enum By { range, size, tension, range_times_tension, cycles, ranges, yielding_cycles, measures };
    std::array<Site, measures> site;
    std::array<float, measures> value{-1, -1, -1, -1, -1, -1, -1};
    /// Those with the largest sums, over cycles and over ranges, largest first: of many middling cycles no
    /// sum knows the damage well enough for the first alone to be the worst.
    static constexpr std::array<By, 2> sums{cycles, ranges};
    static constexpr std::size_t always_by_sum = 12, most_by_sum = 128;
    std::array<std::vector<std::pair<float, Site>>, sums.size()> by_sum;
    void consider(const SiteMeasures& seen);
  };
  struct SiteMeasures {
    Site site;
    std::array<float, Worst::measures> by;
  };
  /// One way of sliding and what it needs.
  struct Bound {
    ClampMeans means;
    /// Every level of the job slips in this way. Then the job's own sites are the bound, and the list is not needed
    /// for the worst wire.
    bool own;
    std::vector<std::array<float, Worst::sums.size()>>
        most{};  ///< (layer) the largest sums in the segments so far
  };

  /// Whose states a worker has of a part in which others lie.
  struct ParentKey {
    int part = -1, order = 0;           ///< order 0: none yet
    const ClampMeans* means = nullptr;  ///< the job's own where other friction makes no difference
    bool operator==(const ParentKey&) const = default;
  };
  /// What one thread keeps between bundles.
  struct Worker {
    BundleScan scan;
    PartStates parent;
    ParentKey parent_is;  ///< of the states, in the run at hand
    /// Of the segment being evaluated: for the job's own way of sliding, then with other friction.
    std::vector<std::unique_ptr<HeldStrains>> held;
    std::shared_ptr<PartDeviations> deviations = std::make_shared<PartDeviations>();
  };
  /// The sites of one bundle, wire by wire.
  struct BundleSites {
    SiteRows rows;
    std::vector<SiteMeasures> seen;
  };

  /// Wires whose strain is put together one by one: of layers with friction, and all when shear counts.
  bool mixed(const ClampMeans& means) const;
  void add_bends(const DeformationHistory& block);
  void add_means(const DeformationHistory& block);
  /// What friction holds under these means; null: nothing.
  HeldStrains* held_of(const ClampMeans& means, Worker& worker) const;
  void add_held(const ClampMeans& means);
  /// Whether friction holds anything of `part` or of what it lies in.
  bool holds_down_to(int part, const ClampMeans& means) const;
  const ClampMeans& means_rubbing(double factor);
  /// The turning points of sites in each of several ways of sliding, (way, site).
  std::vector<std::vector<TurningList>> turning_of(const std::vector<Site>& list, std::size_t segment,
                                                   const std::vector<const ClampMeans*>& ways,
                                                   const SegmentMotion& motion);
  const DeformationColumns& columns_of(Site site, const ClampMeans& means, const SegmentMotion& motion) const;
  void find_probes(const std::vector<pipeline::ProbeRequest>& probes);
  BundleNesting part_nesting(int part, std::size_t segment, const ClampMeans& means,
                             const SegmentMotion& motion, const std::vector<Fibre>& fibres,
                             Worker& worker) const;
  BundleNesting layer_nesting(const Bundle& bundle, std::size_t segment, const ClampMeans& means,
                              const SegmentMotion& motion, Worker& worker) const;
  void scan_bundle(std::size_t bundle, std::size_t segment, const ClampMeans& means,
                   const SegmentMotion& motion, bool with_rows, Worker& worker, BundleSites& out) const;
  /// Calls use() for every bundle in order; threads share the work.
  void scan_bundles(std::size_t segment, const ClampMeans& means, const SegmentMotion& motion, bool with_rows,
                    const std::function<void(const BundleSites&)>& use);
  /// The nesting to `part`, from its parent's states where they are enough.
  BundlePointers from_parent(const BundleNesting& nesting, int part, std::size_t segment,
                             const ClampMeans& means, const SegmentMotion& motion, Worker& worker) const;
  /// Whole histories, in double precision, of sites of one bundle and one fibre.
  std::vector<std::vector<double>> histories_of(std::span<const Site> sites, std::size_t segment,
                                                const ClampMeans& means, const SegmentMotion& motion,
                                                Worker& worker) const;
  /// The turning points of such sites, in single precision.
  void list_turns(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                  const SegmentMotion& motion, Worker& worker, std::span<TurningList> lists) const;
  /// Strain along the fibre and, where asked for, shear of sites of one bundle and one fibre, in double
  /// precision.
  std::vector<FibreHistory> fibre_histories(std::span<const Site> sites, std::size_t segment,
                                            const ClampMeans& means, const SegmentMotion& motion,
                                            bool with_shear, Worker& worker) const;
  FibreHistory mixed_history(const WireNode& node, const Fibre& fibre, const LayerSlip& slip,
                             const double* rows, std::size_t samples, bool with_shear) const;
  /// The nesting to such sites, which are its nodes. sliding: keeps the clamp means that they point to.
  BundleNesting site_nesting(std::span<const Site> sites, std::size_t segment, const ClampMeans& means,
                             const SegmentMotion& motion, std::vector<std::vector<double>>& sliding,
                             Worker& worker) const;
  std::size_t site_row(std::size_t segment, Site site) const {
    return place_.sites_before +
           ((place_.first_segment + segment) * wires_.size() + site.wire) * scan_.fibre_count + site.fibre;
  }
  std::vector<double> helix_of(int part, std::size_t segment) const;
  void append_site(SiteRows& rows, Site site, std::size_t segment, const std::vector<double>& helix) const;
  static std::span<const float> append_points(SiteRows& rows, std::span<const TurningPoint> points);
  static SiteMeasures seen(Site site, const StrainMeasures& of);
  /// Layers of which any wire was seen; the hose's wall is no wire.
  std::vector<const Worst*> of_wires(const std::vector<Worst>& worst) const;
  void find_likely(const std::vector<const Worst*>& wires);
  std::vector<Worst> worst_of_bent(std::size_t segment, const DeformationHistory& history, std::size_t row);
  /// Of the largest range, which is the job's if none before was larger, and of the largest sums; then those
  /// that the job names.
  std::vector<Site> sites_to_probe(const std::vector<const Worst*>& wires, std::size_t segment);
  /// The worst sites of every wire layer. sink: where all sites go; may be empty.
  std::vector<Worst> worst_of(std::size_t segment, const ClampMeans& means, const SegmentMotion& motion,
                              const std::function<void(const SiteRows&)>& sink);
  void put_probes(const std::vector<Site>& sites, std::size_t segment, const SegmentMotion& motion,
                  const Sink& sink);
  std::vector<Site> sites_of_bound(const std::vector<Worst>& worst, Bound& bound) const;
  void put_bound(const std::vector<Site>& sites, const ClampMeans& means, std::size_t segment,
                 const SegmentMotion& motion, const std::function<void(const SiteRows&)>& sink);

  const Construction& construction_;
  SpanPlace place_;
  std::vector<double> lengths_, arcs_;
  std::vector<double>
      places_;  ///< (segment) arc at which its wires are evaluated: arcs_, or at a known end [m]
  std::size_t samples_;
  std::vector<Fibre> fibres_;
  int surface_fibres_;
  ScanSettings scan_;
  bool with_planes_;
  ClampMeans means_;
  Bound stick_, free_;
  std::vector<std::pair<double, std::unique_ptr<const ClampMeans>>>
      rubbing_;  ///< with so many times the friction
  std::vector<Site> likely_;
  std::vector<std::vector<Site>> likely_of_bent_;  ///< (segment), where damage_of_bent() was called
  CablePaths cables_;
  CablePaths::Keeper keeper_;
  /// Of a vector over the samples.
  struct Variance {
    std::array<double, 2> sum{};
    double squares = 0, count = 0;
    void add(const std::array<double, 2>& value) {
      for (const int k : {0, 1}) sum[k] += value[k], squares += value[k] * value[k];
      ++count;
    }
    double variance() const { return (squares - (sum[0] * sum[0] + sum[1] * sum[1]) / count) / count; }
  };
  std::vector<Variance> bends_;  ///< (segment, 2) curvature, and by how much the next segment has more
  bool first_pass_ended_ = false;
  BendScale evening_;
  std::size_t meant_ = 0;                ///< samples that the means have had
  std::vector<Worker> workers_;          ///< one a thread
  std::vector<BundleSites> found_;       ///< being scanned, or waiting to be used
  std::vector<Wire> wires_;              ///< bundle by bundle
  std::vector<std::size_t> first_wire_;  ///< of each bundle
  Site worst_;
  std::size_t worst_segment_ = 0;
  float worst_range_ = -1;
  std::vector<std::pair<std::size_t, Site>> probes_;  ///< (segment of the span, site) that the job names
};

}  // namespace dresslife::strain
