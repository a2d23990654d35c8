// Random numbers that are the same on every machine: the standard library's distributions differ from one
// library to the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace dresslife::pipeline {

/// The bits of x mixed so that neighbours have nothing in common: a random number for each x (splitmix64;
/// Steele, Lea and Flood 2014). mixed(s), mixed(s + mix_step), mixed(s + 2 mix_step), .. is their sequence.
inline constexpr std::uint64_t mix_step = 0x9e3779b97f4a7c15;
inline std::uint64_t mixed(std::uint64_t x) {
  x += mix_step;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Uniform between 0 and 1, neither of them. The largest sum would round to 1.
inline double uniform_of(std::uint64_t bits) {
  constexpr double below_one = 1 - 0x1p-53;
  return std::min((static_cast<double>(bits >> 11) + 0.5) * 0x1p-53, below_one);
}

/// A standard normal number from two uniform ones (Box and Muller 1958).
inline double normal_of(double one, double other) {
  return std::sqrt(-2 * std::log(one)) * std::cos(2 * std::numbers::pi * other);
}

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  /// Between 0 and 1, neither of them.
  double uniform() { return uniform_of(engine_()); }
  /// Standard normal.
  double normal() {
    const double one = uniform();
    return normal_of(one, uniform());
  }
  /// As many standard normal numbers as the list is long.
  template <class List>
  List normals(List list) {
    for (double& number : list) number = normal();
    return list;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dresslife::pipeline
