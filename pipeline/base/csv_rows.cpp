#include "pipeline/base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "pipeline/base/joined.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return whole_number_in<double>(text);
}

CsvReader::CsvReader(std::string text, std::string file, std::string_view separators)
    : text_(std::move(text)), file_(std::move(file)), separators_(separators) {
  if (text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
}

CsvReader::CsvReader(PlainFile file, std::string_view separators)
    : CsvReader(file.beginning(0), file.name().string(), separators) {
  source_ = std::move(file);
}

double CsvReader::share_read() const {
  return source_ ? static_cast<double>(read_) / static_cast<double>(std::max<std::uint64_t>(1, source_->size())) : 1;
}

/// Makes text_ hold the whole line at at_.
void CsvReader::read_on() {
  constexpr std::uint64_t block = 1 << 20;
  if (!source_ || read_ == source_->size() || text_.find('\n', at_) != text_.npos) return;
  text_.erase(0, at_);
  at_ = 0;
  const std::uint64_t count = std::min(block, source_->size() - read_), before = text_.size();
  text_.resize(before + count);
  source_->read(text_.data() + before, count, read_);
  if (read_ == 0 && text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
  read_ += count;
  if (text_.find('\n') == text_.npos && read_ < source_->size())
    throw InputError({file_, line_ + 1, 1}, fmt::format("has a line of more than {} bytes", count),
                     "name a file of comma separated values");
}

CsvRow CsvReader::next() {
  for (read_on(); at_ < text_.size(); read_on()) {
    ++line_;
    line_begin_ = at_;
    while (at_blank()) ++at_;
    CsvRow row;
    if (text_.compare(at_, 1, "#") != 0) at_ = line_begin_, row = cells();
    skip_line();
    if (std::ranges::any_of(row, [](const CsvCell& cell) { return !cell.text.empty(); })) return row;
  }
  return {};
}

void CsvReader::skip_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

bool CsvReader::at_blank() const {
  if (at_end_of_line() || text_[at_] == separator_) return false;
  return static_cast<unsigned char>(text_[at_]) <= ' ';
}

CsvRow CsvReader::cells() {
  if (separator_ == '\0') {
    const std::string_view line(&text_[at_], std::min(text_.find('\n', at_), text_.size()) - at_);
    if (line.find_first_not_of(" \t\r") == line.npos) return {};
    constexpr std::string_view named = "sep=";  // the first line of some exports for Excel
    const std::string_view stated = line.starts_with(named) ? trimmed(line.substr(named.size())) : "";
    if (stated.size() == 1 && separators_.find(stated[0]) != separators_.npos) {
      separator_ = stated[0];
      return {};
    }
    std::string outside;  // of quotes
    bool quoted = false;
    for (const char letter : line) {
      quoted ^= letter == '"';
      if (!quoted) outside += letter;
    }
    const auto found =
        std::ranges::find_if(separators_, [&](char separator) { return outside.find(separator) != outside.npos; });
    separator_ = found == separators_.end() ? separators_.front() : *found;
  }
  CsvRow row{cell()};
  while (!at_end_of_line()) {
    ++at_;  // the separator
    row.push_back(cell());
  }
  return row;
}

CsvCell CsvReader::cell() {
  while (at_blank()) ++at_;
  CsvCell cell{"", line_, static_cast<int>(at_ - line_begin_) + 1};
  if (!at_end_of_line() && text_[at_] == '"') {
    read_quoted(cell);
    return cell;
  }
  while (!at_end_of_line() && text_[at_] != separator_) cell.text += text_[at_++];
  while (!cell.text.empty() && static_cast<unsigned char>(cell.text.back()) <= ' ') cell.text.pop_back();
  return cell;
}

void CsvReader::read_quoted(CsvCell& cell) {
  for (++at_;; ++at_) {
    if (at_end_of_line())
      throw InputError(where(cell), "a quote that opens here is never closed in its line", "close it");
    if (text_[at_] == '"') {
      if (text_.compare(at_ + 1, 1, "\"") != 0) break;
      ++at_;
    }
    cell.text += text_[at_];
  }
  ++at_;
  while (at_blank()) ++at_;
  if (!at_end_of_line() && text_[at_] != separator_)
    throw InputError({file_, line_, static_cast<int>(at_ - line_begin_) + 1}, "text follows a closing quote",
                     "write a quote within quotes twice");
}

void check_width(const CsvReader& table, const CsvRow& titles, const CsvRow& row) {
  if (row.size() == titles.size()) return;
  const auto digits = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  };
  constexpr std::size_t decimals = 3;
  std::string remedy = "fill its cells, and quote those that contain the separator, such as \"12,5\"";
  for (std::size_t k = row.size() - 1; table.separator() == ',' && row.size() > titles.size() && k-- > 0;)
    if (digits(row[k].text) && digits(row[k + 1].text) && row[k + 1].text.size() <= decimals)
      remedy = fmt::format("if {0},{1} is one number with a decimal comma, write {0}.{1} or quote it: \"{0},{1}\"",
                           row[k].text, row[k + 1].text);
  throw InputError(table.where(row.back()),
                   fmt::format("a row of {} cells (the table has {} columns)", row.size(), titles.size()), remedy);
}

void check_titles(const CsvReader& table, const CsvRow& titles, std::initializer_list<std::string_view> needed) {
  std::set<std::string_view> seen;
  for (const CsvCell& title : titles) {
    if (title.text.empty())
      throw InputError(table.where(title), "a column has no title", "give it one, or remove the column");
    if (!seen.insert(title.text).second)
      throw InputError(table.where(title), fmt::format("two columns are titled '{}'", title.text),
                       "keep one of the two");
  }
  for (const std::string_view name : needed) {
    if (seen.contains(name)) continue;
    for (const CsvCell& title : titles)
      if (lower_case(title.text) == name)
        throw InputError(table.where(title),
                         fmt::format("the table has no column '{}' (it has '{}')", name, title.text),
                         fmt::format("write '{}' instead of '{}'", name, title.text));
    throw InputError(table.where(titles.front()),
                     fmt::format("the table has no column '{}' (it has {})", name, joined(seen, ", ")),
                     "add it, or rename one");
  }
}

std::string harmless(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0';
  const bool formula = !number && !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos;
  return shown(formula ? "'" + text : text);
}

std::string csv_cell(const std::string& written) {
  const std::string text = harmless(written);
  if (text.find_first_of(",\"\r\n") == std::string::npos && !text.starts_with('#')) return text;
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

std::string csv_text(const CsvTable& table) {
  std::string text = joined(mapped(table.columns, &CsvTable::Column::title), ",") + '\n';
  for (const std::vector<std::string>& row : table.rows) text += joined(mapped(row, csv_cell), ",") + '\n';
  return text;
}

}  // namespace dresslife::pipeline
