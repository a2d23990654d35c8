// Friction between a component and what it lies against (README W16, W17).
//
// A glued component's strain deviates from its mean over the length within which it evens out
// (strain/slip.h). Friction holds that deviation up to a cap. Along the component its force changes by at
// most mu p per length, p the radial line load; from where the deviation is zero to where it is largest is a
// quarter of the evening length s, so
//     cap = mu p s / (4 E A),   p = q + T sin^2(alpha) / R,   T = T0 + E A x mean strain, not below 0   (W16)
// which for a helix, s = 2 pi R / sin(alpha), is Papailiou's (pi/2) k_slip R cos^2(alpha) with
// k_slip = mu p / (E A cos^2(alpha) sin(alpha)), and holds for straight components as well.
// The deviation goes through an elastic-perfectly-plastic slider (W17): held = deviation - slip, and the slip
// gives way when |held| would exceed the cap. E A x held x d(slip) >= 0 is the friction's work per length:
// a closed loop can only lose energy.
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
  /// What is held of the next deviation. cap >= 0.
  double next(double deviation, double cap) {
    slip_ = std::clamp(slip_, deviation - cap, deviation + cap);  // not a rounding changes the slip while it sticks
    return deviation - slip_;
  }
  double slip() const { return slip_; }

 private:
  double slip_ = 0;
};

/// Slip of a slider at the end of the first repeat of the motion (W17). Every sample keeps the slip between its
/// deviation less and plus its cap. From the last sample backward these limits close, mostly within a few
/// samples, and then no earlier sample counts. deviation(t), cap(t) >= 0: of sample t, strains; infinite: glued.
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

inline double cap_at(const FrictionCap& cap, double mean) {
  return std::max(0.0, cap.constant + cap.per_mean * mean);
}

/// What friction holds a share of: the mean of a part and its deviation from it as a series, (1 + power,
/// sample). Of the part asked for last, and of its parent the state from which all parts in it go on.
struct PartDeviations {
  struct Of {
    int part = -1, turn = -1;
    const ClampMeans* means =
        nullptr;  ///< null: the same for any friction, since it holds nothing of the parts above
    bool operator==(const Of&) const = default;
  };
  Of of;
  std::vector<double> rows;
  int parent_is = -1;
  PartStates parent;
};

/// What friction holds of the strains of the parts on the way to one bundle, over the whole motion. The
/// sliders start where one repeat of the motion leaves them: slip settles in the first, and life is counted
/// in many. Of every level the part asked for last is kept: bundles come part by part, and all parts of a
/// segment would be hundreds of histories.
class HeldStrains {
 public:
  /// shared: by those that differ in how hard friction is, and in nothing else; they begin together. order: of the
  /// series that the wires need of the part in which they lie (order_for()).
  HeldStrains(const Construction& construction, const ClampMeans& means,
              std::shared_ptr<PartDeviations> shared = std::make_shared<PartDeviations>(), int order = 1)
      : construction_(construction),
        means_(means),
        order_(order),
        kept_(construction.levels()),
        deviations_(std::move(shared)) {}

  /// Memory that it takes in the end, for a motion of so many samples.
  std::size_t bytes(std::size_t samples) const;

  /// Forgets all. motion: of the segment whose centre lies at `arc` [m]; it is read until the next begin().
  void begin(double arc, const SegmentMotion& motion);

  /// Gives each part of `nesting`, which ends in `part`, what friction holds of it: good until a part beside
  /// one of them is asked for.
  void attach(BundleNesting& nesting, int part);

 private:
  static constexpr int nobody = -1;
  struct Rows {
    int part = nobody;
    std::vector<double> own;                                   ///< (power, sample)
    std::array<std::vector<double>, phases_per_pitch> turned;  ///< empty: not needed
  };

  bool any_turned() const;
  /// Of the series of a part of this level, from 0: each level below takes one order.
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
