#include "sim/program/interpreter/program.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "pipeline/base/text.h"
#include "pipeline/settings/fields.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {

namespace {

constexpr std::size_t listed_problems = 50;
constexpr std::size_t most_questions = 300;  // in one round
constexpr std::array<std::string_view, 6> configuration_words{"",      "abb",     "kuka",
                                                              "fanuc", "motoman", "near"};  // by ArmConfiguration::Kind

}  // namespace

std::string unread_reason(const std::string& word, const std::string& of, const std::vector<std::string>& known) {
  const std::string written = lower_case(word);
  std::vector<std::string> lower;
  for (const std::string& other : known) lower.push_back(lower_case(other));
  auto at = std::ranges::find(lower, pipeline::nearest_word(written, lower));
  constexpr std::size_t shortest = 3;  // letters: fewer begin too many words
  if (at == lower.end() && word.size() >= shortest)
    at = std::ranges::find_if(lower, [&](const std::string& longer) { return longer.starts_with(written); });
  return fmt::format("{}: {} {}{}", word, unread_word, of,
                     at == lower.end() ? "" : nearest_known + known[static_cast<std::size_t>(at - lower.begin())]);
}

double as_single(double number) {
  constexpr double whole_numbers = 2147483648;  // 2^31
  const bool whole = std::abs(number) <= whole_numbers && std::trunc(number) == number;
  return whole ? number : static_cast<double>(static_cast<float>(number));
}

double shortest_single(double number) {
  const double single = as_single(number);
  if (!std::isfinite(single) || std::trunc(single) == single) return single;
  std::array<char, 32> text;  // of at most 15 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(single)).ptr;
  double decimal = single;
  std::from_chars(text.data(), end, decimal);
  return decimal;
}

std::string beyond_range_words(double low, double high) {
  return fmt::format("{} {:g} .. {:g} (the nearest of these counts)", beyond_range, low, high);
}

std::string ArmConfiguration::text() const {
  if (kind == Kind::any) return "";
  const std::string_view maker = configuration_words[static_cast<std::size_t>(kind)];
  if (kind != Kind::fanuc) return fmt::format("{} {}", maker, fmt::join(numbers, " "));
  return fmt::format("{} {}{}{} {} {} {}", maker, numbers[0] ? 'F' : 'N', numbers[1] ? 'U' : 'D',
                     numbers[2] ? 'T' : 'B', numbers[3], numbers[4], numbers[5]);
}

std::optional<ArmConfiguration> arm_configuration(const std::string& text) {
  std::istringstream words(text);
  std::string kind, word;
  ArmConfiguration read;
  if (!(words >> kind)) return read;
  const auto known = std::find(configuration_words.begin() + 1, configuration_words.end(), kind);
  if (known == configuration_words.end()) return {};
  read.kind = static_cast<ArmConfiguration::Kind>(known - configuration_words.begin());
  if (kind == "fanuc") {
    if (!(words >> word) || word.size() != 3) return {};
    constexpr std::array letters{"NF", "DU", "BT"};
    for (int i = 0; i < 3; ++i) {
      const std::size_t which = std::string(letters[i]).find(word[i]);
      if (which == std::string::npos) return {};
      read.numbers.push_back(static_cast<int>(which));
    }
  }
  while (words >> word) {
    const auto number = pipeline::whole_number_in<int>(word);
    if (!number) return {};
    read.numbers.push_back(*number);
  }
  const std::size_t wanted = kind == "abb" ? 4 : kind == "kuka" ? 2 : 6;
  return read.numbers.size() == wanted ? std::optional(read) : std::nullopt;
}

void Problems::add(const pipeline::Where& where, const std::string& what, const std::string& remedy,
                   const std::string& routine) {
  const auto same = [&](const Problem& p) {
    return p.where.line == where.line && p.where.column == where.column && p.where.file == where.file && p.what == what;
  };
  if (full() || std::ranges::any_of(problems_, same)) return;  // a line in a loop is reported once
  problems_.push_back({.where = where, .what = what, .remedy = remedy, .routine = routine});
}

/// Returns whether the problem is already reported. In this case adds its line and its further questions to the report.
bool Problems::counted(const Problem& problem) {
  for (Problem& known : problems_) {
    const bool same_line = known.where.line == problem.where.line && known.where.file == problem.where.file;
    if (known.about.empty() || known.decision != problem.decision ||
        (known.about != problem.about && !(known.decision && same_line)))
      continue;
    if (!same_line) known.more_uses.emplace(problem.where.file, problem.where.line);
    known.more_uses.insert(problem.more_uses.begin(), problem.more_uses.end());
    known.certain |= problem.certain;
    for (const Question& question : problem.questions)
      if (std::ranges::none_of(known.questions, [&](const Question& asked) {
            return asked.kind == question.kind && asked.name == question.name;
          }))
        known.questions.push_back(question);
    return true;
  }
  return false;
}

