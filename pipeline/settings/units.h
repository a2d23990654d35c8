// The unit of a YAML key is the end of its name: `radius_mm`, `speed_deg_per_s`. Inside, everything is SI.
#pragma once

#include <string>
#include <string_view>

namespace dresslife::pipeline {

struct Unit {
  std::string_view suffix;  ///< of the key, without the underscore
  std::string_view name;    ///< as people write it
  double to_si;             ///< factor from this unit to SI; percent stays percent
  double most;              ///< no robot cell has more of it, in this unit; what is beyond is a mistake
  /// No positive quantity that matters is below, in this unit.
  double least() const { return most / 1e15; }
};

/// The unit of a key; one without suffix and name for a key without one. The longest suffix counts.
const Unit& unit_of_key(std::string_view key);

/// The key without its unit: `radius_mm` -> `radius`.
std::string_view stem_of_key(std::string_view key);

/// "diameter_mm: 50" for `diameter_m: 0.05`: a key that has the same stem and a unit of the same kind, with the value in the
/// unit of `known`. Knows the units of keys and common others (cm, inch, rad, g_per_m, awg, ...). Empty: the unit of `written` is
/// not known, or is of another kind.
std::string converted_text(std::string_view written, double value, std::string_view known);

/// What a number of a key in mm may have meant.
struct Meant {
  std::string cause;   ///< "metres instead of millimetres"; empty: no usual slip explains it
  std::string remedy;  ///< "diameter_mm: 42.5 if that was metres"
};
/// The slips that bring `value` [mm] of `key` into low .. high: another unit of length, a digit too many or too few.
Meant meant_length(std::string_view key, double value, double low, double high);

/// The section of a round wire of this American wire gauge [mm2].
double square_mm_of_awg(double gauge);

/// Shortest decimal text that, read back and multiplied by the unit's factor, gives exactly `si`.
std::string text_in_unit(double si, const Unit& unit);

/// Shortest decimal text that reads back to exactly `value`.
std::string shortest_text(double value);

}  // namespace dresslife::pipeline
