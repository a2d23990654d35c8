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

/// Returns whether a column contains text, also if a cell is a name like "0012".
bool is_of_text(const std::string& title) {
  const RankingColumn* const column = find_in(ranking_columns(), &RankingColumn::name, title);
  return title == "name" || title == "duty" || (column && !column->has_numbers());
}

Json json_of_cell(const std::string& text) {
  const std::optional<double> number = number_in(text);
  return number && std::isfinite(*number) ? Json(*number) : Json(text);
}

Json null() { return Json(std::nan("")); }

Json text_or_null(const std::string& text) { return text.empty() ? null() : Json(text); }

Json empty_object() { return Json(std::initializer_list<std::pair<std::string_view, Json>>{}); }

std::vector<Json> rows_of_csv(const std::string& csv) {
  CsvReader reader(csv, "table", ",");
  const CsvRow titles = reader.next();
  const std::vector<bool> is_text = mapped(titles, [](const auto& title) -> bool { return is_of_text(title.text); });
  std::vector<Json> rows;
  for (CsvRow row = reader.next(); !row.empty(); row = reader.next()) {
    Json object = empty_object();
    for (std::size_t k = 0; k < std::min(row.size(), titles.size()); ++k)
      object.add(titles[k].text, is_text[k]            ? text_or_null(row[k].text)
                                 : row[k].text.empty() ? null()
                                                       : json_of_cell(row[k].text));
    rows.push_back(object);
  }
  return rows;
}

Json warning_list(const RankingRow& row) {
  return mapped(warnings_of(row), [](const Warning& warning) { return json_of(warning); });
}

}  // namespace

Json json_of_csv(const std::string& csv) { return rows_of_csv(csv); }

Json json_of(const std::vector<RankingRow>& rows) {
  return mapped(rows, [](const RankingRow& row) {
    Json object = empty_object();
    for (const RankingColumn& column : ranking_columns()) {
      const std::string text = column.text(row);
      object.add(column.name, column.has_numbers() && !text.empty() ? json_of_cell(text) : text_or_null(text));
    }
    return object.add("warning_list", warning_list(row));
  });
}

Json json_of(const std::vector<DutyResult>& duties, const std::vector<RankingRow>& rows) {
  std::vector<Json> objects = rows_of_csv(duty_csv(duties));
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
      return json_of_cell(document.text);
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
