// Critical planes of the likely worst wires of a strain file (README F18, F21): what `strain.equivalent:
// critical_plane` asks for.
//
// strain.h5 holds the strain along the fibre and the shear of some wires of every segment and layer: those
// that see most by several measures (strain/evaluation.h). Each is damaged by the worst of its planes (F18).
// Every other wire keeps the damage of its signed equivalent strain (F17), times the ratio of both for the
// worst judged wire of its segment and layer: (F21)
//     D = D_eq D'/D'_eq.
// Planes cost 36 counted histories a wire; judging all wires would cost 36 times the whole.
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
  /// Nothing when the file holds no histories for planes. Any number of threads gives the same.
  /// @throws pipeline::InputError when /plane/site names no site.
  JudgedPlanes(const pipeline::FileReader& file, const SiteSet& sites, const SiteCounters& counters,
               const pipeline::Job& job, std::size_t threads);

  bool empty() const { return site_.empty(); }
  const std::vector<std::size_t>& sites() const { return site_; }      ///< (plane)
  const std::vector<CriticalPlane>& planes() const { return plane_; }  ///< (plane)
  /// Of a site; null when it was not judged.
  const CriticalPlane* of(std::size_t site) const;
  /// (sample) strain across the site's plane. Precondition: judged.
  std::vector<double> strain_of(std::size_t site) const;

  /// Puts (F21) in the place of the damage of the equivalent strain. group_of(site) < groups: its segment and
  /// layer.
  void apply(SiteDamage& all, std::size_t groups,
             const std::function<std::size_t(std::size_t)>& group_of) const;

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
