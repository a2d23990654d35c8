// Random numbers that are the same on every machine. The distributions of the standard library differ between libraries.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace dresslife::pipeline {

/// Returns a random number for each x: mixes the bits of x so that neighbours are independent (splitmix64; Steele, Lea and Flood
/// 2014). The sequence of splitmix64 is mixed(s), mixed(s + mix_step), mixed(s + 2 mix_step), ..
inline constexpr std::uint64_t mix_step = 0x9e3779b97f4a7c15;
inline std::uint64_t mixed(std::uint64_t x) {
  x += mix_step;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Returns a uniform number between 0 and 1, both excluded. The largest number is limited, because it would round to 1.
inline double uniform_of(std::uint64_t bits) {
  constexpr double below_one = 1 - 0x1p-53;
  return std::min((static_cast<double>(bits >> 11) + 0.5) * 0x1p-53, below_one);
}

/// Returns a standard normal number from two uniform numbers (Box and Muller 1958).
inline double normal_of(double one, double other) {
  return std::sqrt(-2 * std::log(one)) * std::cos(2 * std::numbers::pi * other);
}

/// The sequence of splitmix64. Its start costs nothing, so each of many small tasks can have its own.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : at_(mixed(seed)) {}
  /// Returns a uniform number between 0 and 1, both excluded.
  double uniform() { return uniform_of(mixed(at_ += mix_step)); }

 private:
  std::uint64_t at_;
};

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  /// Returns a uniform number between 0 and 1, both excluded.
  double uniform() { return uniform_of(engine_()); }
  /// Returns a standard normal number.
  double normal() {
    const double one = uniform();
    return normal_of(one, uniform());
  }
  /// Returns the list filled with standard normal numbers.
  template <class List>
  List normals(List list) {
    for (double& number : list) number = normal();
    return list;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dresslife::pipeline
