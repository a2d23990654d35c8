// The memory that a stage's job will take, estimated and checked before time is spent on the job.
//
// A stage adds up what grows with its job, from sizes that it knows before it begins. The sum is noted, and a
// job that cannot have it is refused: a program that the kernel kills can give no reason.
//
// The sum leaves out the allocator's rounding, freed memory that it keeps and the HDF5 library's tables. They
// are of the size of the rest, so an estimate is good within `memory_factor`, either way.
#pragma once

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

/// Notes what the job needs. Errors: InputError, at the call's input, for a job that needs more than
/// --job-memory allows or than is free.
void require_memory(const StageCall& call, const MemoryNeed& need, Progress& progress);

}  // namespace dresslife::pipeline
