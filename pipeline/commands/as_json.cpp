#include "pipeline/commands/as_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/commands/options.h"
#include "pipeline/settings/document.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/ranking_columns.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

Json json_of_word(const std::string& text) {
  const std::optional<double> number = number_in(text);
  return number && std::isfinite(*number) ? Json(*number) : Json(text);
}

Json null() { return Json(std::nan("")); }

Json text_or_null(const std::string& text) { return text.empty() ? null() : Json(text); }

Json empty_object() { return Json(std::initializer_list<std::pair<std::string_view, Json>>{}); }

/// is_text: the column contains text, also if a cell is a name like "0012".
Json json_of_cell(const std::string& text, bool is_text) {
  return is_text || text.empty() ? text_or_null(text) : json_of_word(text);
}

std::vector<Json> objects_of(const CsvTable& table) {
  return mapped(table.rows, [&](const std::vector<std::string>& row) {
    Json object = empty_object();
    for (std::size_t k = 0; k < row.size(); ++k)
      object.add(table.columns[k].title, json_of_cell(row[k], table.columns[k].is_text));
    return object;
  });
}

Json warning_list(const RankingRow& row) {
  return mapped(warnings_of(row), [](const Warning& warning) { return json_of(warning); });
}

}  // namespace

Json json_of(const CsvTable& table) { return objects_of(table); }

Json json_of(const std::vector<RankingRow>& rows) {
  return mapped(rows, [](const RankingRow& row) {
    Json object = empty_object();
    for (const RankingColumn& column : ranking_columns())
      object.add(column.name, json_of_cell(column.text(row), !column.has_numbers()));
    return object.add("warning_list", warning_list(row));
  });
}

Json json_of(const std::vector<DutyResult>& duties, const std::vector<RankingRow>& rows) {
  std::vector<Json> objects = objects_of(duty_table(duties));
  auto object = objects.begin();
  for (const DutyResult& duty : duties)
    for (const DutyPart& part : duty.parts)
      (object++)->add({{"do_not_plan", duty.doubtful},
                       {"confirm_first", duty.unconfirmed},
                       {"warning_list", warning_list(*find_in(rows, &RankingRow::job, part.job))}});
  return objects;
}

Json json_of_windows(const Fleet& fleet, const Plan& plan) {
  std::vector<Json> windows;
  for (std::size_t n = 0; n < plan.windows.size(); ++n)
    windows.push_back({{"first_day", day_text(plan.windows[n].first)},
                       {"last_day", day_text(plan.windows[n].last)},
                       {"replace", replaced_in(fleet, plan, n)},
                       {"replace_of_later", later_in(plan, n)}});
  return windows;
}

Json json_of(const Warning& warning) {
  const WarningParts parts = parts_of(warning.words);
  Json values = empty_object();
  for (const KeyValue& of : warning.remedy) values.add(of.key, json_of(parse_yaml(of.value, of.key)));
  return {
      {"kind", word(warning.kind)}, {"where", text_or_null(warning.where)},      {"text", warning.words},
      {"problem", parts.problem},   {"likely_cause", text_or_null(parts.cause)}, {"remedy", text_or_null(parts.remedy)},
      {"remedy_values", values}};
}

Json json_of(const Node& document) {
  switch (document.kind) {
    case Node::Kind::null:
      return null();
    case Node::Kind::scalar:
      if (document.quoted) return document.text;
      if (document.text == "true" || document.text == "false") return document.text == "true";
      return json_of_word(document.text);
    case Node::Kind::list:
      return mapped(document.items, [](const Node& item) { return json_of(item); });
    case Node::Kind::map:
      break;
  }
  Json object = empty_object();
  for (const Entry& entry : document.entries) object.add(entry.key, json_of(entry.value));
  return object;
}

void JobList::add(const std::string& job, const StateWords& words) {
  if (!json_) return print(shown(fmt::format("{:<40} {}\n", job, words.line())));
  jobs_.push_back({{"job", job}, {"state", words.state}, {"reason", text_or_null(words.reason)}});
}

void JobList::end(const std::string& words) const { print(json_ ? Json(jobs_).text + "\n" : words); }

}  // namespace dresslife::pipeline
