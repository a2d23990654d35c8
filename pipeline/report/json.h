// JSON for the scripts of a page, safe inside a <script> element. Long rows of numbers are base64 of little-endian
// 16-bit steps or 32-bit floats, which needs a third of the length of decimal digits.
//
// A library's tree of values would store the 5 MB of a page's numbers twice.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dresslife::pipeline {

/// A JSON value, stored as text. Json{{"name", "a1"}, {"radius_m", 0.1}} is an object.
struct Json {
  std::string text;

  /// Shortest digits that read back to the same number; null for NaN and infinity.
  Json(double value);
  Json(std::integral auto value) : text(std::to_string(value)) {}
  Json(bool value) : text(value ? "true" : "false") {}
  /// Quoted text; "<" is written \u003c, so that no text can end the <script> element.
  Json(std::string_view value);
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(const char* value) : Json(std::string_view(value)) {}
  Json(const Eigen::Vector3d& vector) : Json(std::vector<double>{vector.x(), vector.y(), vector.z()}) {}
  template <class Value>
  Json(const std::vector<Value>& list) : text("[") {
    for (const Value& value : list) text += (text.size() > 1 ? "," : "") + Json(value).text;
    text += ']';
  }
  Json(std::initializer_list<std::pair<std::string_view, Json>> members) : text("{}") {
    for (const auto& [key, value] : members) add(key, value);
  }
  /// Adds one member to an object.
  Json& add(std::string_view key, const Json& value);
  Json& add(const Json& members);  ///< adds all members of another object
};

std::string base64(std::string_view bytes);
Json base64_of(std::span<const std::uint16_t> values);
Json base64_of(std::span<const float> values);

/// Numbers as integer steps above `low`: value = low + step * n, n in 0 .. steps. The error is at most half a step.
struct Steps {
  double low = 0, step = 0;
  Steps() = default;
  Steps(double lowest, double highest, int steps = 65535);
  std::uint16_t of(double value) const;
  double value(std::uint16_t number) const { return low + step * number; }
};

}  // namespace dresslife::pipeline
