// Reads motion.h5 and writes strain.h5. Works in blocks of rows, so that memory does not grow with the motion by more than a
// few histories.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::strain {

/// Limit of the histories in memory [bytes], including those that friction holds. If they need more, the motion is read again
/// for the next segments.
constexpr std::size_t default_history_bytes = std::size_t{128} << 20;

/// Messages of the stage.
struct Notes {
  std::vector<pipeline::Warning> warnings;
  std::string summary;  ///< one line on the worst site
};

/// Change of the loose cables of a span in the repeat that counts.
struct RepeatChange {
  double share = 0;  ///< of curvature (LooseCables::changed()); the rest is valid if it is above 0
  std::size_t dresspack = 0, component = 0;  ///< of the cable that changes most
  std::string cable{};                       ///< its name
  double arc = 0;                            ///< place of its largest change, from the base clamp [m]
  double longest_path = 0;                   ///< largest gain in length of a path of this component: /cable/path_gain
};
/// Returns a warning if the pieces of loose cables are too long for their curvature. error: loose_mesh_error of strain.h5. pieces:
/// in each segment. The remedy states them, because otherwise more segments have fewer pieces each.
std::vector<pipeline::Warning> mesh_warnings(double error, std::size_t pieces, int segments);
/// Returns a warning if loose cables end the repeat with another curvature than they began it.
std::vector<pipeline::Warning> cycle_warnings(const pipeline::Job& job, const RepeatChange& change);

/// Writes every dataset of strain.h5. threads: does not change the file. progress: receives the share of work done. Errors:
/// InputError for a motion without samples and for a dresspack without wires, and the errors of Construction and Evaluation.
Notes write_strain(const pipeline::FileReader& motion, const pipeline::Job& job, pipeline::FileWriter& strain,
                   std::size_t threads, const std::function<void(double)>& progress,
                   std::size_t history_bytes = default_history_bytes);

}  // namespace dresslife::strain
