#include "pipeline/stage/memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "pipeline/base/errors.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/progress.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/files.h"
#include "pipeline/stage/stage.h"

namespace dresslife::pipeline {
namespace {

constexpr double megabyte = 1 << 20;

std::string shown_megabytes(double megabytes) {
  constexpr double many = 10'000;
  return megabytes < many ? fmt::format("{:.0f} MB", std::ceil(megabytes))
                          : fmt::format("{:.3g} GB", megabytes / 1024);
}

double row_bytes(const Dataset& dataset, const std::map<std::string, std::size_t>& axes) {
  constexpr double text = 64;  // a path of names; few are longer
  double bytes = dataset.type == Type::text                               ? text
                 : dataset.type == Type::f64 || dataset.type == Type::u64 ? 8
                                                                          : 4;
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

/// A number that a line of a file begins with, or that follows `key` in it.
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

/// What the control group that a container runs in leaves [bytes]; files that are kept in memory can go.
std::optional<double> left_in_group() {
  const std::filesystem::path group = "/sys/fs/cgroup";
  const auto most = number_in(group / "memory.max"), now = number_in(group / "memory.current");
  if (!most || !now) return std::nullopt;  // "max", or none
  return *most - *now + number_in(group / "memory.stat", "inactive_file ").value_or(0);
}

/// What a process holds [MB]; 0 when it is gone or nothing is told of it.
double held_mb(pid_t process) {
  std::ifstream in(fmt::format("/proc/{}/statm", process));
  double size = 0, resident = 0;
  in >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / megabyte;
}

/// A file that only one process works on at a time.
class Locked {
 public:
  explicit Locked(const std::filesystem::path& file)
      : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644)) {
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Locked() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

  std::string text() const {
    const std::int64_t size = descriptor_ < 0 ? 0 : state_of(descriptor_, "memory").size;
    std::string text(static_cast<std::size_t>(std::max<std::int64_t>(0, size)), '\0');
    if (!text.empty() && !read_at(descriptor_, text.data(), text.size(), 0)) text.clear();
    return text;
  }
  /// A claim that cannot be noted is not seen by others: they may begin too early, no more.
  void put(const std::string& text) const {
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, 0) == 0 &&
        ::pwrite(descriptor_, text.data(), text.size(), 0) < 0)
      return;
  }

 private:
  int descriptor_;
};

}  // namespace

void MemoryNeed::add(double bytes, std::string what, std::string remedy) {
  shares_.push_back({std::max(0.0, bytes), std::move(what), std::move(remedy)});
}

double MemoryNeed::bytes() const {
  double sum = 0;
  for (const Share& share : shares_) sum += share.bytes;
  return sum;
}

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
  constexpr double cache = 1 << 20, on_its_way = 2 << 16;  // the library's default, and twice a chunk of ours
  constexpr double packed = 3 * (4 << 15);                 // a chunk of numbers, packed and on its way
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

MemoryClaims::Answer MemoryClaims::ask(double megabytes) const {
  const std::optional<double> free = free_();
  if (!free) return Answer::given;
  if (file_.empty()) return megabytes <= *free ? Answer::given : Answer::never;
  const Locked claims(file_);
  std::istringstream lines(claims.text());
  std::string kept;
  double not_taken_yet = 0;
  pid_t process = 0;
  for (double claimed = 0; lines >> process >> claimed;) {
    if (process <= 0 || process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH)) continue;
    kept += fmt::format("{} {}\n", process, claimed);
    not_taken_yet += std::max(0.0, claimed - held_mb(process));
  }
  if (megabytes > *free - not_taken_yet) return kept.empty() ? Answer::never : Answer::wait;
  claims.put(kept + fmt::format("{} {}\n", ::getpid(), megabytes));
  return Answer::given;
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

void heed_memory(const StageCall& call, const MemoryNeed& need, Progress& progress) {
  constexpr double worth_a_word = 0.125;  // of the machine's: a person need not hear of less
  const double megabytes = need.megabytes(), machine = static_cast<double>(installed_memory_mb());
  if (call.limits.megabytes > 0 && megabytes > static_cast<double>(call.limits.megabytes))
    refuse(call, need, fmt::format("--job-memory allows {} MB", call.limits.megabytes), "allow more");
  const std::string words =
      fmt::format("note: takes about {} of memory{}", shown_megabytes(megabytes),
                  need.largest().empty() ? "" : fmt::format(", {} of it", need.largest()));
  if (call.of_a_study)
    tell(words + "\n");  // into the stage's log
  else if (megabytes > worth_a_word * machine)
    progress.note(words);
  const char* const run = std::getenv("DRESSLIFE_MEMORY");
  const MemoryClaims claims(run && call.of_a_study ? run : "", free_memory_mb);
  for (bool waits = false;; waits = true) {
    const MemoryClaims::Answer answer = claims.ask(megabytes);
    if (answer == MemoryClaims::Answer::given) {
      limit_memory(call.limits.megabytes);
      if (waits) limit_time(call.info.program, call.limits.seconds);  // waiting is no work
      return;
    }
    if (answer == MemoryClaims::Answer::never)
      refuse(call, need, fmt::format("{} are free", shown_megabytes(free_memory_mb().value_or(0))),
             "end other programs");
    if (!waits) tell("note: waits until other stages have given back their memory\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

}  // namespace dresslife::pipeline