void Problems::add_use(Problem problem) {
  if (!full() && !counted(problem)) problems_.push_back(std::move(problem));
}

namespace {

/// Copies the forms of answers from `by`: the form is known at the use of the value itself, not at dependent values.
void note_forms(std::vector<Problem>& problems, const Problem& by) {
  for (const Question& asked : by.questions)
    for (Problem& problem : problems)
      for (Question& question : problem.questions)
        if (question.form.empty() && question.kind == asked.kind && question.name == asked.name)
          question.form = asked.form;
}

/// Whether all names that a branch depends on are questions of other problems.
bool asked_already(const std::vector<Problem>& problems, const Problem& branch) {
  const auto asked = [&](const Question& question) {
    return std::ranges::any_of(problems, [&](const Problem& known) {
      return known.certain >= branch.certain && std::ranges::any_of(known.questions, [&](const Question& q) {
               return q.kind == question.kind && q.name == question.name;
             });
    });
  };
  return branch.decision && !branch.questions.empty() && std::ranges::all_of(branch.questions, asked);
}

}  // namespace

void Problems::add_all(const Problems& others) {
  for (const Problem& problem : others.list()) {
    note_forms(problems_, problem);
    if (problem.about.empty())
      add(problem.where, problem.what, problem.remedy, problem.routine);
    else if (!asked_already(problems_, problem))
      add_use(problem);
  }
}

void Problems::hint(std::size_t from, const std::string& more) {
  for (std::size_t i = from; i < problems_.size(); ++i) problems_[i].remedy += fmt::format(" ({})", more);
}

std::size_t Problems::mistakes() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(problems_, [](const Problem& problem) { return problem.questions.empty(); }));
}

bool Problems::asks() const { return mistakes() < problems_.size(); }

bool Problems::full() const { return mistakes() >= listed_problems || problems_.size() - mistakes() >= most_questions; }

namespace {

/// Returns " (here and 74 times more)"; for a decision its lines, because each line has its own answer.
std::string further_uses(const Problem& problem) {
  constexpr int listed = 8;
  const std::size_t count = problem.more_uses.size();
  if (count == 0) return "";
  if (!problem.decision) return count == 1 ? " (here and once more)" : fmt::format(" (here and {} times more)", count);
  std::string lines;
  int shown = 0;
  for (const auto& [file, line] : problem.more_uses)
    if (++shown <= listed)
      lines += fmt::format("{}{}:{}", shown == 1 ? "" : ", ", std::filesystem::path(file).filename().string(), line);
  return fmt::format(" (here and in {}{})", lines, shown > listed ? ", ..." : "");
}

}  // namespace

std::vector<Problem> Problems::sorted() const {
  std::vector<Problem> sorted = problems_;
  std::ranges::stable_sort(sorted, [](const Problem& a, const Problem& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) < std::tie(b.where.file, b.where.line, b.where.column);
  });
  return sorted;
}

void Problems::throw_if_any() const {
  if (problems_.empty()) return;
  std::vector<Problem> all = sorted();
  std::string rest;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Problem& problem = all[i];
    problem.what = (problem.routine.empty() ? "" : problem.routine + " ") + problem.what + further_uses(problem);
    if (i > 0 && i < listed_problems)
      rest += std::string("\n") + pipeline::InputError(problem.where, problem.what, problem.remedy).what();
  }
  if (all.size() > listed_problems)
    rest += fmt::format("\n({} more are not listed here)", all.size() - listed_problems);
  throw Unread(all, rest);
}

SourceFile::SourceFile(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)), starts_{0} {
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') starts_.push_back(i + 1);
}

std::string SourceFile::line(int number) const { return from(number, 1); }

std::string SourceFile::from(int number, int column) const {
  if (number < 1 || number > static_cast<int>(starts_.size()) || column < 1) return "";
  std::size_t begin = std::min(starts_[number - 1] + static_cast<std::size_t>(column) - 1, text_.size());
  std::size_t end = std::min(text_.find('\n', begin), text_.size());
  const auto blank = [&](std::size_t i) { return static_cast<unsigned char>(text_[i]) <= ' '; };
  while (begin < end && blank(begin)) ++begin;
  while (end > begin && blank(end - 1)) --end;
  std::string line = text_.substr(begin, std::min<std::size_t>(end - begin, 200));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = c == '\t' ? ' ' : '?';
  return line;
}

}  // namespace dresslife::sim
