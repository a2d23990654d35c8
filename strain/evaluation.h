// Every wire of every segment: strain histories, their turning points, bounds and probes (README W10 to W15).
//
// Two passes over the motion: the first (`add`) gathers what slides from clamp to clamp, from blocks of
// samples with all segments; the second (`evaluate`) runs each segment over its whole history, bundle by
// bundle in blocks of samples that stay in cache. Results leave through a Sink as they arise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "strain/clamp_means.h"
#include "strain/friction.h"
#include "strain/reversals.h"

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
  std::vector<double> strain;  ///< (sample)
};

/// Where results go. Rows are the sink's to read until it returns.
struct Sink {
  std::function<void(const SiteRows&)> sites, bound_stick, bound_free;
  std::function<void(const Probe&)> probe;
  std::function<void(double share)> progress;  ///< of the second pass; may be empty
};

class Evaluation {
 public:
  /// lengths: rest lengths of the segments [m]. Errors: InputError for a probe that names no wire or no
  /// segment.
  Evaluation(const Construction& construction, const pipeline::Strain& settings, std::vector<double> lengths,
             std::size_t samples);

  std::size_t segments() const { return lengths_.size(); }
  std::size_t sites() const { return segments() * wires_.size() * fibre_count_; }

  std::size_t longest_path() const;  ///< of a site's component [bytes]
  std::size_t longest_material() const;
  std::string summary() const;  ///< one line on the site with the largest strain range so far

  void add(const DeformationHistory& block);  ///< first pass, in order of time

  /// Second pass: segment `segment`, whose history is `row` of `history`. Call for segments in order.
  void evaluate(std::size_t segment, const DeformationHistory& history, std::size_t row, const Sink& sink);

 private:
  struct Wire {  ///< one wire of the construction; sites are segment x wire x fibre
    int bundle, layer, number;
    std::string path;
  };
  struct Site {
    std::size_t wire = 0;
    int fibre = 0;
    auto operator<=>(const Site&) const = default;
  };
  struct Extremes {
    float low = 0, high = 0;
    float range() const { return high - low; }
    float size() const { return std::max(std::abs(low), std::abs(high)); }
  };
  /// The sites of one wire layer of the construction, over all its bundles, that see most, by each of several
  /// measures. Which of them lives shortest depends on the material and the mean-stress correction.
  struct Worst {
    enum By { range, size, tension, range_times_tension, cycles, measures };
    std::array<Site, measures> site;
    std::array<float, measures> value{-1, -1, -1, -1, -1};
    void consider(Site at, const Extremes& extremes, const TurningList& turning);
  };
  /// One way of sliding and what it needs.
  struct Bound {
    ClampMeans means;
    std::optional<ClampMeans> thin;  ///< the means at the thinned samples
  };

  /// Wires whose strain is put together one by one: of layers with friction, and all when shear counts.
  bool mixed(const ClampMeans& means) const;
  MixedLanes mixed_lanes(const BundleChain& chain, std::size_t layer_in_bundle, const LayerSlip& slip,
                         const std::vector<double>& angles) const;
  struct Group;
  /// One run over the motion; turning points are kept when `keep`.
  void run_blocks(const BundleChain& chain, const DeformationColumns& columns, std::size_t samples,
                  bool is_mixed, bool keep, std::vector<Group>& groups) const;

  void find_probes(const std::vector<pipeline::Probe>& probes);
  BundleChain part_chain(int part, std::size_t segment, const ClampMeans& means,
                         const std::vector<Fibre>& fibres) const;
  BundleChain layer_chain(const Bundle& bundle, std::size_t segment, const ClampMeans& means) const;
  /// Calls found(site, extremes, turning points) for every site of a bundle.
  void scan_bundle(std::size_t bundle, std::size_t segment, const ClampMeans& means,
                   const DeformationHistory& history, std::size_t row, float gate,
                   const std::function<void(Site, const Extremes&, const TurningList&)>& found) const;
  std::vector<double> history_of(Site site, std::size_t segment, const ClampMeans& means,
                                 const DeformationHistory& history, std::size_t row) const;
  std::vector<double> mixed_history(const BundleChain& chain, const LayerSlip& slip,
                                    const DeformationColumns& columns, std::size_t samples) const;
  void append(SiteRows& rows, Site site, std::size_t segment, const TurningList& turning) const;
  /// The worst sites of every wire layer, found on thinned samples.
  std::vector<Worst> worst_of(Bound& bound, std::size_t segment, const DeformationHistory& history,
                              std::size_t row) const;
  void put_bound(const std::vector<Worst>& worst, const ClampMeans& means, std::size_t segment,
                 const DeformationHistory& history, std::size_t row,
                 const std::function<void(const SiteRows&)>& sink) const;

  const Construction& construction_;
  std::vector<double> lengths_, arcs_;
  std::size_t samples_;
  std::vector<Fibre> fibres_;
  int surface_fibres_, fibre_count_;
  float gate_;
  bool with_shear_;
  ClampMeans means_;
  std::optional<HeldStrains> held_;  ///< of the segment being evaluated, with friction
  Bound stick_, free_;
  std::vector<Wire> wires_;              ///< bundle by bundle
  std::vector<std::size_t> first_wire_;  ///< of each bundle
  Site worst_;
  std::size_t worst_segment_ = 0;
  float worst_range_ = -1;
  std::vector<std::pair<std::size_t, Site>> probes_;  ///< (segment, site) that the job names
};

}  // namespace dresslife::strain
