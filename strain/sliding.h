// How a component slides (strain/slip.h says which does), in words that the hot loops share: no more than
// that, so that they are compiled again only when they change.
#pragma once

namespace dresslife::strain {

enum class Sliding { glued, over_pitch, clamp_to_clamp, along_ancestor };

/// Largest deviation of the strain from its mean that friction can hold (README W16): constant + per_mean x
/// mean, not below 0. The mean strain is what tension the part has beyond that at rest.
struct FrictionCap {
  double constant = 0, per_mean = 0;
  bool operator==(const FrictionCap&) const = default;
};

}  // namespace dresslife::strain
