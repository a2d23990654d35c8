#include "pipeline/base/related_files.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

std::string stem_of(const fs::path& file) { return lower_case(file.stem().string()); }

std::string without_comments(const std::string& text) {
  std::string kept;
  for (const std::string& line : parts_between(text, "\n")) kept += line.substr(0, line.find(';')) + '\n';
  return kept;
}

/// Returns the text of a file; std::nullopt if it cannot be read or is UTF-16.
std::optional<std::string> text_of(const fs::path& file) {
  try {
    std::string text = lower_case(read_text(file));
    if (text.find('\0') != std::string::npos) return std::nullopt;
    return is_krl(file) ? without_comments(text) : text;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

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

/// Removes brackets with their content and the text behind '=' from a line: arguments and values are no names for other files.
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

/// Returns the words of each line, without words in brackets and behind '='.
std::vector<std::vector<std::string>> declarations(const std::string& text) {
  return mapped(parts_between(text, "\n"), [](const std::string& line) { return words_of(without_contents(line)); });
}

bool has(const std::vector<std::string>& words, const char* word) {
  return std::ranges::find(words, word) != words.end();
}
bool begins_a_routine(const std::vector<std::string>& words) { return has(words, "def") || has(words, "deffct"); }

/// Returns the names of the routines that a KRL file defines.
std::set<std::string> routines_of(const std::string& text) {
  std::set<std::string> names;
  for (const std::vector<std::string>& words : declarations(text))
    if (begins_a_routine(words)) names.insert(words.back());
  return names;
}

/// Returns the names that other files can use, in the form of used_in(): the first routine of the file, and its global
/// declarations.
std::vector<std::string> names_declared(const fs::path& file, const std::string& text) {
  if (!is_krl(file)) return {stem_of(file)};
  std::vector<std::string> names, data;
  bool first = true;
  for (const std::vector<std::string>& words : declarations(text)) {
    const bool routine = begins_a_routine(words);
    if (routine && (first || has(words, "global"))) names.push_back(words.back() + '(');
    if (!routine && has(words, "global")) data.insert(data.end(), words.begin(), words.end());
    first = first && !routine;
  }
  for (const char* own : {"global", "public", "decl", "const", "signal", "to", "struc", "enum", "in", "out", "int",
                          "real", "bool", "char", "axis", "pos", "frame", "e6axis", "e6pos"})
    std::erase(data, own);
  names.insert(names.end(), data.begin(), data.end());
  for (const char* mark : {":", ".."}) names.push_back(stem_of(file) + mark);
  return names;
}

/// Returns the words of a text, also with the mark behind them: "grip(" for a call, "weld:" and "weld.." for a name with its
/// file. A call may be without brackets if it is alone in its line or follows DO, CONTINUE or RUN.
std::set<std::string> used_in(const std::string& text) {
  std::set<std::string> used;
  std::string before;
  for (std::size_t at = 0; at < text.size();) {
    if (!is_name_letter(text[at])) {
      if (text[at++] == '\n') before.clear();
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_name_letter(text[end])) ++end;
    const std::string word = text.substr(at, end - at);
    used.insert(word);
    const std::size_t next = std::min(text.find_first_not_of(" \t\r", end), text.size());
    const bool line_ends = next == text.size() || text[next] == '\n';
    const bool alone = line_ends && (before.empty() || before == "do" || before == "continue" || before == "run");
    if (alone || text.compare(next, 1, "(") == 0) used.insert(word + '(');
    for (const char* mark : {":", ".."})
      if (text.compare(next, std::strlen(mark), mark) == 0) used.insert(word + mark);
    before = word;
    at = end;
  }
  return used;
}

/// Returns whether a file belongs to all programs in its folder: registers (.va) and KUKA's data lists ($config.dat).
bool is_of_the_controller(const fs::path& file, const std::string& text) {
  return lower_case(file.extension().string()) == ".va" || file.filename().string().starts_with('$') ||
         text.find("defdat $") != std::string::npos;
}

struct Candidate {
  fs::path file;
  std::string text;
  std::vector<std::string> names;
};

/// A text that may name other files.
struct Open {
  std::string stem, text;
  std::set<std::string> own{};  ///< names in the text that are its own routines
};

}  // namespace

std::vector<fs::path> related_files(const std::vector<fs::path>& programs, std::vector<fs::path> beside,
                                    const std::string& routine) {
  std::vector<fs::path> related;
  std::vector<Open> open{{"", lower_case(routine) + "()"}};
  std::vector<Candidate> candidates;
  bool all = false;
  for (const fs::path& program : programs) {
    std::optional<std::string> text = program.empty() ? std::string() : text_of(program);
    all |= !text || lower_case(program.extension().string()) == ".pgf";
    open.push_back({stem_of(program), std::move(text).value_or("")});
  }
  // Several files may define a routine of one name. The routines of the first program have priority (first_file_counts in
  // sim/program/interpreter/program.h).
  if (!programs.empty() && is_krl(programs.front())) open[1].own = routines_of(open[1].text);
  for (fs::path& file : beside) {
    std::optional<std::string> text = all ? std::nullopt : text_of(file);
    if (text && !is_of_the_controller(file, *text)) {
      std::vector<std::string> names = names_declared(file, *text);
      candidates.push_back({std::move(file), std::move(*text), std::move(names)});
    } else {
      open.push_back({stem_of(file), std::move(text).value_or("")});
      related.push_back(std::move(file));
    }
  }
  while (!open.empty()) {
    const Open of = std::move(open.back());
    open.pop_back();
    const std::set<std::string> used = used_in(of.text);
    const auto stands_in_text = [&](const std::string& name) {
      const std::string bare = name.substr(0, name.find_first_of("(:."));
      // A name with other characters than is_name_letter() may be several words, so the text is searched for the whole name.
      if (!std::ranges::all_of(bare, is_name_letter)) return of.text.find(bare) != std::string::npos;
      return used.contains(name) && !of.own.contains(bare);
    };
    std::erase_if(candidates, [&](Candidate& candidate) {
      // A data file belongs to the program of the same name: weld.dat to weld.src.
      if (stem_of(candidate.file) != of.stem && std::ranges::none_of(candidate.names, stands_in_text)) return false;
      open.push_back({stem_of(candidate.file), std::move(candidate.text)});
      related.push_back(std::move(candidate.file));
      return true;
    });
  }
  std::ranges::sort(related);
  return related;
}

}  // namespace dresslife::pipeline
