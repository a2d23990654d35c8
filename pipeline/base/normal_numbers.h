// Normal numbers that are the same everywhere: after Box and Muller, as the standard library's differ from
// one library to the next.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace dresslife::pipeline {

class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : engine_(seed) {}
  /// Between 0 and 1, neither of them.
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double next() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  Eigen::VectorXd vector(Eigen::Index size) {
    Eigen::VectorXd numbers(size);
    for (double& number : numbers) number = next();
    return numbers;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dresslife::pipeline
