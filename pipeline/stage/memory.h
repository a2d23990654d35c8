// What memory a stage's job will take: told and heeded before time is spent on it.
//
// A stage adds up what grows with its job, from sizes that it knows before it begins. The sum is told,
// refused where it cannot be had, and waited for where other stages of the same run will give it back: better
// than a program that the kernel kills, which can say nothing.
//
// Of what a peak consists that is not added up - the allocator's rounding, freed memory that it keeps, the
// HDF5 library's tables - is of the size of the rest: an estimate is good within `memory_factor`, either way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct Format;
struct StageCall;
class Progress;

/// Of the estimate over the measured peak and of the peak over the estimate, at most.
inline constexpr double memory_factor = 2;

class MemoryNeed {
 public:
  /// what: "histories of 12 segments"; remedy: the keys that make it smaller, empty where none does.
  void add(double bytes, std::string what, std::string remedy = "");
  double bytes() const;
  double megabytes() const { return bytes() / (1 << 20); }
  /// The largest part that a key makes smaller: "histories of 12 segments 34 MB". Empty: nothing does.
  std::string largest() const;
  std::string remedy() const;  ///< of that part

 private:
  struct Share {
    double bytes;
    std::string what, remedy;
  };
  const Share* most() const;
  std::vector<Share> shares_;
};

/// Held while a file of this format is written or read, whose axes have these lengths: rows on their way, and
/// the library's cache of chunks. Axes that are not named count as 0.
double file_buffers(const Format& format, const std::map<std::string, std::size_t>& axes);

/// Memory that programs could still take without another one's being moved out [MB]: the machine's, or what
/// the control group leaves of it. Nothing where the system does not tell.
std::optional<double> free_memory_mb();

/// Who of a run's stages has been given how much memory: lines "process megabytes" in a file of the run.
/// Stages that have ended count no more.
class MemoryClaims {
 public:
  /// file: empty where a stage runs alone.
  MemoryClaims(std::filesystem::path file, std::function<std::optional<double>()> free)
      : file_(std::move(file)), free_(std::move(free)) {}

  enum class Answer { given, wait, never };
  /// Gives this process `megabytes` if they are free beside what others were given and have not taken yet.
  /// wait: others work, and will give theirs back; never: nobody does.
  Answer ask(double megabytes) const;

 private:
  std::filesystem::path file_;
  std::function<std::optional<double>()> free_;
};

/// Tells what the job needs, and waits until it may be had. Errors: InputError, at the call's input, for a
/// job that does not fit into --job-memory or the machine.
void heed_memory(const StageCall& call, const MemoryNeed& need, Progress& progress);

}  // namespace dresslife::pipeline
