// What geometry alone says of routings, as dresslife-sim wrote it (screening.h5).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct Job;

struct ScreenedCandidate {
  std::string changes;          ///< YAML
  std::string refusal;          ///< why it is no job; empty: it is one
  bool rejected = false;        ///< cannot work
  std::vector<double> beyond;   ///< (limit) <= 0: kept
  std::vector<double> bends{};  ///< what the bend's limit is the largest of, in a short run; empty: not told
  double violation() const;     ///< sum of what is beyond
};

struct ScreenedList {
  std::vector<std::string> limits;  ///< their names
  std::string motion;               ///< YAML of the motion that was made for it; empty: the job's own
  std::vector<ScreenedCandidate> candidates;

  /// "bent too tightly by 0.31, too short by 0.02": the limits that a candidate passes; empty: none.
  std::string words(const ScreenedCandidate& candidate) const;
};

/// Errors: InputError when the file cannot be read.
ScreenedList read_screening(const std::filesystem::path& file);

enum class ScreenedBy { geometry, short_runs };

/// (candidate) what dresslife-sim says of a job changed so (a YAML list of maps from keys to values), which
/// it reads from `folder`. longest_bracket: [m] (V7); absent: the job's. Empty where it refuses the job. Errors:
/// InputError when it cannot be started.
ScreenedList screening_of(const Job& job, const std::string& candidates, ScreenedBy by,
                          std::optional<double> longest_bracket, const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
