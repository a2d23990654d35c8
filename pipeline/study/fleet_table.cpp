#include "pipeline/study/fleet_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

struct Cell {
  std::string text;  ///< without blanks around it and quotes
  Where where;
};

using Row = std::vector<Cell>;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Cuts a table's text into rows of cells.
class TableReader {
 public:
  TableReader(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
    const std::string first = text_.substr(0, text_.find('\n'));
    for (const char other : {'\t', ';'})
      if (first.find(',') == std::string::npos && first.find(other) != std::string::npos) separator_ = other;
  }

  /// The next row that counts; empty: there is none.
  Row next() {
    while (at_ < text_.size()) {
      const bool comment = text_[at_] == '#';
      Row row = comment ? Row{} : cells();
      if (comment) skip_line();
      if (std::any_of(row.begin(), row.end(), [](const Cell& cell) { return !cell.text.empty(); }))
        return row;
    }
    return {};
  }

 private:
  void skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    line_begin_ = at_;
    ++line_;
  }
  Where here() const { return {file_, line_, static_cast<int>(at_ - line_begin_) + 1}; }
  bool at_end_of_line() const { return at_ >= text_.size() || text_[at_] == '\n'; }

  Row cells() {
    Row row;
    while (true) {
      row.push_back(cell());
      if (at_end_of_line()) break;
      ++at_;  // the separator
    }
    skip_line();
    return row;
  }

  Cell cell() {
    while (!at_end_of_line() && (text_[at_] == ' ' || (text_[at_] == '\t' && separator_ != '\t'))) ++at_;
    Cell cell{"", here()};
    if (at_ < text_.size() && text_[at_] == '"') return quoted(cell.where);
    while (!at_end_of_line() && text_[at_] != separator_) cell.text += text_[at_++];
    if (!cell.text.empty() && cell.text.back() == '\r') cell.text.pop_back();
    cell.text = trimmed(cell.text);
    return cell;
  }

  Cell quoted(const Where& begin) {
    Cell cell{"", begin};
    for (++at_;; ++at_) {
      if (at_end_of_line())
        throw InputError(begin, "a quote that opens here is never closed in its line", "close it");
      if (text_[at_] != '"') {
        cell.text += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell.text += text_[at_++];
      } else {
        break;
      }
    }
    ++at_;
    while (!at_end_of_line() && (text_[at_] == ' ' || text_[at_] == '\r')) ++at_;
    if (!at_end_of_line() && text_[at_] != separator_)
      throw InputError(here(), "text follows a closing quote", "write a quote within quotes twice");
    return cell;
  }

  std::string text_, file_;
  char separator_ = ',';
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1;
};

constexpr const char* name_column = "name";

void check_columns(const Row& titles) {
  std::map<std::string, int> seen;
  for (const Cell& title : titles) {
    if (title.text.empty())
      throw InputError(title.where, "a column has no title",
                       "name the key that it sets, as in 'routing.free_length_m'");
    if (++seen[title.text] > 1)
      throw InputError(title.where, fmt::format("two columns are titled '{}'", title.text),
                       "keep one of the two");
  }
  if (!seen.contains(name_column))
    throw InputError(titles.front().where, "the table has no column 'name'",
                     "give each row a name of its own");
}

/// Where `program` stands for it.
std::string path_of(const std::string& title, const std::string& value) {
  if (title != "program") return title;
  const std::string ending = std::filesystem::path(value).extension();
  return ending.empty() || ending == ".yaml" ? "motion" : "motion.program";
}

/// A cell as what it would be in a job.
Node value_of(const Cell& cell) {
  Node value;
  try {
    value = parse_yaml(cell.text, cell.where.file);
  } catch (const InputError&) {
    throw InputError(cell.where, fmt::format("'{}' is no value", cell.text),
                     "write it as in a job, in quotes if need be");
  }
  place_at(value, cell.where);
  return value;
}

Variant variant_of(const Row& titles, const Row& row) {
  if (row.size() != titles.size())
    throw InputError(row.back().where,
                     fmt::format("a row of {} cells (the table has {} columns)", row.size(), titles.size()),
                     "fill or quote its cells");
  Variant variant;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (titles[k].text == name_column) {
      variant.name = row[k].text;
      if (variant.name.empty()) throw InputError(row[k].where, "a row has no name", "give it one of its own");
    } else if (!row[k].text.empty()) {
      variant.changes.push_back({path_of(titles[k].text, row[k].text), value_of(row[k]), row[k].where});
    }
  }
  return variant;
}

}  // namespace

std::vector<Variant> table_variants(const std::filesystem::path& file) {
  TableReader reader(read_source(file), file.string());
  const Row titles = reader.next();
  if (titles.empty())
    throw InputError({file.string(), 1, 1}, "holds no table",
                     "write a line of column titles, then a row per job");
  check_columns(titles);
  std::vector<Variant> variants;
  std::map<std::string, int> lines;
  for (Row row = reader.next(); !row.empty(); row = reader.next()) {
    variants.push_back(variant_of(titles, row));
    const auto [known, fresh] = lines.try_emplace(variants.back().name, row.front().where.line);
    if (!fresh)
      throw InputError(row.front().where,
                       fmt::format("'{}' is the name of line {}, too", known->first, known->second),
                       "give each row a name of its own");
    if (variants.size() > most_jobs)
      throw InputError(row.front().where, fmt::format("the table has more than {} rows", most_jobs),
                       "split it");
  }
  if (variants.empty())
    throw InputError({file.string(), 1, 1}, "has titles and no row", "write a row per job");
  return variants;
}

}  // namespace dresslife::pipeline
