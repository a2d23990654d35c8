// How a component slides (strain/slip.h). The hot loops include this header. It contains nothing else, so that they are
// recompiled only when it changes.
#pragma once

namespace dresslife::strain {

enum class Sliding { glued, over_pitch, clamp_to_clamp, along_ancestor };

/// Largest deviation of the strain from its mean that friction can hold (W16): constant + per_mean x mean, not below 0. The
/// mean strain gives the tension of the part in excess of that at rest.
struct FrictionCap {
  double constant = 0, per_mean = 0;
  bool operator==(const FrictionCap&) const = default;
};

}  // namespace dresslife::strain
