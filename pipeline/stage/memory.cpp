#include "pipeline/stage/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "pipeline/base/errors.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/progress.h"
#include "pipeline/files/files.h"
#include "pipeline/stage/stage.h"

namespace dresslife::pipeline {
namespace {

constexpr double megabyte = 1 << 20;

std::string shown_megabytes(double megabytes) {
  constexpr double many = 10'000;
  return megabytes < many ? fmt::format("{:.0f} MB", std::ceil(megabytes)) : fmt::format("{:.3g} GB", megabytes / 1024);
}

double row_bytes(const Dataset& dataset, const std::map<std::string, std::size_t>& axes) {
  constexpr double text = 64;  // for a path of names; few are longer
  double bytes = dataset.type == Type::text ? text : dataset.type == Type::f64 || dataset.type == Type::u64 ? 8 : 4;
  for (std::size_t i = 1; i < dataset.shape.size(); ++i) {
    const std::string& axis = dataset.shape[i];
    if (axis.find_first_not_of("0123456789") == std::string::npos) {
      bytes *= std::stod(axis);
    } else {
      const auto found = axes.find(axis);
      bytes *= found == axes.end() ? 0 : static_cast<double>(found->second);
    }
  }
  return bytes;
}

/// Returns the number at the start of a file's first line, or behind `key` in the first line that starts with `key`.
std::optional<double> number_in(const std::filesystem::path& file, const std::string& key = "") {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream words(line.substr(key.size()));
    if (double value = 0; words >> value) return value;
    return std::nullopt;
  }
  return std::nullopt;
}

/// Returns the rest of the control group of a container [bytes]. Cached files count as free.
std::optional<double> left_in_group() {
  const std::filesystem::path group = "/sys/fs/cgroup";
  const auto most = number_in(group / "memory.max"), now = number_in(group / "memory.current");
  if (!most || !now) return std::nullopt;  // "max", or no control group
  return *most - *now + number_in(group / "memory.stat", "inactive_file ").value_or(0);
}

}  // namespace

void MemoryNeed::add(double bytes, std::string what, std::string remedy) {
  shares_.push_back({std::max(0.0, bytes), std::move(what), std::move(remedy)});
}

double MemoryNeed::bytes() const { return sum_of(shares_, &Share::bytes); }

const MemoryNeed::Share* MemoryNeed::most() const {
  const Share* most = nullptr;
  for (const Share& share : shares_)
    if (!share.remedy.empty() && (!most || share.bytes > most->bytes)) most = &share;
  return most;
}

std::string MemoryNeed::largest() const {
  const Share* const share = most();
  return share ? fmt::format("{} {}", share->what, shown_megabytes(share->bytes / megabyte)) : "";
}

std::string MemoryNeed::remedy() const { return most() ? most()->remedy : ""; }

double file_buffers(const Format& format, const std::map<std::string, std::size_t>& axes) {
  constexpr double cache = 1 << 20, on_its_way = 2 << 16;  // the default of the library, and two chunks of this project
  constexpr double packed = 3 * (4 << 15);                 // a chunk of numbers, packed and unpacked
  double bytes = 0;
  for (const Dataset& dataset : format.datasets) {
    const auto rows = axes.find(dataset.shape[0]);
    if (rows == axes.end()) continue;
    const double all = static_cast<double>(rows->second) * row_bytes(dataset, axes);
    bytes += dataset.packed() ? packed : std::min(all, cache) + std::min(all, on_its_way);
  }
  return bytes;
}

std::optional<double> free_memory_mb() {
  std::optional<double> free = number_in("/proc/meminfo", "MemAvailable:");  // kB
  if (free) *free *= 1024;
  if (const std::optional<double> group = left_in_group()) free = std::min(free.value_or(*group), *group);
  if (free) *free /= megabyte;
  return free;
}

namespace {

[[noreturn]] void refuse(const StageCall& call, const MemoryNeed& need, const std::string& limit,
                         const std::string& other_remedy) {
  const std::string largest = need.largest(), remedy = need.remedy();
  throw InputError({call.input.string()},
                   fmt::format("takes about {} of memory{} ({})", shown_megabytes(need.megabytes()),
                               largest.empty() ? "" : ", " + largest + " of it", limit),
                   remedy.empty() ? other_remedy : fmt::format("choose {}, or {}", remedy, other_remedy));
}

}  // namespace

void require_memory(const StageCall& call, const MemoryNeed& need, Progress& progress) {
  constexpr double worth_a_word = 0.125;  // share of the machine's memory; smaller needs are not printed
  const double megabytes = need.megabytes(), machine = static_cast<double>(installed_memory_mb());
  if (call.limits.megabytes > 0 && megabytes > static_cast<double>(call.limits.megabytes))
    refuse(call, need, fmt::format("--job-memory allows {} MB", call.limits.megabytes), "allow more");
  if (const std::optional<double> free = free_memory_mb(); free && megabytes > *free)
    refuse(call, need, fmt::format("{} are free", shown_megabytes(*free)),
           "end other programs or run fewer jobs at a time");
  const std::string words = fmt::format("note: takes about {} of memory{}", shown_megabytes(megabytes),
                                        need.largest().empty() ? "" : fmt::format(", {} of it", need.largest()));
  if (call.of_a_study)
    write_stderr(words + "\n");  // into the log of the stage
  else if (megabytes > worth_a_word * machine)
    progress.note(words);
  limit_memory(call.limits.megabytes);
}

}  // namespace dresslife::pipeline
