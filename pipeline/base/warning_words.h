// The text of a warning: problem, cause and remedy.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// What cures a warning.
struct Remedy {
  std::vector<KeyValue> values = {};  ///< that cure it together
  std::string words = {};             ///< what follows the values: " (now 0.5), or a longer hose"
  std::string preferred = {};         ///< what precedes them, if it is better than the values: "other clamps; or "

  /// Returns "other clamps; or KEY: VALUE and KEY: VALUE (now 0.5), or a longer hose".
  std::string text() const;
  bool empty() const { return values.empty() && words.empty() && preferred.empty(); }
};

/// Returns a warning in the form of every stage: "WHAT. Likely cause: CAUSE. Remedy: REMEDY". what: the part, the value with its
/// limit, the place and the time, if they apply.
Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const Remedy& remedy);
/// The parts of a text of warning_of(), without their labels. A text without these labels is a problem alone.
struct WarningParts {
  std::string problem, cause, remedy;
};
WarningParts parts_of(std::string words);
/// remedy: words without values.
Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const std::string& remedy);

}  // namespace dresslife::pipeline
