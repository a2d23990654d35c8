// Results of geometric screening and of short runs, from screening.h5.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct Job;

struct ScreenedCandidate {
  std::string changes;          ///< YAML
  std::string refusal;          ///< reason why it is no valid job; empty: it is valid
  bool rejected = false;        ///< infeasible by geometry
  std::vector<double> beyond;   ///< (limit) <= 0: satisfied
  std::vector<double> bends{};  ///< pieces whose maximum is the bend limit, from a short run; empty: unknown
  double violation() const;     ///< sum of the violations
};

struct ScreenedList {
  std::vector<std::string> limits;  ///< names of the limits
  std::string motion;               ///< YAML of a generated motion; empty: the job has its own motion
  std::vector<ScreenedCandidate> candidates;

  /// Returns the violated limits: "bent too tightly by 27 %, too short by 2 % of the length"; empty: none.
  std::string words(const ScreenedCandidate& candidate) const;
};

/// Reads a screening file. Errors: InputError when the file cannot be read.
ScreenedList read_screening(const std::filesystem::path& file);

enum class ScreenedBy { geometry, short_runs };

/// Returns, (candidate), results of dresslife-sim for a job with changes (a YAML list of maps from keys to values), with files in
/// `folder`. longest_bracket: [m] (V7); absent: the job's value. Errors: StageFailed; InputError when the program cannot be
/// started.
ScreenedList screening_of(const Job& job, const std::string& candidates, ScreenedBy by,
                          std::optional<double> longest_bracket, const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
