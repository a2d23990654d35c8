#include "pipeline/files/motion_layout.h"

#include <algorithm>
#include <cmath>

namespace dresslife::pipeline {

std::vector<std::size_t> dresspack_of_segments(const FileReader& file) {
  if (!file.has("/segment/dresspack")) return std::vector<std::size_t>(file.rows("/segment/length"), 0);
  const auto dresspacks = file.read<std::int32_t>("/segment/dresspack");
  const std::size_t names = file.rows("/dresspack/name");
  bool in_order = dresspacks.size() == file.rows("/segment/length") && !dresspacks.empty() && dresspacks.front() == 0 &&
                  static_cast<std::size_t>(dresspacks.back()) + 1 == names;
  for (std::size_t i = 1; in_order && i < dresspacks.size(); ++i)
    in_order = dresspacks[i] == dresspacks[i - 1] || dresspacks[i] == dresspacks[i - 1] + 1;
  if (!in_order)
    throw InputError(file.where(), "/segment/dresspack does not count the dresspacks up one by one",
                     "make the file again");
  return {dresspacks.begin(), dresspacks.end()};
}

void check_lengths(const FileReader& file, const std::vector<double>& free_lengths) {
  const std::string remedy = "make the file again, with the job that it holds";
  const auto lengths = file.read<double>("/segment/length");
  const std::vector<std::size_t> dresspack = dresspack_of_segments(file);
  const std::size_t count = dresspack.empty() ? 0 : dresspack.back() + 1;
  if (count != free_lengths.size())
    throw InputError(file.where(), fmt::format("holds {} dresspacks (its job has {})", count, free_lengths.size()),
                     remedy);
  std::vector<double> together(count, 0.0);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!(lengths[i] > 0))
      throw InputError(file.where(), fmt::format("has a segment whose rest length is {} m", lengths[i]), remedy);
    together[dresspack[i]] += lengths[i];
  }
  constexpr double rounding = 1e-6;  // relative, for numbers that were stored in single precision
  for (std::size_t d = 0; d < count; ++d)
    if (!(std::abs(together[d] - free_lengths[d]) <= rounding * free_lengths[d]))
      throw InputError(file.where(),
                       fmt::format("has segments of {} m together where routing.free_length_m of its job is {}",
                                   together[d], free_lengths[d]),
                       remedy);
}

std::vector<std::string> dresspack_names(const FileReader& file) {
  if (!file.has("/dresspack/name")) return {""};
  const auto names = file.read<std::string>("/dresspack/name");
  return names.size() == 1 ? std::vector<std::string>{""} : names;
}

std::vector<MotionSpan> motion_spans(const FileReader& motion) {
  const std::vector<std::size_t> dresspack = dresspack_of_segments(motion);
  const std::size_t clamps = motion.row_size("/clamp/position") / 3;
  if (!motion.has("/clamp/segment")) return {{0, 0, dresspack.size(), 0, clamps - 1}};
  const auto before = motion.read<std::int32_t>("/clamp/segment");
  bool fits = before.size() == clamps && before.size() >= 2 && before.front() == 0 &&
              before.back() == static_cast<std::int32_t>(dresspack.size()) && std::ranges::is_sorted(before);
  std::vector<MotionSpan> spans;
  for (std::size_t c = 0; fits && c + 1 < before.size(); ++c) {
    const auto first = static_cast<std::size_t>(before[c]), end = static_cast<std::size_t>(before[c + 1]);
    if (first < end) {
      // No dresspack may begin between two clamps, or at the tool clamp of another one.
      const bool shares = !spans.empty() && spans.back().tool_clamp == c;
      fits = dresspack[first] == dresspack[end - 1] && (!shares || spans.back().dresspack == dresspack[first]);
      spans.push_back({dresspack[first], first, end - first, c, c + 1});
    } else {
      fits = first > 0 && end < dresspack.size() && dresspack[end] != dresspack[end - 1];
    }
  }
  if (!fits)
    throw InputError(motion.where(),
                     "/clamp/segment does not rise from 0 to the number of segments, span by span of each dresspack",
                     "run dresslife-sim again");
  return spans;
}

}  // namespace dresslife::pipeline
