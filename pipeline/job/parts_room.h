// The space for the parts of a dresspack: inside of its bore, outside of its core, which fills the middle.
#pragma once

#include <optional>
#include <string>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// The space between the core and the bore of a dresspack, for its parts.
struct PartsRoom {
  double bore = 0;  ///< radius [m]
  double core = 0;  ///< radius of the core, which fills the middle and is no component [m]
  /// true: the bore is unknown, and some parts are cables or hoses. Then the bore is usual_bore_share of the diameter. For a
  /// cable in its jacket, the bore is the diameter.
  bool estimated = false;
};
PartsRoom room_of_parts(const Dresspack& dresspack);
/// Returns whether the dresspack is a cable with a jacket, without a hose. Then its parts alone carry its pull.
bool is_single_cable(const Dresspack& dresspack);
/// Bore / outer diameter of a part that is a hose: tubes for air and water have 0.5 (4 x 2 mm) to 0.8 (16 x 13 mm), hydraulic hoses
/// with two steel braids 0.43. A tube of 10 x 8 mm has 0.40 if a radius is given instead of the diameter.
inline constexpr double narrowest_bore = 0.42, widest_bore = 0.92;
/// Bore / diameter of commercial corrugated conduits: 17 / 21.2, 23 / 28.5, 29 / 34.5, 36 / 42.5, 48 / 54.5 mm. ESTIMATE.
inline constexpr double usual_bore_share = 0.85;

/// Returns the profile of a conduit with the diameter and (if known) the bore of the dresspack, in the proportions of
/// config/dresspacks/handling.yaml. ESTIMATE.
Corrugation usual_corrugation(const Dresspack& dresspack);
/// Returns "hose_corrugation: {pitch_mm: 3.38, height_mm: 3, wall_mm: 0.525}", a line of a dresspack.
std::string corrugation_line(const Corrugation& corrugation);

/// Error of a caliper as a share of a diameter. A part that is too large by less is not refused.
inline constexpr double caliper_error = 0.02;

/// Returns how far the parts of a first-level component reach outside of the bore, or into the core [m]; 0: not at all, or by at
/// most caliper_error.
double outside_bore(const PartsRoom& room, const Component& component);
double inside_core(const PartsRoom& room, const Component& component);

/// Returns the keys of a hose whose bore is wide enough: "inner_diameter_mm: 58.5 or more". The bore of a corrugated hose follows from
/// its diameter and the height of its corrugations: "diameter_mm: 67.5 or more". bore: the least one [mm].
std::string wider_hose(double bore, double height, bool has_inner_diameter);
std::string wider_hose(double bore, const Dresspack& dresspack);

/// A conflict of parts that do not fit into a hose of known bore in any arrangement.
struct Crowd {
  Where where;               ///< of the thickest part
  std::string what, remedy;  ///< sizes in millimetres
};
/// Returns a part that is thicker than the bore or than the gap between core and bore. Without a core: also two parts of which
/// one is in the middle, because its key requires this or because it is wider than half the bore, and leaves too little space for
/// the other. std::nullopt: no such parts, or an unknown bore. The parts may still not fit, because only two of them are
/// compared.
std::optional<Crowd> crowd_in(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
