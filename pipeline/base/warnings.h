// Warnings: results stand, but a person should look before believing them. Each stage writes its own, after
// those of the file that it read, into the root attribute `warnings` of its output, so that the last file has
// all of a job.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

/// What is not as it should be; a column KIND_ok of ranking.csv each.
enum class WarningKind {
  program,      ///< instructions of a robot program that may move it were left out
  bend_radius,  ///< the dresspack bends tighter than allowed
  twist,        ///< it is twisted more than allowed
  tension,      ///< it is pulled harder than allowed
  slack,        ///< it is too short or too long, or its retraction unit too short
  periodic,     ///< the motion did not become periodic
  overlap,      ///< parts of the dresspack lie in each other
  mesh,         ///< segments are too long for what is evaluated
  force,        ///< strains need forces that no real cable has
  material,     ///< constants of a material contradict each other
  strain,       ///< strains that no wire is meant for
  calibration,  ///< the job goes beyond the tests from which its calibration was learned
  motion        ///< a speed, a wait or an angle that may be in another unit
};
inline constexpr int warning_kinds_count = static_cast<int>(WarningKind::motion) + 1;

/// Whether hours beside such a warning are no basis of a plan: the dresspack passes a limit beyond which it fails in ways
/// that no stage evaluates, or the motion or the strains are not those of the plant.
bool spoils_plan(WarningKind kind);

/// "bend_radius": in files and names of columns.
const char* word(WarningKind kind);
/// "bend radius", "skipped instructions": for people.
const char* title(WarningKind kind);

struct Warning {
  WarningKind kind{};
  std::string where;  ///< "side_panel.mod:45"; empty: of the whole job
  std::string words;  ///< what, and what to do; one line
  /// "side_panel.mod:45: warning: skipped: ..."
  std::string line() const;
  /// The same for a table that holds nothing but warnings.
  std::string text() const;
  bool operator==(const Warning&) const = default;
};

/// For the attribute: a line each, kind, place and words between tabs; of more than 100 the first, and how
/// many there are.
std::string warnings_text(const std::vector<Warning>& warnings);
/// And back. Lines that are none, of a newer program perhaps, are left out.
std::vector<Warning> warnings_from(const std::string& text);

/// After those of the file before; each once.
std::vector<Warning> joined(std::vector<Warning> earlier, const std::vector<Warning>& own);

}  // namespace dresslife::pipeline
