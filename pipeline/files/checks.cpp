#include "pipeline/files/checks.h"

#include <fmt/format.h>

#include "pipeline/files/files.h"
#include "pipeline/files/words.h"

namespace dresslife::pipeline {
namespace {

constexpr char checks_name[] = "checks";

}  // namespace

std::vector<ResultValue> results_of_checks(const std::filesystem::path& motion_file) {
  const FileReader file(motion_file, motion_format());
  if (!file.has("/check/name")) return {};
  const auto names = file.read<std::string>("/check/name");
  const auto values = file.read<double>("/check/value"), limits = file.read<double>("/check/limit");
  std::string lines;
  for (std::size_t k = 0; k < names.size(); ++k) lines += fmt::format("{} {} {}\n", values[k], limits[k], names[k]);
  return {{checks_name, lines}};
}

std::vector<CheckedValue> checks_in(const std::vector<ResultValue>& results) {
  std::vector<CheckedValue> checks;
  for (const ResultValue& one : results) {
    if (one.name != checks_name) continue;
    for (Words lines(one.text); lines.any();) {
      const double value = lines.number<double>(' '), limit = lines.number<double>(' ');
      checks.push_back({std::string(lines.until('\n')), value, limit});
    }
  }
  return checks;
}

}  // namespace dresslife::pipeline
