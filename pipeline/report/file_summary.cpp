#include "pipeline/report/file_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/readable.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t block_values = 1 << 20;  // number of values that are read at a time
constexpr std::size_t longest_value = 60;      // characters of an attribute's value

std::string number_words(double value) {
  const bool whole = std::abs(value) < 1e15 && value == std::floor(value);
  return whole ? grouped(fmt::format("{:.0f}", value)) : readable(value, 6);
}

/// Returns "sample 4501, segment 64, 3".
std::string shape_words(const FileReader& file, const Dataset& dataset) {
  std::string words;
  for (std::size_t axis = 0; axis < dataset.shape.size(); ++axis) {
    const std::string& name = dataset.shape[axis];
    const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
    if (axis > 0) words += ", ";
    words += is_number   ? name
             : axis == 0 ? fmt::format("{} {}", name, file.rows(dataset.path))
                         : fmt::format("{} {}", name, file.length(name));
  }
  return words;
}

/// Returns "-0.021 .. 0.034"; for text the first and the last value.
std::string range_words(const FileReader& file, const Dataset& dataset) {
  const std::size_t rows = file.rows(dataset.path), row = file.row_size(dataset.path);
  if (rows == 0 || row == 0) return "empty";
  if (dataset.type == Type::text) {
    const std::vector<std::string> texts = file.read<std::string>(dataset.path);
    const auto quoted = [](const std::string& text) { return '"' + shortened(text, 30) + '"'; };
    return rows == 1 ? quoted(texts[0]) : quoted(texts.front()) + " .. " + quoted(texts.back());
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<double> values;
  const std::size_t at_a_time = std::max<std::size_t>(1, block_values / row);
  for (std::size_t first = 0; first < rows; first += at_a_time) {
    file.read_rows(dataset.path, first, std::min(at_a_time, rows - first), values);
    const auto [least, most] = std::ranges::minmax_element(values);
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  return low == high ? number_words(low) : number_words(low) + " .. " + number_words(high);
}

std::string indented(const std::string& text) {
  std::string lines = "  ";
  for (const char letter : text) lines += letter == '\n' ? std::string("\n  ") : std::string(1, letter);
  return lines + '\n';
}

}  // namespace

std::string file_summary(const std::filesystem::path& path) {
  const Format* format = format_of(path);
  if (!format)
    throw InputError({path.string()}, "is no file of dresslife's",
                     "name a job (YAML), or a motion.h5, strain.h5 or life.h5");
  const FileReader file(path, *format);
  std::string text = fmt::format("{}: {} version {}, {}\nmade by\n{}", path.string(), format->name, format->version,
                                 format->purpose, indented(file.text_attribute("history")));
  for (const AttributeInfo& attribute : format->attributes) {
    if (!file.has_attribute(attribute.name)) continue;
    const std::string value = attribute.is_text
                                  ? '"' + shortened(file.text_attribute(attribute.name), longest_value) + '"'
                                  : number_words(file.number_attribute(attribute.name));
    text += fmt::format("{:<24} {:<14} {}\n", attribute.name, value, attribute.meaning);
  }
  for (const Dataset& dataset : format->datasets) {
    if (!file.has(dataset.path)) continue;
    text += fmt::format("{:<24} ({}) {}  {}\n{:<24} {}\n", dataset.path, shape_words(file, dataset),
                        range_words(file, dataset), dataset.unit == "1" ? "" : dataset.unit, "", dataset.meaning);
  }
  return text;
}

}  // namespace dresslife::pipeline
