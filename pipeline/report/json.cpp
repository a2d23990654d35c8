#include "pipeline/report/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/base/limits.h"

namespace dresslife::pipeline {
namespace {

static_assert(std::endian::native == std::endian::little, "pages read little-endian numbers");

template <class Value>
Json base64_of_bytes(std::span<const Value> values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

}  // namespace

Json::Json(std::string_view value) : text("\"") {
  for (const char c : shown(std::string(value))) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += {'\\', c};
    else if (code < 0x20 || c == '<' || c == '>' || c == '&')
      text += fmt::format("\\u{:04x}", code);
    else
      text += c;
  }
  text += '"';
}

Json::Json(double value) : text(std::isfinite(value) ? fmt::format("{}", value) : "null") {}

Json& Json::add(std::string_view key, const Json& value) {
  text.pop_back();
  if (text.size() > 1) text += ',';
  text += Json(key).text + ':' + value.text + '}';
  return *this;
}

Json& Json::add(const Json& members) {
  if (members.text.size() <= 2) return *this;
  text.pop_back();
  if (text.size() > 1) text += ',';
  text += members.text.substr(1);
  return *this;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = 0;
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < here ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= here ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Json base64_of(std::span<const std::uint16_t> values) { return base64_of_bytes(values); }
Json base64_of(std::span<const float> values) { return base64_of_bytes(values); }

Steps::Steps(double lowest, double highest, int steps) : low(lowest), step((highest - lowest) / steps) {}

std::uint16_t Steps::of(double value) const {
  if (!(step > 0)) return 0;
  return static_cast<std::uint16_t>(std::clamp(std::round((value - low) / step), 0.0, 65535.0));
}

}  // namespace dresslife::pipeline
