// Friction between a component and its contact partners ((W16) and (W17) in strain/theory.md).
//
// The strain of a glued component deviates from its mean over the length within which it evens out (strain/slip.h). Friction
// holds this deviation up to a cap. Along the component its force changes by at most mu p per length; p is the radial line
// load. The distance from zero to largest deviation is a quarter of the evening length s, therefore
//     cap = mu p s / (4 E A),   p = q + T sin^2(alpha) / R,   T = T0 + E A x mean strain, not below 0   (W16)
// For a helix, s = 2 pi R / sin(alpha), this is Papailiou's (pi/2) k_slip R cos^2(alpha) with
// k_slip = mu p / (E A cos^2(alpha) sin(alpha)). It holds for straight components as well.
// The deviation passes through an elastic-perfectly-plastic slider (W17): held = deviation - slip. The slip changes when |held|
// would exceed the cap. E A x held x d(slip) >= 0 is the work of friction per length: a closed loop only loses energy.
//
// Source: K. Papailiou, On the bending stiffness of transmission line conductors, IEEE Trans. Power Delivery
// 12 (1997); F. Foti and L. Martinelli, J. Sound Vib. 370 (2016).
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "strain/clamp_means.h"
#include "strain/part_states.h"

namespace dresslife::strain {

class Slider {
 public:
  Slider() = default;
  explicit Slider(double slip) : slip_(slip) {}
  /// Returns the held part of the next deviation. cap >= 0.
  double next(double deviation, double cap) {
    slip_ = std::clamp(slip_, deviation - cap, deviation + cap);  // a stuck slip is not changed by rounding
    return deviation - slip_;
  }
  double slip() const { return slip_; }

 private:
  double slip_ = 0;
};

/// Returns the slip of a slider at the end of the first repeat of the motion (W17). Every sample limits the slip to its
/// deviation minus and plus its cap. From the last sample backward these limits close, usually within a few samples; earlier
/// samples then have no influence. deviation(t), cap(t) >= 0: strains at sample t; an infinite cap: glued.
double settled_slip(std::size_t samples, const auto& deviation, const auto& cap) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double low = -none, high = none;
  for (std::size_t t = samples; t-- > 0 && low < high;) {
    const double at = deviation(t), limit = cap(t);
    const double lower = std::clamp(at - limit, low, high);
    high = std::clamp(at + limit, low, high);
    low = lower;
  }
  return std::clamp(0.0, low, high);
}

inline double cap_at(const FrictionCap& cap, double mean) { return std::max(0.0, cap.constant + cap.per_mean * mean); }

/// Input of friction: mean of a part, and its deviation from the mean as a series: (1 + power, sample). Stores the part of the
/// last request, and the state of its parent, from which all parts in the parent are computed.
struct PartDeviations {
  struct Of {
    int part = -1, turn = -1;
    const ClampMeans* means = nullptr;  ///< null: independent of friction, because no part above has friction
    bool operator==(const Of&) const = default;
  };
  Of of;
  std::vector<double> rows;
  int parent_is = -1;
  PartStates parent;
};

/// The strains that friction holds in the parts from the dresspack to one bundle, over the whole motion. The sliders start in
/// the state in which one repeat of the motion leaves them: slip settles in the first repeat, and life counts many. For each
/// level only the part of the last request is stored: bundles come part by part, and all parts of a segment would need
/// hundreds of histories.
class HeldStrains {
 public:
  /// shared: used by all objects that differ only in the friction factor; begin() is called for all of them together. order: of
  /// the series that the wires need of the part that contains them (order_for()).
  HeldStrains(const Construction& construction, const ClampMeans& means,
              std::shared_ptr<PartDeviations> shared = std::make_shared<PartDeviations>(), int order = 1)
      : construction_(construction),
        means_(means),
        order_(order),
        kept_(construction.levels()),
        deviations_(std::move(shared)) {}

  /// Returns the memory after all requests [bytes], for a motion with this number of samples.
  std::size_t bytes(std::size_t samples) const;

  /// Discards all results. motion: of the segment whose centre lies at `arc` [m]; it is read until the next begin().
  void begin(double arc, const SegmentMotion& motion);

  /// Gives each part of `nesting`, which ends in `part`, its held strain. The pointers are valid until another part of one of
  /// these levels is requested.
  void attach(BundleNesting& nesting, int part);

 private:
  static constexpr int nobody = -1;
  struct Rows {
    int part = nobody;
    std::vector<double> own;                                   ///< (power, sample)
    std::array<std::vector<double>, phases_per_pitch> turned;  ///< empty: not needed
  };

  bool any_turned() const;
  /// Returns the number of powers of the series of a part of this level (from 0): each level below needs one order more.
  int powers(int level) const { return construction_.levels() - 1 - level + order_; }
  const Rows& rows_of(int part, int level);
  void fill(Rows& rows, int part);
  BundleNesting nesting_of(int part);
  void find_deviations(const BundleNesting& nesting, const PartDeviations::Of& of);

  const Construction& construction_;
  const ClampMeans& means_;
  int order_;
  double arc_ = 0;
  const SegmentMotion* motion_ = nullptr;
  std::size_t samples_ = 0, stride_ = 0;
  std::vector<Rows> kept_;  ///< (level)
  std::shared_ptr<PartDeviations> deviations_;
};

}  // namespace dresslife::strain
