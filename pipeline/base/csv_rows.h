// Reads CSV files as rows of cells. Each cell has its line and column. Also writes cells. Quotes follow RFC 4180. Blank lines,
// rows of empty cells and lines that begin with # are skipped. A first line such as "sep=;" names the separator.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {

struct CsvCell {
  std::string text;          ///< without quotes and without blanks at both ends
  int line = 0, column = 0;  ///< of the first character, from 1
};
using CsvRow = std::vector<CsvCell>;

/// Returns the number that is the whole text, with or without a sign, also "inf" and "nan"; std::nullopt for any other text.
std::optional<double> number_in(std::string_view text);

class CsvReader {
 public:
  /// file: for messages. separators: the first of these characters that occurs in the first row outside of quotes is the separator.
  CsvReader(std::string text, std::string file, std::string_view separators = ",\t;");
  /// Reads a file of any size and keeps a few megabytes of it in memory. Errors: InputError for a line longer than one megabyte.
  CsvReader(PlainFile file, std::string_view separators);

  /// Returns the next row; empty at the end of the file. Errors: InputError for a quote that is not closed in its line, or that
  /// has text behind it.
  CsvRow next();
  char separator() const { return separator_; }  ///< 0 before the first row
  double share_read() const;                     ///< share of the file that was read, 0 .. 1
  int line() const { return line_; }  ///< of the row that next() returned; at the end of the file the last line
  Where where(const CsvCell& cell) const { return {file_, cell.line, cell.column}; }

 private:
  void read_on();
  void skip_line();
  bool at_end_of_line() const { return at_ >= text_.size() || text_[at_] == '\n'; }
  bool at_blank() const;
  CsvRow cells();
  CsvCell cell();
  void read_quoted(CsvCell& cell);

  std::string text_, file_;
  std::optional<PlainFile> source_;  // of the text behind text_
  std::uint64_t read_ = 0;           // bytes of source_ that were read
  std::string_view separators_;
  char separator_ = '\0';  // 0: not known yet
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 0;
};

/// Checks that a row has as many cells as titles. Errors: InputError; its remedy is that of decimal commas if the row has two
/// neighbours such as "80" and "5" too many.
void check_width(const CsvReader& table, const CsvRow& titles, const CsvRow& row);

/// Checks the row of titles. Errors: InputError for an empty title, a title that occurs twice, and a missing one of `needed`.
void check_titles(const CsvReader& table, const CsvRow& titles, std::initializer_list<std::string_view> needed);

/// Returns the text so that a spreadsheet or a terminal only displays it: a text that a spreadsheet would take for a formula
/// begins with an apostrophe, and control characters are escaped (shown()).
std::string harmless(const std::string& text);

/// Returns harmless(text) as a CSV cell, in quotes if it needs them: a row that began with # would be a comment.
std::string csv_cell(const std::string& text);

/// A table for other programs, as CSV and as JSON.
struct CsvTable {
  struct Column {
    std::string title;
    bool is_text = false;  ///< false: numbers
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows{};  ///< (row, column) cells as they are; empty: no value
};
std::string csv_text(const CsvTable& table);

}  // namespace dresslife::pipeline
