#include "pipeline/settings/problems.h"

#include <algorithm>
#include <tuple>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"

namespace dresslife::pipeline {
namespace {

/// More problems are not useful to a reader. The messages for a million wrong steps would be longer than their file.
constexpr std::size_t most_problems = 100;

std::string lines_of(const std::vector<Problem>& problems) { return joined(mapped(problems, &Problem::line), "\n"); }

/// Returns whether the path `inner` is equal to `outer` or inside of it: "routing.rings[2]" is inside of "routing".
bool lies_in(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) &&
         (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

}  // namespace

InputErrors::InputErrors(std::vector<Problem> problems)
    : InputError({}, "", ""), problems_(std::move(problems)), text_(lines_of(problems_)) {}

void Problems::add(const Where& where, const std::string& what, const std::string& remedy, const std::string& key) {
  note({where, key, InputError(where, what, remedy).what()});
}

void Problems::note(Problem problem) {
  if (!problem.key.empty()) keys_.insert(problem.key);
  const bool known = std::ranges::any_of(problems_, [&](const Problem& other) { return other.line == problem.line; });
  if (known) return;
  if (problems_.size() < most_problems)
    problems_.push_back(std::move(problem));
  else
    more_ = true;
}

bool Problems::touch(const std::string& key) const {
  return std::ranges::any_of(
      keys_, [&](const std::string& refused) { return lies_in(refused, key) || lies_in(key, refused); });
}

void Problems::finish(const std::string& first_file) const {
  if (problems_.empty()) return;
  std::vector<std::string> files{first_file};  // in the order of their first problem
  for (const Problem& problem : problems_)
    if (std::ranges::find(files, problem.where.file) == files.end()) files.push_back(problem.where.file);
  const auto place = [&](const Problem& problem) {
    return std::make_tuple(std::ranges::find(files, problem.where.file), problem.where.line, problem.where.column);
  };
  std::vector<Problem> sorted = problems_;
  std::ranges::stable_sort(sorted, [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  if (more_)
    sorted.push_back({Where{first_file, 0, 0}, "",
                      fmt::format("{}: error: only the first {} problems are shown; correct them first", first_file,
                                  most_problems)});
  throw InputErrors(std::move(sorted));
}

}  // namespace dresslife::pipeline
