// Letters, blanks and numbers of a text.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

/// Capital letters as small ones: those of ASCII, and those of ISO 8859-1 in UTF-8.
std::string lower_case(std::string_view text);
/// Small letters of ASCII as capital ones.
std::string upper_case(std::string_view text);
/// Whether two texts are the same but for case.
bool same_word(std::string_view a, std::string_view b);
/// Without spaces and control characters at both ends.
std::string_view trimmed(std::string_view text);

/// The number that is all of a text; absent: it is none, is out of range, or something else stands beside it.
template <class Number>
std::optional<Number> whole_number_in(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && read == end ? std::optional(value) : std::nullopt;
}

}  // namespace dresslife::pipeline
