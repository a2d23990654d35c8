#include "pipeline/base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace dresslife::sim {

std::vector<CsvCell> cells_of(std::string_view line) {
  std::vector<CsvCell> cells;
  for (size_t begin = 0; begin <= line.size();) {
    const size_t comma = std::min(line.find(',', begin), line.size());
    size_t first = begin, last = comma;
    while (first < last && line[first] == ' ') ++first;
    while (last > first && line[last - 1] == ' ') --last;
    cells.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    begin = comma + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

int read_csv(const std::filesystem::path& file, const char* key,
             const std::function<void(const std::vector<CsvCell>&, int)>& take) {
  std::ifstream input(file);
  if (!input || std::filesystem::is_directory(file))
    throw pipeline::InputError({file.string()}, fmt::format("{} cannot be read", key),
                               "check the file's name and rights");
  int number = 0;
  for (std::string line; std::getline(input, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // byte order mark
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\r' || c == '\t'; }, ' ');
    if (line.find_first_not_of(' ') == std::string::npos || line.starts_with('#')) continue;
    take(cells_of(line), number);
  }
  return number;
}

}  // namespace dresslife::sim
