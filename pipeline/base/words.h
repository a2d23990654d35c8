// Words that name the values of an enumeration in settings.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace dresslife::pipeline {

/// Returns the word of a value; `words` are in the order of the values, which count from 0. Empty beyond the last value: this
/// ends the list of a choice (pipeline/settings/fields.h).
constexpr std::string_view word_at(std::initializer_list<std::string_view> words, auto value) {
  const auto at = static_cast<std::size_t>(value);
  return at < words.size() ? words.begin()[at] : std::string_view();
}

}  // namespace dresslife::pipeline
