// Warnings: the results are valid, but a person should check them. Each stage writes its own warnings, after those of its input
// file, into the root attribute `warnings` of its output. So the last file has all warnings of a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Kind of a warning. Each kind is a column KIND_ok of ranking.csv.
enum class WarningKind {
  program,      ///< instructions that may move the robot were skipped
  bend_radius,  ///< the dresspack bends tighter than allowed
  twist,        ///< the dresspack is twisted more than allowed
  tension,      ///< the dresspack is pulled harder than allowed
  slack,        ///< the dresspack or the travel of its retraction unit is too short or too long
  periodic,     ///< the motion did not become periodic
  overlap,      ///< parts of the dresspack overlap
  mesh,         ///< segments are too long for an evaluated quantity, or cables do not reach a cycle
  force,        ///< strains need larger forces than a real cable has
  material,     ///< constants of a material contradict each other
  strain,       ///< strains are beyond the use of any wire
  calibration,  ///< the job is outside of the tests of its calibration
  motion,       ///< a speed, a wait or an angle may be in another unit
  side,         ///< the dresspack can be mounted on two sides, on which it moves differently, and the job states none
  other_values  ///< a limit is exceeded with other values of uncertain parameters, not with the job's own (pipeline/job/beyond_limit.h)
};
inline constexpr int warning_kinds_count = static_cast<int>(WarningKind::other_values) + 1;

/// Returns whether a plan must not use the hours of a job with such a warning. Then the dresspack exceeds a limit beyond which it
/// fails in ways that no stage evaluates, or motion or strains differ from those of the plant.
bool spoils_plan(WarningKind kind);

/// Returns "bend_radius": the word in files and in names of columns.
const char* word(WarningKind kind);
/// Returns "bend radius" or "skipped instructions": the words for people.
const char* title(WarningKind kind);

/// A key of a job and a value for it, as YAML: "routing.free_length_m", "1.943".
struct KeyValue {
  std::string key, value;
  bool operator==(const KeyValue&) const = default;
};

/// Returns a line of a warning for a terminal: wrapped at screen_columns(), with the likely cause and the remedy on lines of their own. All
/// lines but the first are indented by four spaces. Ends with a line feed.
std::string paragraph(const std::string& line);

struct Warning {
  WarningKind kind{};
  std::string where;  ///< "side_panel.mod:45"; empty: the whole job
  std::string words;  ///< problem and remedy; one line
  /// The values of the remedy (warning_words.h). All of them together cure the warning. Keys are paths in the job; in a
  /// warning about a file of a dresspack they count from its place. Empty: no value is known.
  std::vector<KeyValue> remedy = {};
  /// For the order of a search's candidates. `periodic`: the change by a repeat, over its limit. `other_values`: the share of
  /// dresspacks beyond the limit. Absent: another kind, or an older file.
  std::optional<double> amount = {};
  /// Returns "side_panel.mod:45: warning: skipped: ..."
  std::string line() const;
  std::string paragraph() const { return pipeline::paragraph(line()); }
  /// Returns the line without the word "warning", for a table of warnings.
  std::string text() const;
  bool operator==(const Warning&) const = default;
};

/// Returns the text of the attribute: a line for each warning with kind, place, words, each KEY: VALUE of its remedy, and "amount: 0.3",
/// between tabs. If it would be longer than 60 kB, it has the first warnings and the number of the others.
std::string warnings_text(const std::vector<Warning>& warnings);
/// Reads a text of warnings_text(). Skips lines of unknown form, which a newer program may have written.
std::vector<Warning> warnings_from(const std::string& text);

/// Returns the earlier warnings, then the new ones of `own`, without duplicates.
std::vector<Warning> joined(std::vector<Warning> earlier, const std::vector<Warning>& own);

}  // namespace dresslife::pipeline
