// The end of a YAML key is its unit: `radius_mm`, `speed_deg_per_s`. The structs contain SI units.
#pragma once

#include <string>
#include <string_view>

namespace dresslife::pipeline {

struct Unit {
  std::string_view suffix;  ///< end of the key, without the underscore
  std::string_view name;    ///< for people
  double to_si;             ///< factor from this unit to SI; percent stays percent
  double most;              ///< upper limit in this unit: no robot cell has more, so a larger value is a mistake
  /// Returns the lower limit of positive values in this unit; a smaller value is a mistake.
  double least() const { return most / 1e15; }
};

/// Returns the unit with the longest suffix that ends the key. A key without unit gets a unit with empty suffix and name.
const Unit& unit_of_key(std::string_view key);

/// Returns the key without its unit: `radius_mm` -> `radius`.
std::string_view stem_of_key(std::string_view key);

/// Returns "diameter_mm: 50" for `diameter_m: 0.05` and known = "diameter_mm": the known key with the value in its unit. The two
/// keys must have one stem and units of one kind. Accepts the units of keys and common others (cm, inch, rad, g_per_m, awg, ...).
/// Empty if the unit of `written` is unknown or of another kind.
std::string converted_text(std::string_view written, double value, std::string_view known);

/// Probable meaning of a wrong length in mm.
struct Meant {
  std::string cause;   ///< "metres instead of millimetres"; empty: no usual mistake explains the number
  std::string remedy;  ///< "diameter_mm: 42.5 if that was metres"
};
/// Returns the usual mistake that explains why `value` [mm] of `key` is not in low .. high: another unit of length, a digit too
/// many or too few.
Meant meant_length(std::string_view key, double value, double low, double high);

/// Returns the cross-section of a round wire of this American wire gauge [mm2].
double square_mm_of_awg(double gauge);

/// Returns the shortest decimal text that gives exactly `si` when it is read back and multiplied by the unit's factor.
std::string text_in_unit(double si, const Unit& unit);

/// Returns the shortest decimal text that is read back to exactly `value`.
std::string shortest_text(double value);

}  // namespace dresslife::pipeline
