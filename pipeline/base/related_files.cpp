#include "pipeline/base/related_files.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& letter : text)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return text;
}

/// Nothing of a file that cannot be read, or is written in letters of two bytes.
std::optional<std::string> text_of(const fs::path& file) {
  try {
    std::string text = lower(read_text(file));
    return text.find('\0') == std::string::npos ? std::optional(std::move(text)) : std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// What is called like a file belongs to it: weld.dat to weld.src.
std::string with_name(const fs::path& file, std::string text) { return std::move(text) + '\n' + lower(file.stem().string()); }

bool is_name_letter(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_' || letter == '$';
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = at;
    while (end < line.size() && is_name_letter(line[end])) ++end;
    if (end > at) words.emplace_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

/// A line of declarations without what stands in brackets and behind '=': arguments and contents are no names for others.
std::string without_contents(std::string_view line) {
  std::string names;
  int depth = 0;
  bool is_content = false;
  for (const char letter : line) {
    if (letter == '(' || letter == '[' || letter == '{') ++depth;
    if (letter == '=' && depth == 0) is_content = true;
    if (letter == ',' && depth == 0) is_content = false;
    names += depth == 0 && !is_content ? letter : ' ';
    if (letter == ')' || letter == ']' || letter == '}') --depth;
  }
  return names;
}

/// What others can call or read of a KRL file: its routines, and what is declared as global.
std::vector<std::string> names_declared(const fs::path& file, const std::string& text) {
  std::vector<std::string> names{lower(file.stem().string())};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<std::string> words = words_of(without_contents(std::string_view(text).substr(begin, end - begin)));
    const bool declares = std::any_of(words.begin(), words.end(), [](const std::string& word) {
      return word == "def" || word == "deffct" || word == "global";
    });
    if (declares) names.insert(names.end(), words.begin(), words.end());
    begin = end + 1;
  }
  for (const char* own : {"def", "deffct", "global", "public", "decl", "const", "signal", "to", "struc", "enum", "in", "out", "int", "real",
                          "bool", "char", "axis", "pos", "frame", "e6axis", "e6pos"})
    std::erase(names, own);
  return names;
}

/// Whether it belongs to all programs in its folder: registers (.va) and KUKA's own files ($config.dat).
bool is_of_the_controller(const fs::path& file) {
  return lower(file.extension().string()) == ".va" || file.filename().string().starts_with('$');
}

struct Candidate {
  fs::path file;
  std::string text;
  std::vector<std::string> names;
};

}  // namespace

std::vector<fs::path> related_files(const std::vector<fs::path>& programs, std::vector<fs::path> beside) {
  std::vector<fs::path> related;
  std::vector<std::string> open;  // texts that may name others
  std::vector<Candidate> candidates;
  bool all = false;
  for (const fs::path& program : programs) {
    std::optional<std::string> text = program.empty() ? std::string() : text_of(program);
    all |= !text || lower(program.extension().string()) == ".pgf";
    open.push_back(with_name(program, std::move(text).value_or("")));
  }
  for (fs::path& file : beside) {
    std::optional<std::string> text = all ? std::nullopt : text_of(file);
    if (text && !is_of_the_controller(file)) {
      std::vector<std::string> names = names_declared(file, *text);
      candidates.push_back({std::move(file), std::move(*text), std::move(names)});
    } else {
      related.push_back(std::move(file));
      open.push_back(std::move(text).value_or(""));
    }
  }
  while (!open.empty()) {
    const std::string text = std::move(open.back());
    open.pop_back();
    const std::vector<std::string> list = words_of(text);
    const std::set<std::string> words(list.begin(), list.end());
    // A name with other letters than those of words may stand in several: it is looked for as it is.
    const auto stands_in_text = [&](const std::string& name) {
      return std::ranges::all_of(name, is_name_letter) ? words.contains(name) : text.find(name) != std::string::npos;
    };
    std::erase_if(candidates, [&](Candidate& candidate) {
      const bool named = std::any_of(candidate.names.begin(), candidate.names.end(), [&](const std::string& name) {
        return stands_in_text(name);
      });
      if (!named) return false;
      related.push_back(std::move(candidate.file));
      open.push_back(with_name(related.back(), std::move(candidate.text)));
      return true;
    });
  }
  std::sort(related.begin(), related.end());
  return related;
}

}  // namespace dresslife::pipeline
