#include "pipeline/resolve/radians.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/warning_words.h"

namespace dresslife::pipeline {
namespace {

using std::numbers::pi;

bool is_multiple(double value, double part, double tolerance) {
  const double count = std::round(value / part);
  return count >= 1 && std::abs(value - count * part) <= tolerance;
}

bool may_be_radians(double value) {
  constexpr double typed = 2e-3, exact = 5e-5;  // two decimals (3.14); four decimals
  const double size = std::abs(value);
  return size <= 2 * pi + typed && (is_multiple(size, pi / 4, typed) || is_multiple(size, pi / 12, exact));
}

std::string degrees_text(double radians) { return fmt::format("{:.4g}", std::round(radians * 180 / pi)); }

void add_warnings(const Node& node, const std::string& path, std::vector<Warning>& warnings) {
  for (std::size_t k = 0; k < node.items.size(); ++k)
    add_warnings(node.items[k], fmt::format("{}[{}]", path, k + 1), warnings);
  for (const Entry& entry : node.entries) {
    const std::string key = path + "." + entry.key;
    if (!entry.key.ends_with("_deg") || entry.key == "pre_twist_deg") {
      add_warnings(entry.value, key, warnings);
      continue;
    }
    const bool is_list = entry.value.is_list();
    const std::vector<Node> parts = is_list ? entry.value.items : std::vector<Node>{entry.value};
    std::vector<std::string> written, meant;
    bool all = true, any = false;
    for (const Node& part : parts) {
      const double value = number_in(part.text).value_or(NAN);
      all &= value == 0 || may_be_radians(value);
      any |= value != 0;
      written.push_back(fmt::format("{:.6g}", value));
      meant.push_back(degrees_text(value));
    }
    if (!all || !any) continue;
    const auto list = [&](const std::vector<std::string>& of) {
      return fmt::format(fmt::runtime(is_list ? "[{}]" : "{}"), fmt::join(of, ", "));
    };
    warnings.push_back(warning_of(WarningKind::motion, entry.where.text(),
                                  fmt::format("{} is {} (limit: no multiples of pi)", key, list(written)),
                                  "radians instead of degrees",
                                  fmt::format("{}: {} if that was radians", key, list(meant))));
  }
}

}  // namespace

std::vector<Warning> radians_in(const Node& map, const std::string& path) {
  std::vector<Warning> warnings;
  add_warnings(map, path, warnings);
  return warnings;
}

}  // namespace dresslife::pipeline
