// Path lengths of the parts in one parent, segment by segment, for parts that slide from clamp to clamp ((W10) and (W34) in
// strain/theory.md).
//
// The parent has the deformation of the segment's centre in the whole segment; the phases of laid parts advance. The path rate
// is the mean over places along the segment: at least four places, and at least six per turn. One place is enough if no part
// from the dresspack to the member has a lay. The mean over evenly spaced places of a turn is exact for its first harmonics.
// The error from the incomplete turn at a segment's ends is (pi/6)^2 / 6 of its contribution.
#pragma once

#include <vector>

#include "strain/history.h"
#include "strain/nesting.h"

namespace dresslife::strain {

/// One part, or one place around a layer of wires.
struct PathMember {
  int layer, number;
  double turn = 0;  ///< [rad]
};

class PathRates {
 public:
  /// lengths, arcs: rest length and centre of each segment [m].
  PathRates(const Construction& construction, const std::vector<LayerSlip>& plan, int parent,
            std::vector<PathMember> members, const std::vector<double>& lengths, const std::vector<double>& arcs);

  std::size_t members() const { return count_; }
  /// Path length of member n in a segment at rest [m].
  double rest(std::size_t segment, std::size_t member) const { return rest_[segment * count_ + member]; }

  /// Adds the path lengths in a segment at samples [0, samples) of the columns to `path` (member, sample) with `stride` [m].
  /// attach: gives the nesting to the parent the strains of its sliding parts.
  template <class Attach>
  void add(std::size_t segment, const DeformationColumns& columns, std::size_t samples, const Attach& attach,
           double* path, std::size_t stride) {
    for (BundleNesting& nesting : places_[segment]) {
      attach(nesting);
      kernels().add_path_rates(pointers(nesting), columns, 0, samples, weights_[segment], path, stride);
    }
  }

 private:
  std::size_t count_;
  std::vector<std::vector<BundleNesting>> places_;  ///< (segment, place)
  std::vector<double> weights_;                     ///< (segment) length that one place represents [m]
  std::vector<double> rest_;                        ///< (segment, member) [m]
};

}  // namespace dresslife::strain
