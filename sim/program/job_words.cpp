#include "sim/program/job_words.h"

#include <fmt/format.h>

#include <regex>

namespace dresslife::sim {
namespace {

/// Returns the text, in quotes if YAML would not read it as this text.
std::string yaml_word(const std::string& text) {
  static const std::regex plain(R"([A-Za-z0-9_.$-]+)");
  if (std::regex_match(text, plain)) return text;
  return fmt::format("'{}'", std::regex_replace(text, std::regex("'"), "''"));
}

/// Replaces each match by the result of `made`.
template <class Made>
std::string replaced(const std::string& text, const std::regex& wanted, const Made& made) {
  std::string out;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), wanted), end; at != end; ++at) {
    out.append(from, (*at)[0].first).append(made(*at));
    from = (*at)[0].second;
  }
  return out.append(from, text.cend());
}

}  // namespace

std::string in_words_of_a_job(std::string text) {
  if (text.find("--") == std::string::npos) return text;
  // Keys of a job that some remedies name in addition to the option.
  static const std::regex beside(R"( \(motion\.(?:values|assume)(?: in a job)?\))"),
      module_beside(R"(--module, motion\.modules)"), frames(R"(--frames FILE\.yaml \((motion\.\w+) in a job\))"),
      frames_beside(R"( \(--frames\))");
  text = std::regex_replace(text, beside, "");
  text = std::regex_replace(text, module_beside, "--module");
  text = std::regex_replace(text, frames, "$1");
  text = std::regex_replace(text, frames_beside, "");
  static const std::regex quoted(R"(--value '([^'=]+)=([^']*)')"),
      bare(R"(--value ([^\s='-][^\s=]*)=([^\s;)]*[^\s;),])(?: or \1=(\w+))?)"),
      assume(R"(--assume ([^\s=]+)=([^\s,;)]+))");
  const auto value = [](const std::smatch& found) {
    return fmt::format("motion.values: [{{name: {}, value: {}}}]{}", yaml_word(found[1]),
                       found[2] == "..." ? "VALUE" : yaml_word(found[2]),
                       found.size() > 3 && found[3].matched ? " or value: " + found[3].str() : "");
  };
  text = replaced(replaced(text, quoted, value), bare, value);
  text = replaced(text, assume, [](const std::smatch& found) {
    return fmt::format("motion.assume: [{{line: {}, take: {}}}]", yaml_word(found[1]), yaml_word(found[2]));
  });
  static const std::regex next_value(R"(\] motion\.values: \[)"), other_answer(R"(( or|,) =(\w+))");
  text = std::regex_replace(text, next_value, ", ");
  text = std::regex_replace(text, other_answer, "$1 take: $2");
  for (const auto& [option, key] : {std::pair{"--module", "motion.modules: [{file: FILE}]"},
                                    {"--value", "motion.values"},
                                    {"--assume", "motion.assume"},
                                    {"--routine", "motion.routine"}})
    for (std::size_t at = 0; (at = text.find(option, at)) != std::string::npos;)
      text.replace(at, std::string(option).size(), key);
  return text;
}

}  // namespace dresslife::sim
