// Critical planes of the likely worst wires of a strain file ((F18), (F21)), for `strain.equivalent: critical_plane`.
//
// strain.h5 contains the strain along the fibre and the shear of those wires of every segment and layer that have the largest
// values of several measures (strain/evaluation.h). Their damage is that of their worst plane (F18). The damage of every other
// wire is that of its signed equivalent strain (F17), times the ratio of both damages for the worst evaluated wire of its segment
// and layer (F21):
//     D = D_eq D'/D'_eq.
// Planes cost 36 counted histories per wire; evaluating them for all wires would cost 36 times as much as the whole stage.
#pragma once

#include <functional>
#include <vector>

#include "fatigue/multiaxial.h"
#include "fatigue/strain_file.h"
#include "fatigue/verdict.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

class JudgedPlanes {
 public:
  /// Empty if the file contains no histories for planes. threads: does not change the result.
  /// @throws pipeline::InputError when /plane/site names no existing site.
  JudgedPlanes(const pipeline::FileReader& file, const SiteSet& sites, const SiteCounters& counters,
               const pipeline::Job& job, std::size_t threads);

  bool empty() const { return site_.empty(); }
  const std::vector<std::size_t>& sites() const { return site_; }      ///< (plane)
  const std::vector<CriticalPlane>& planes() const { return plane_; }  ///< (plane)
  /// Returns the plane of one site; null if the site was not evaluated.
  const CriticalPlane* of(std::size_t site) const;
  /// Returns the strain across the site's plane (sample). Precondition: the site was evaluated.
  std::vector<double> strain_of(std::size_t site) const;

  /// Replaces the damage of the equivalent strain by (F21). group_of(site) < groups: its segment and layer.
  void apply(SiteDamage& all, std::size_t groups, const std::function<std::size_t(std::size_t)>& group_of) const;

 private:
  std::size_t row_of(std::size_t site) const;
  double poisson_ratio_of(std::size_t site) const;

  const pipeline::FileReader& file_;
  const SiteSet& sites_;
  const pipeline::Job& job_;
  std::vector<std::size_t> site_;
  std::vector<CriticalPlane> plane_;
};

}  // namespace dresslife::fatigue
