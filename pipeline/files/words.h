// Splits a text of this project's programs into words. A number that cannot be parsed counts as 0.
#pragma once

#include <charconv>
#include <string_view>

namespace dresslife::pipeline {

class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  bool any() const { return !rest_.empty(); }
  std::string_view rest() const { return rest_; }
  /// Returns the text before `end` and removes both; the whole text if there is no `end`.
  std::string_view until(char end) {
    const std::size_t at = rest_.find(end);
    const std::string_view word = rest_.substr(0, at);
    rest_.remove_prefix(at == std::string_view::npos ? rest_.size() : at + 1);
    return word;
  }
  template <class Number>
  Number number(char end) {
    const std::string_view word = until(end);
    Number value{};
    std::from_chars(word.data(), word.data() + word.size(), value);
    return value;
  }

 private:
  std::string_view rest_;
};

}  // namespace dresslife::pipeline
