#include "pipeline/study/fleet_table.h"

#include <fmt/format.h>

#include <map>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/lists.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

constexpr const char* name_column = "name";

/// Returns the key path of a column: for `program` "motion" or "motion.program", by the ending of the value.
std::string path_of(const std::string& title, const std::string& value) {
  if (title != "program") return title;
  const std::string ending = std::filesystem::path(value).extension();
  return ending.empty() || ending == ".yaml" ? "motion" : "motion.program";
}

/// Returns the value of a cell, parsed as in a job.
Node value_of(const CsvCell& cell, const Where& where) {
  Node value;
  try {
    value = parse_yaml(cell.text, where.file);
  } catch (const InputError&) {
    throw InputError(where, fmt::format("'{}' is no value", cell.text), "write it as in a job, in quotes if need be");
  }
  if (cell.text.find('#') != std::string::npos && !value.quoted && !value.is_list() && !value.is_map() &&
      value.text != cell.text)
    throw InputError(where, fmt::format("in '{}' the text behind # is a comment", cell.text),
                     fmt::format("write '{}' with these quotes", cell.text));
  place_at(value, where);
  return value;
}

Variant variant_of(const CsvReader& table, const CsvRow& titles, const CsvRow& row) {
  check_width(table, titles, row);
  Variant variant;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Where where = table.where(row[k]);
    if (titles[k].text == name_column) {
      variant.name = row[k].text;
      if (variant.name.empty()) throw InputError(where, "a row has no name", "give it one of its own");
    } else if (!row[k].text.empty()) {
      const std::string path = path_of(titles[k].text, row[k].text);
      if (const Change* const other = find_in(variant.changes, &Change::path, path))
        throw InputError(where,
                         fmt::format("{} is also set at {}: one would replace the other", path, other->where.text()),
                         "keep one of the two");
      variant.changes.push_back({path, value_of(row[k], where), where});
    }
  }
  return variant;
}

}  // namespace

std::vector<Variant> table_variants(const std::filesystem::path& file) {
  const std::string text = read_source(file);
  if (text.starts_with("PK\x03\x04") || text.find('\0') != std::string::npos)
    throw InputError({file.string()}, "is no text in UTF-8 (it may be a spreadsheet or UTF-16)",
                     "save it as CSV in UTF-8 by the spreadsheet program");
  CsvReader reader(text, file.string());
  const CsvRow titles = reader.next();
  if (titles.empty())
    throw InputError({file.string(), 1, 1}, "holds no table", "write a line of column titles, then a row per job");
  check_titles(reader, titles, {name_column});
  std::vector<Variant> variants;
  std::map<std::string, int> lines;
  for (CsvRow row = reader.next(); !row.empty(); row = reader.next()) {
    variants.push_back(variant_of(reader, titles, row));
    const auto [known, fresh] = lines.try_emplace(variants.back().name, reader.line());
    if (!fresh)
      throw InputError(reader.where(row.front()),
                       fmt::format("'{}' is the name of line {}, too", known->first, known->second),
                       "give each row a name of its own");
    if (variants.size() > most_jobs)
      throw InputError(reader.where(row.front()), fmt::format("the table has more than {} rows", most_jobs),
                       "split it");
  }
  if (variants.empty()) throw InputError({file.string(), 1, 1}, "has titles and no row", "write a row per job");
  return variants;
}

}  // namespace dresslife::pipeline
