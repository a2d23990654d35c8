// Strain of helices that the bends of a motion do not contain in whole turns.
//
// In a bend of whole turns a helix is as often on the outer as on the inner side, so its path keeps its length. A bend that ends
// within a turn lengthens or shortens the path. Without friction the whole length takes the difference,
//     net = (R cos^2(alpha) / L) x (sum over the segments of curvature x length x exp(-i phase)),
// L: length from clamp to clamp. Its real part, turned by the phase of a part, is the strain of this part. A layer that slides over
// its pitch (W10) lacks this strain. With a sharp bend it is at most R kappa p / (pi L) for a lay length p. In a smooth bend of
// many turns it is nearly zero.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "strain/construction.h"
#include "strain/history.h"
#include "strain/slip.h"

namespace dresslife::strain {

/// Largest range of a vector over all directions of its plane. Eight directions miss at most 1 - cos(pi/16), 2 %.
class RangeOfVector {
 public:
  void add(double x, double y);
  double largest() const;

 private:
  static constexpr int directions = 8;
  std::array<double, directions> low_{}, high_{};
  bool any_ = false;
};

class NetBend {
 public:
  /// lengths, arcs: rest length and centre of each segment [m]. free_length: as in plan_slip() [m].
  NetBend(const Construction& construction, const std::vector<LayerSlip>& plan, const std::vector<double>& lengths,
          const std::vector<double>& arcs, double free_length);
  void add(const DeformationHistory& block);

  /// The layer whose net strain is the largest share of its wires' own bending strain. strain, own: ranges over the motion, own: of the
  /// thickest wire in the layer, where the span bends most. layer: -1: no layer slides over its pitch.
  struct Largest {
    int layer = -1;
    double lay = 0;  ///< lay length [m]
    double strain = 0, own = 0;
  };
  /// without: layers whose strain is in the lives (W45).
  Largest largest(const std::vector<int>& without = {}) const;

 private:
  struct OfLayer {
    int layer;
    double lay;                                 // length [m]
    double wire_radius;                         // of the thickest wire in it [m]
    std::vector<std::complex<double>> weights;  // (segment) [m]
    RangeOfVector range;
  };
  std::vector<OfLayer> layers_;
  std::vector<RangeOfVector> bends_;  // (segment) curvature
};

}  // namespace dresslife::strain
