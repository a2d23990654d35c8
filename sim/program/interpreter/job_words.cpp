#include "sim/program/interpreter/job_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"

namespace dresslife::sim {
namespace {

/// Returns the text, in quotes if YAML would not read it as this text.
std::string yaml_word(const std::string& text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.$-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string inner;
  for (const char letter : text) inner += letter == '\'' ? std::string("''") : std::string(1, letter);
  return "'" + inner + "'";
}

}  // namespace

std::string values_of_job(const std::vector<std::string>& names, const std::string& value) {
  const auto entry = [&](const std::string& name) {
    return fmt::format("{{name: {}, value: {}}}", yaml_word(name), yaml_word(value));
  };
  return fmt::format("motion.values: [{}]", pipeline::joined(pipeline::mapped(names, entry), ", "));
}

std::string assume_of_job(const std::string& line, const std::string& answers) {
  const std::size_t end = std::min(answers.find(' '), answers.size());
  return fmt::format("motion.assume: [{{line: {}, take: {}}}]{}", yaml_word(line), answers.substr(0, end),
                     answers.substr(end));
}

std::string unused_value(const std::string& name) {
  return fmt::format("motion.values of {}: nothing in the program asked for it", name);
}

std::string unused_assumption(const std::string& line) {
  return fmt::format("motion.assume of {}: no branch on that line was to be decided", line);
}

}  // namespace dresslife::sim
