#include "pipeline/base/text.h"

#include <algorithm>
#include <cctype>

namespace dresslife::pipeline {
namespace {

/// In UTF-8, the code of a small letter of U+00C0 .. U+00DE (except the multiplication sign) is 0x20 higher.
char lower(std::string_view text, std::size_t at) {
  const auto c = static_cast<unsigned char>(text[at]);
  if (at > 0 && text[at - 1] == '\xC3' && c >= 0x80 && c <= 0x9E && c != 0x97) return static_cast<char>(c + 0x20);
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : text[at];
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (std::size_t i = 0; i < text.size(); ++i) result[i] = lower(text, i);
  return result;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a, i) != lower(b, i)) return false;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> words_in(std::string_view text, std::string_view blanks) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(blanks); at != text.npos; at = text.find_first_not_of(blanks, at)) {
    words.push_back(text.substr(at, text.find_first_of(blanks, at) - at));
    at += words.back().size();
  }
  return words;
}

std::size_t first_no_utf8(std::string_view text) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(at < text.size() ? text[at] : 0); };
  for (std::size_t at = 0, length = 1; at < text.size(); at += length) {
    const unsigned char first = byte(at), second = byte(at + 1);
    length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    if (length == 1) continue;
    if (first < 0xC2 || first > 0xF4) return at;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(at + k) & 0xC0) != 0x80) return at;
    // Wrong: an overlong form, a surrogate, above U+10FFFF.
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
        (first == 0xF4 && second > 0x8F))
      return at;
  }
  return text.size();
}

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

std::vector<std::string> parts_between(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + separator.size();
  }
  return parts;
}

}  // namespace dresslife::pipeline
