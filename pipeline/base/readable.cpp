#include "pipeline/base/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dresslife::pipeline {
namespace {

constexpr double longest_written_out = 1e9;
constexpr double shortest_written_out = 1e-4;

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace

std::string short_decimal(double value, int most_decimals) {
  std::string text = fmt::format("{:.{}f}", value, most_decimals);
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string grouped(std::string digits) {
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(digits.find_first_not_of("0123456789", first), digits.size());
  for (std::size_t place = end; place > first + 3;) digits.insert(place -= 3, ",");
  return digits;
}

std::string readable(double value, int figures) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "unlimited" : "-unlimited";
  if (value == 0) return "0";
  // The value is rounded first, so that 999.6 becomes 1,000 and not 1e+03.
  const std::string text = fmt::format("{:.{}e}", value, figures - 1);
  const double rounded = std::strtod(text.c_str(), nullptr);  // accepts values beyond the range of a double
  const double size = std::abs(rounded);
  if (size >= longest_written_out || size < shortest_written_out) return text;
  const int decimals = std::max(0, figures - 1 - static_cast<int>(std::floor(std::log10(size) + 1e-12)));
  return grouped(fmt::format("{:.{}f}", rounded, decimals));
}

std::string life_text(double life, int figures) { return std::isinf(life) ? "no damage" : readable(life, figures); }

std::string hours_text(double hours) { return life_text(hours) + (std::isinf(hours) ? "" : " h"); }

std::string calendar_words(double months) {
  constexpr double days_per_month = 365.2425 / 12, months_of_years = 36;
  if (std::isfinite(months) && months >= months_of_years) return readable(months / 12, 2) + " years";
  if (!(months < 1)) return std::isinf(months) || std::isnan(months) ? readable(months) : readable(months) + " months";
  const double days = months * days_per_month;
  return days < 1 ? "less than a day" : readable(days, 2) + " days";
}

std::string calendar_text(double months) { return std::isinf(months) ? life_text(months) : calendar_words(months); }

std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char byte) { return !continues(byte); }));
}

std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent) {
  std::string lines, line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (!line.empty() && columns_of(indent) + columns_of(line) + 1 + columns_of(word) > columns) {
      lines += indent + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? lines : lines + indent + line + '\n';
}

std::string wrapped_lines(const std::string& text, std::size_t columns) {
  constexpr std::size_t hanging = 4;
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (columns_of(line) <= columns) {
      lines += line + '\n';
      continue;
    }
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    lines += wrapped(line.substr(blanks), columns, std::string(blanks + hanging, ' ')).substr(hanging);
  }
  return lines;
}

std::string shortened(const std::string& text, std::size_t columns) {
  if (columns_of(text) <= columns) return text;
  const std::size_t kept = columns > 3 ? columns - 3 : 0;
  std::size_t bytes = 0;
  for (std::size_t character = 0; character < kept; ++character) do
      ++bytes;
    while (bytes < text.size() && continues(text[bytes]));
  return text.substr(0, bytes) + std::string(std::min<std::size_t>(columns, 3), '.');
}

}  // namespace dresslife::pipeline
