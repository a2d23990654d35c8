// Letters, spaces and numbers of a text.
#pragma once

#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dresslife::pipeline {

/// Converts capital letters of ASCII, and those of ISO 8859-1 in UTF-8, to small letters.
std::string lower_case(std::string_view text);
/// Converts small letters of ASCII to capital letters.
std::string upper_case(std::string_view text);
/// Returns whether two texts differ only in case.
bool same_word(std::string_view a, std::string_view b);
/// Returns the text without spaces and control characters at both ends.
std::string_view trimmed(std::string_view text);
/// Returns the words of a text that one or more blanks separate. They point into the text.
std::vector<std::string_view> words_in(std::string_view text, std::string_view blanks = " \t\r\n");

/// Returns the position of the first byte that begins no well-formed sequence of UTF-8 (The Unicode Standard 15, section 3.9, and
/// RFC 3629); the size of the text: there is none.
std::size_t first_no_utf8(std::string_view text);

/// Returns any text quoted as one word of a shell.
std::string shell_word(std::string_view text);

/// Returns the parts of a text between separators; some may be empty.
std::vector<std::string> parts_between(std::string_view text, std::string_view separator);

using WordSet = std::set<std::string, std::less<>>;

/// Returns the words of a text that blanks separate, as a set.
inline WordSet word_set(std::string_view text) {
  const std::vector<std::string_view> words = words_in(text);
  return {words.begin(), words.end()};
}

/// Returns the number that is the whole text; std::nullopt if the text is no number, is out of range or contains anything else.
template <class Number>
std::optional<Number> whole_number_in(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && read == end ? std::optional(value) : std::nullopt;
}

}  // namespace dresslife::pipeline
