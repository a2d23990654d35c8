#include "pipeline/life/unvalidated_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

/// Replaces tabs and line feeds, which a program line may contain.
std::string in_a_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char letter) { return letter == '\t' || letter == '\n'; }, ' ');
  return text;
}

double number_of(const std::string& word) {
  std::size_t used = 0;
  const double number = std::stod(word, &used);
  if (used != word.size()) throw std::invalid_argument("not a number");
  return number;
}

}  // namespace

bool is_credible(const UnvalidatedMode& mode) {
  constexpr double long_life = 1e5;  // [h]
  return mode.bends_at_limit <= 0 || mode.bends_at_limit >= published_wall_bends || !(mode.early_hours() < long_life);
}

std::string unvalidated_text(const std::vector<UnvalidatedMode>& modes) {
  std::string text;
  for (const UnvalidatedMode& m : modes)
    text += fmt::format(
        "{}\t{}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.4g}\t{:.6g}\t{}\t{:.6g}\t{}\t{:.6g}\t{}\t{:.6g}\t{}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}\n",
        m.mode, in_a_line(m.dresspack), m.hours[0], m.hours[1], m.hours[2], m.first_share, m.together_p10,
        m.segment_from_tool, m.position_from_tool, in_a_line(m.place), m.time, in_a_line(m.step), m.bends_at_limit,
        in_a_line(m.note), m.found_share, m.unseen_share, m.visible_from, m.margin);
  return text;
}

std::vector<UnvalidatedMode> unvalidated_from(const std::string& text) {
  std::vector<UnvalidatedMode> modes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = parts_between(line, "\t");
    if (words.size() < 18) throw std::invalid_argument("a mode without all of its values");
    UnvalidatedMode& mode = modes.emplace_back();
    mode.mode = words[0], mode.dresspack = words[1];
    for (std::size_t i = 0; i < 3; ++i) mode.hours[i] = number_of(words[2 + i]);
    mode.first_share = number_of(words[5]), mode.together_p10 = number_of(words[6]);
    mode.segment_from_tool = static_cast<int>(std::clamp(number_of(words[7]), 0.0, 1e9));
    mode.position_from_tool = number_of(words[8]);
    mode.place = words[9];
    mode.time = number_of(words[10]);
    mode.step = words[11];
    mode.bends_at_limit = number_of(words[12]);
    mode.note = words[13];
    mode.found_share = number_of(words[14]), mode.unseen_share = number_of(words[15]);
    mode.visible_from = number_of(words[16]);
    mode.margin = number_of(words[17]);
  }
  return modes;
}

}  // namespace dresslife::pipeline
