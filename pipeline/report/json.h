// JSON for the scripts of a page, in the form in which it may stand inside a <script> element, and long rows
// of numbers in it: base64 of little-endian 16-bit steps or 32-bit floats, a third of the digits' length.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dresslife::pipeline {

/// A quoted text; "<" is written \u003c, so that no text ends the element it stands in.
std::string json(std::string_view text);
/// Shortest digits that read back to the same number; null for what is no finite number.
std::string json(double value);
std::string json(const std::vector<double>& values);
std::string json(const std::vector<std::string>& texts);
std::string json(const Eigen::Vector3d& vector);

std::string base64(std::string_view bytes);
std::string base64_of(std::span<const std::uint16_t> values);  ///< quoted
std::string base64_of(std::span<const float> values);          ///< quoted

/// Numbers as whole steps above `low`: value = low + step * n, n in 0 .. steps, wrong by half a step at most.
struct Steps {
  double low = 0, step = 0;
  Steps() = default;
  Steps(double lowest, double highest, int steps = 65535);
  std::uint16_t of(double value) const;
  double value(std::uint16_t number) const { return low + step * number; }
};

}  // namespace dresslife::pipeline
