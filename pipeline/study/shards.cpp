#include "pipeline/study/shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "pipeline/base/errors.h"
#include "pipeline/base/order.h"

namespace dresslife::pipeline {
namespace {

/// Returns the changes that may change a variant's simulation, as text.
std::string simulated_changes(const Variant& variant) {
  std::string text;
  for (const Change& change : variant.changes) {
    const std::string section = change.path.substr(0, change.path.find('.'));
    if (section != "strain" && section != "fatigue")
      text += fmt::format("{}: {}\n", change.path, to_yaml(change.value));
  }
  return text;
}

}  // namespace

std::string Shard::name() const { return fmt::format("{}_of_{}", index, count); }

Shard shard_from(const std::string& text, const std::string& where) {
  constexpr int most = 1'000'000;
  Shard shard;
  const char *const end = text.data() + text.size(), *at = text.data();
  const auto index = std::from_chars(at, end, shard.index);
  const bool parted = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
  const auto count = parted ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!parted || count.ec != std::errc{} || count.ptr != end || shard.index < 1 || shard.count > most ||
      shard.index > shard.count)
    throw InputError({where}, fmt::format("'{}' is no shard", text), "write K/N, from 1/N to N/N");
  return shard;
}

int shards_needed(const StudyState& standing, int most_stages) {
  std::size_t left = 0, jobs = 0;
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    if (!standing.study.jobs[k].failure.empty()) continue;
    left += stage_count - standing.states[k].next;
    ++jobs;
  }
  const std::size_t most = static_cast<std::size_t>(most_stages),
                    jobs_each = std::max<std::size_t>(1, most / stage_count);
  return left <= most ? 1 : static_cast<int>((jobs + jobs_each - 1) / jobs_each);
}

std::vector<std::size_t> part_of(const std::vector<Variant>& variants, const Shard& shard) {
  const std::size_t count = variants.size();
  std::unordered_map<std::string, std::size_t> firsts;  // (changes of the simulation) index of the first variant
  std::vector<std::size_t> group(count);
  for (std::size_t k = 0; k < count; ++k) group[k] = firsts.emplace(simulated_changes(variants[k]), k).first->second;
  const std::vector<std::size_t> order = smallest_first(count, [&](std::size_t k) { return group[k]; });
  const auto begin_of = [&](int index) {
    return static_cast<std::ptrdiff_t>(count * static_cast<std::size_t>(index - 1) /
                                       static_cast<std::size_t>(shard.count));
  };
  std::vector<std::size_t> part(order.begin() + begin_of(shard.index), order.begin() + begin_of(shard.index + 1));
  std::ranges::sort(part);
  return part;
}

}  // namespace dresslife::pipeline
