#include "pipeline/study/row_warnings.h"

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace dresslife::pipeline {
namespace {

/// Returns a warning with the path of its file from the folder of the user. A stage states the path from the folder of the study.
Warning placed(Warning warning, const RankingRow& row) {
  const std::filesystem::path place = row.life_file.parent_path().parent_path() / warning.where,
                              file = place.string().substr(0, place.string().find(".yaml:") + 5);
  if (warning.where.find(".yaml:") != std::string::npos && kind_of(file) == FileKind::file)
    warning.where = place.string();
  return warning;
}

/// jobs: words that precede the name of the job; may be empty.
std::string lines_of(const RankingRow& row, const Warning& warning, const std::string& jobs = "") {
  return Warning{warning.kind, jobs + row.job, placed(warning, row).text()}.paragraph();
}

/// Returns the warning of a kind of the last job that has one, and the number of these jobs. The last job of a ranking has the
/// shortest life.
std::string lines_of_kind(const std::vector<RankingRow>& rows, WarningKind kind) {
  std::string last;
  std::size_t jobs = 0;
  for (const RankingRow& row : rows) {
    if (!row.done()) continue;
    const std::vector<Warning> warnings = warnings_of(row);
    const Warning* const found = find_in(warnings, &Warning::kind, kind);
    if (!found) continue;
    ++jobs;
    last = lines_of(row, *found, jobs < 2 ? "" : fmt::format("{} jobs, {}: ", jobs, title(kind)));
  }
  return last;
}

/// Returns the key that all warnings about doubtful input are about: " (least_bend_radius_mm)". Empty: there is no such key.
std::string doubtful_key(const std::vector<Warning>& warnings) {
  std::string key;
  for (const Warning& warning : warnings) {
    if (warning.kind != WarningKind::material) continue;
    const std::string first = warning.words.substr(0, warning.words.find(' '));
    if (first.find('_') == std::string::npos || (!key.empty() && first != key)) return "";
    key = first;
  }
  return fmt::format(" ({})", key);
}

/// Returns "twist x3"; empty: there is no warning of this kind.
std::string kind_words(const std::vector<Warning>& warnings, WarningKind kind) {
  const auto count = std::ranges::count(warnings, kind, &Warning::kind);
  if (count == 0) return "";
  return (count == 1 ? std::string(title(kind)) : fmt::format("{} x{}", title(kind), count)) +
         (kind == WarningKind::material ? doubtful_key(warnings) : "");
}

}  // namespace

bool spoils_plan(const Warning& warning) {
  return spoils_plan(warning.kind) || warning.words.find(records_contradict) != std::string::npos;
}

std::vector<Warning> warnings_of(const RankingRow& row) {
  if (!row.has_result()) return {};
  if (row.warnings) return *row.warnings;
  if (row.force_ok()) return {};
  return {{WarningKind::force, "", force_words(row)}};
}

bool has_paths(const RankingRow& row) {
  return std::ranges::any_of(warnings_of(row),
                             [](const Warning& warning) { return warning.where.find('/') != std::string::npos; });
}

std::string warning_kinds(const RankingRow& row, bool with_other_values) {
  const std::vector<Warning> warnings = warnings_of(row);
  std::vector<std::string> words;
  for (int k = 0; k < warning_kinds_count; ++k) {
    const auto kind = static_cast<WarningKind>(k);
    if (std::string of_kind = kind_words(warnings, kind);
        !of_kind.empty() && (with_other_values || kind != WarningKind::other_values))
      words.push_back(std::move(of_kind));
  }
  return joined(words, ", ");
}

std::string doubtful_input(const RankingRow& row) { return kind_words(warnings_of(row), WarningKind::material); }

std::string warning_lines(const std::vector<RankingRow>& rows) {
  constexpr std::size_t most_lines = 12;
  const char* const places = "in ranking.csv, in the report and in the jobs' logs";
  std::size_t count = 0, at_other_values = 0;
  std::string text;
  for (const RankingRow& row : rows)
    for (const Warning& warning : row.done() ? warnings_of(row) : std::vector<Warning>{})
      if (warning.kind == WarningKind::other_values && rows.size() > 1)
        ++at_other_values;
      else if (++count <= most_lines)
        text += lines_of(row, warning);
  if (count > most_lines) {
    text.clear();
    for (int k = 0; k < warning_kinds_count; ++k) text += lines_of_kind(rows, static_cast<WarningKind>(k));
    return text + fmt::format("{} warnings in all: {}\n", count + at_other_values, places);
  }
  // The jobs' own values keep these limits, so the first warning is enough in a study.
  if (rows.size() > 1) text += lines_of_kind(rows, WarningKind::other_values);
  if (at_other_values > 1) text += fmt::format("{} warnings on limits at other values: {}\n", at_other_values, places);
  return text;
}

}  // namespace dresslife::pipeline
