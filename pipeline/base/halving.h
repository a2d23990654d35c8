// Bisection: the value at which a condition changes from true to false. It needs no slope.
#pragma once

namespace dresslife::pipeline {

/// An interval that contains the change.
struct Halved {
  double low, high;
  double middle() const { return (low + high) / 2; }
};

/// Returns the interval after `halvings` bisections. Its length is 2^-halvings of the first one. Each bisection calls `is_below`
/// once. Precondition: is_below(low) is true and is_below(high) is false.
template <class IsBelow>
Halved halved(double low, double high, int halvings, const IsBelow& is_below) {
  Halved ends{low, high};
  for (int k = 0; k < halvings; ++k) {
    const double middle = ends.middle();
    (is_below(middle) ? ends.low : ends.high) = middle;
  }
  return ends;
}

}  // namespace dresslife::pipeline
