// Where a condition goes over from true to false, by halving: no slope can mislead it.
#pragma once

namespace dresslife::pipeline {

/// Two ends with the place between them.
struct Halved {
  double low, high;
  double middle() const { return (low + high) / 2; }
};

/// `is_below` holds at low and not at high. Each halving asks it once; after n the ends are 2^-n of their distance apart.
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
