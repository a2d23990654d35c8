#include "pipeline/base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>

#include "pipeline/base/limits.h"
#include "pipeline/base/plain_file.h"

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

namespace {

/// Calls `take` for each line of a file, a block of which is read at a time.
void each_line(const pipeline::PlainFile& file, const std::function<void(std::string&)>& take) {
  constexpr std::size_t block = 1 << 16;
  std::string line, read;
  for (std::uint64_t at = 0; at < file.size(); at += read.size()) {
    read.resize(static_cast<std::size_t>(std::min<std::uint64_t>(block, file.size() - at)));
    file.read(read.data(), read.size(), at);
    for (std::size_t begin = 0; begin < read.size();) {
      const std::size_t end = read.find('\n', begin);
      line.append(read, begin, end - begin);
      if (end == std::string::npos) break;
      take(line);
      line.clear();
      begin = end + 1;
    }
  }
  if (!line.empty()) take(line);
}

}  // namespace

int read_csv(const std::filesystem::path& file, const char* key,
             const std::function<void(const std::vector<CsvCell>&, int)>& take) {
  if (pipeline::kind_of(file) != pipeline::FileKind::file)
    throw pipeline::InputError({file.string()}, fmt::format("{} cannot be read", key),
                               "check the file's name and rights");
  const pipeline::PlainFile input(file);
  input.check_is_text();
  int number = 0;
  each_line(input, [&](std::string& line) {
    ++number;
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // byte order mark
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\r' || c == '\t'; }, ' ');
    if (line.find_first_not_of(' ') == std::string::npos || line.starts_with('#')) return;
    take(cells_of(line), number);
  });
  return number;
}

}  // namespace dresslife::sim

namespace dresslife::pipeline {

std::string harmless(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0';
  const bool formula =
      !number && !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos;
  return shown(formula ? "'" + text : text);
}

std::string csv_cell(const std::string& written) {
  const std::string text = harmless(written);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

}  // namespace dresslife::pipeline
