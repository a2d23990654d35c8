// CSV files: lines as cells that know their column, for files in which every number has a meaning; and cells to write.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::sim {

struct CsvCell {
  std::string_view text;  ///< without blanks around it
  int column = 0;         ///< of its first character, from 1
};

std::vector<CsvCell> cells_of(std::string_view line);

/// A whole decimal number; nothing else is one.
std::optional<double> number_in(std::string_view text);

/// Calls `take` for every line but blank ones and those that begin with #, with its cells and its number from
/// 1, and returns the number of the last line. key: of the job that names the file. Errors: InputError when
/// it cannot be read; DiskError.
int read_csv(const std::filesystem::path& file, const char* key,
             const std::function<void(const std::vector<CsvCell>&, int)>& take);

}  // namespace dresslife::sim

namespace dresslife::pipeline {

/// Text for a spreadsheet or a terminal: what would be a formula there begins with an apostrophe, and no letter acts
/// or hides (shown()).
std::string harmless(const std::string& text);

/// The same as a cell, in quotes where it needs them.
std::string csv_cell(const std::string& text);

}  // namespace dresslife::pipeline
