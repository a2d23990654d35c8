// The text of a warning: problem, cause and remedy.
#pragma once

#include <initializer_list>
#include <limits>
#include <string_view>

#include "pipeline/base/errors.h"
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

/// Another unit in which a number may have been written.
struct OtherUnit {
  double factor;           ///< of the number, to the unit of its key
  std::string_view cause;  ///< "metres instead of millimetres"
  std::string_view unit;   ///< "metres"
};

constexpr double no_limit = std::numeric_limits<double>::infinity();
/// Limits of a number in the unit of its key.
struct Limits {
  double low = 0, high = no_limit;
  std::string_view reason = {};  ///< ": solid copper"
};

/// Cause and remedy of a number that no other unit brings within its limits.
struct Otherwise {
  std::string_view cause = "another unit";
  std::string_view remedy = {};  ///< empty: the limits
  std::string_view also = {};    ///< after the remedy of another unit: ", or no key"
};

/// Adds warnings of one kind to a list.
class WarningsOfKind {
 public:
  explicit WarningsOfKind(std::vector<Warning>& warnings, WarningKind kind) : warnings_(&warnings), kind_(kind) {}
  void operator()(const Where& where, const std::string& what, const std::string& cause,
                  const std::string& remedy) const;
  /// Warns of a number outside of its limits, in the unit of its key. of: " of 'lead'", after the key. Cause and remedy are the
  /// units in which it would be within the limits.
  void number(const Where& where, std::string_view key, std::string_view of, double value, const Limits& limits,
              std::initializer_list<OtherUnit> units = {}, const Otherwise& otherwise = {}) const;
  static constexpr double hours_of_day = 24;  ///< robots of plants run 40 h a week and more
  /// Warns of hours per week of at most hours_of_day: they are probably hours of a day, or a share of the week.
  void week(const Where& where, std::string_view key, std::string_view of, double hours) const;

 private:
  std::vector<Warning>* warnings_;
  WarningKind kind_;
};

}  // namespace dresslife::pipeline
