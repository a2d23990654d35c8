// Files of comma separated values, as rows of cells that know their place, and cells to write. Quotes after RFC 4180. Blank lines,
// rows of empty cells and lines that begin with # do not count.
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
  std::string text;          ///< without blanks around it and quotes
  int line = 0, column = 0;  ///< of its first character, from 1
};
using CsvRow = std::vector<CsvCell>;

/// A whole decimal number, with a sign or not; nothing else is one.
std::optional<double> number_in(std::string_view text);

class CsvReader {
 public:
  /// file: for messages. separators: of them the first that occurs in the first line that counts.
  CsvReader(std::string text, std::string file, std::string_view separators = ",\t;");
  /// A file of any size, of which a few megabytes are in memory at a time. Errors: InputError for a line longer than one of them.
  CsvReader(PlainFile file, std::string_view separators);

  /// The next row that counts; empty: there is none. Errors: InputError for a quote that is not closed in its
  /// line, or with text behind it.
  CsvRow next();
  char separator() const { return separator_; }  ///< 0 before the first row
  double share_read() const;                     ///< of a file, 0 .. 1
  int line() const { return line_; }  ///< of the row that next() gave; at the end the last line
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
  std::optional<PlainFile> source_;  // of what follows text_
  std::uint64_t read_ = 0;           // bytes of it that were read
  std::string_view separators_;
  char separator_ = '\0';  // not known yet
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 0;
};

/// Errors: InputError for a title that is empty or occurs twice, and where one of `needed` is missing.
void check_titles(const CsvReader& table, const CsvRow& titles, std::initializer_list<std::string_view> needed);

/// Text for a spreadsheet or a terminal: what would be a formula there begins with an apostrophe, and no letter acts
/// or hides (shown()).
std::string harmless(const std::string& text);

/// The same as a cell, in quotes where it needs them.
std::string csv_cell(const std::string& text);

}  // namespace dresslife::pipeline
