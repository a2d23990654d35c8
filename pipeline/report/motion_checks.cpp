#include "pipeline/report/motion_checks.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

/// Returns the rounded value, without a minus sign if it rounds to zero.
std::string rounded(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.starts_with('-') ? text.substr(1) : text;
}

/// Returns a value in the units of cell designers: mm, deg/m, turns.
std::string in_words(double value, const std::string& unit) {
  if (std::isinf(value)) return "";
  if (unit == "m") return rounded(1e3 * value, 1) + " mm";
  if (unit == "rad/m") return rounded(value * 180 / std::numbers::pi, 0) + " deg/m";
  if (unit == "rad") return rounded(value / (2 * std::numbers::pi), 2) + " turns";
  return rounded(value, 0) + " " + unit;
}

std::string repeats_words(const FileReader& file) {
  if (!file.has_attribute("repeats")) return "";
  const double repeats = file.number_attribute("repeats");
  if (!file.has_attribute("repeat_distance"))  // a prescribed deformation has no time step and is not repeated
    return file.has_attribute("time_step") ? "The motion does not end where it begins and was run once." : "";
  return fmt::format("Repeat {:.0f} of the motion; the dresspack ended it {:.2g} mm from where it began it.", repeats,
                     1e3 * file.number_attribute("repeat_distance"));
}

}  // namespace

std::string check_table(const std::filesystem::path& motion_file) {
  const FileReader file(motion_file, motion_format());
  if (!file.has("/check/name")) return "";
  const auto names = file.read<std::string>("/check/name"), units = file.read<std::string>("/check/unit");
  const auto texts = file.read<std::string>("/program/text");
  const auto values = file.read<double>("/check/value"), limits = file.read<double>("/check/limit");
  const auto times = file.read<double>("/check/time"), positions = file.read<double>("/check/position");
  const auto steps = file.read<std::int32_t>("/check/step"), warnings = file.read<std::int32_t>("/check/warning");
  const auto lengths = file.read<double>("/segment/length");
  const std::vector<std::size_t> of_segment = dresspack_of_segments(file);
  const std::vector<std::string> dresspacks = dresspack_names(file);
  const auto of_check = file.has("/check/dresspack") ? file.read<std::int32_t>("/check/dresspack")
                                                     : std::vector<std::int32_t>(names.size(), 0);
  std::vector<double> length(dresspacks.size(), 0.0);
  for (std::size_t i = 0; i < lengths.size(); ++i) length.at(of_segment[i]) += lengths[i];
  std::string rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool known = steps[i] >= 0 && steps[i] < static_cast<std::int32_t>(texts.size());
    const auto dresspack = static_cast<std::size_t>(of_check[i]);
    if (dresspack >= dresspacks.size())
      throw InputError(file.where(), fmt::format("/check/dresspack names dresspack {}", of_check[i]),
                       "run dresslife-sim again");
    const std::string& of = dresspacks.at(dresspack);
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"number{}\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td><td class=\"number\">{:.1f} s</td><td>{}</td></tr>\n",
        escaped(of.empty() ? names[i] : of + ", " + names[i]), warnings[i] ? " failed" : "",
        in_words(values[i], units[i]), in_words(limits[i], units[i]),
        positions[i] < 0 ? "" : rounded(length[dresspack] - positions[i], 2) + " m", times[i],
        known ? escaped(texts[static_cast<std::size_t>(steps[i])]) : "");
  }
  return fmt::format("<p class=\"soft\">{}</p>\n{}", repeats_words(file),
                     wide_table({"check", "#worst", "#limit", "#from the tool", "#when", "program"}, rows));
}

}  // namespace dresslife::pipeline
