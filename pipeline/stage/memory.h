// Estimates the memory of a stage's job, and checks it before the stage computes anything.
//
// A stage adds the amounts that grow with its job, from sizes that it knows at its start. The sum is printed, and a job that
// needs more memory than is available is refused: a program that the kernel kills cannot print a reason.
//
// The sum does not contain the allocator's rounding, freed memory that the allocator keeps, and the tables of the HDF5 library.
// They are of the size of the rest, so the estimate is correct within `memory_factor` in both directions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct Format;
struct StageCall;
class Progress;

/// Largest ratio of the estimate to the measured peak, and of the peak to the estimate.
inline constexpr double memory_factor = 2;

class MemoryNeed {
 public:
  /// what: "histories of 12 segments"; remedy: the keys that reduce this amount, empty if there are none.
  void add(double bytes, std::string what, std::string remedy = "");
  double bytes() const;
  double megabytes() const { return bytes() / (1 << 20); }
  /// Returns the largest amount that a key can reduce: "histories of 12 segments 34 MB". Empty: there is none.
  std::string largest() const;
  std::string remedy() const;  ///< for that amount

 private:
  struct Share {
    double bytes;
    std::string what, remedy;
  };
  const Share* most() const;
  std::vector<Share> shares_;
};

/// Returns the memory [bytes] for writing or reading a file of this format with these lengths of axes: buffered rows, and the
/// library's cache of chunks. Missing axes count as 0.
double file_buffers(const Format& format, const std::map<std::string, std::size_t>& axes);

/// Returns the memory that programs can still use without swapping [MB]: that of the machine, or the rest of the control group if
/// it is less. std::nullopt if the system does not report it.
std::optional<double> free_memory_mb();

/// Prints the memory that the job needs. Errors: InputError at the call's input for a job that needs more than --job-memory or
/// the free memory.
void require_memory(const StageCall& call, const MemoryNeed& need, Progress& progress);

}  // namespace dresslife::pipeline
