// Where the parts of a dresspack must lie: inside its bore, outside what fills its middle.
#pragma once

#include <optional>
#include <string>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Between what fills the middle and the bore of a dresspack: where its parts must lie.
struct PartsRoom {
  double bore = 0;  ///< radius [m]
  double core = 0;  ///< radius of what fills the middle and is no component [m]
  /// The bore is not given, and parts that are cables or hoses themselves may lie in a hose: taken as
  /// usual_bore_share of its diameter. Else, of a cable in its jacket, the bore is the diameter.
  bool estimated = false;
};
PartsRoom room_of_parts(const Dresspack& dresspack);
/// Of corrugated conduits as they are sold: 17 / 21.2, 23 / 28.5, 29 / 34.5, 36 / 42.5, 48 / 54.5 mm. ESTIMATE.
inline constexpr double usual_bore_share = 0.85;

/// Of such a conduit with the diameter and, if it is known, the bore of the dresspack: in the proportions of
/// config/dresspacks/handling.yaml. ESTIMATE.
Corrugation usual_corrugation(const Dresspack& dresspack);
/// "hose_corrugation: {pitch_mm: 3.38, height_mm: 3, wall_mm: 0.525}", a line of a dresspack.
std::string corrugation_line(const Corrugation& corrugation);

/// Of a diameter, as a caliper reads wrong: no part is refused for less.
inline constexpr double caliper_error = 0.02;

/// By how much the parts of a component of the first level lie outside the bore, and in the core [m]; 0: they do not,
/// or by no more than caliper_error.
double outside_bore(const PartsRoom& room, const Component& component);
double inside_core(const PartsRoom& room, const Component& component);

/// Parts for which a hose of known bore has no room, wherever they are put.
struct Crowd {
  Where where;               ///< of the thickest
  std::string what, remedy;  ///< in millimetres
};
/// A part thicker than the bore or than the gap between core and bore. Without a core: two parts of which one lies in the
/// middle, because it is written so or because it is wider than half the bore, with less room around it than the other needs.
/// Nothing: no such parts, or the bore is not given. Parts may still not fit: this compares two of them.
std::optional<Crowd> crowd_in(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
