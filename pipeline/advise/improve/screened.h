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
  std::string refusal;          ///< why it is no job; empty: it is one
  bool rejected = false;        ///< infeasible by geometry
  std::vector<double> beyond;   ///< (limit) <= 0: satisfied
  std::vector<double> bends{};  ///< pieces whose maximum is the bend's limit, of a short run; empty: unknown
  double violation() const;     ///< sum of the violations
};

struct ScreenedList {
  std::vector<std::string> limits;  ///< their names
  std::string motion;               ///< YAML of a generated motion; empty: the job's own
  std::vector<ScreenedCandidate> candidates;

  /// "bent too tightly by 27 %, too short by 2 % of the length": violated limits; empty: none.
  std::string words(const ScreenedCandidate& candidate) const;
};

/// Errors: InputError when the file cannot be read.
ScreenedList read_screening(const std::filesystem::path& file);

enum class ScreenedBy { geometry, short_runs };

/// (candidate) results of dresslife-sim for a job with changes (a YAML list of maps from keys to values) in
/// `folder`. longest_bracket: [m] (V7); absent: the job's. Errors: StageFailed; InputError when it cannot be
/// started.
ScreenedList screening_of(const Job& job, const std::string& candidates, ScreenedBy by,
                          std::optional<double> longest_bracket, const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
