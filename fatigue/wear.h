// Abrasion: after how many repeats the surface of a hose, sleeve or jacket is worn through.
//
// Archard's law: the worn volume is a wear rate k [m3/(N m)] times normal force times sliding way (S23). It becomes
// a depth by the shape of what is worn off. An obstacle is taken as flat across the hose.
// A round surface of radius R, worn to a depth h by contacts at angles that spread over an arc b, loses per length
//   A(h, b) = b h + 4/3 h sqrt(2 R h)                                                                       (F28)
// (a strip, and the two halves of a circle's segment that is 2 sqrt(2 R h) wide). A corrugated wall touches with
// crests of radius r = pitch/4 only. Each is worn off like a paraboloid:
//   A(h, b) = [ pi h^2 sqrt(R r) + 4/3 b h sqrt(2 r h) ] / pitch                                            (F29)
// With w(s, theta) the work by length and angle, A grows per repeat by k times the integral of w over the angles.
// Of all arcs b that one counts which is worn through first,
//   repeats = min over s, b of A(thickness, b) / (integral over b of k w)                                   (F30)
// exact for one angle and for an even distribution over a wide arc.
// Along the hose w is a mean over the footprint of a contact. A place that a rounded obstacle presses with N, and
// that gives by N/(footprint k_r), has a footprint of 2 (r_s N/k_r)^(1/3). With 50 N and k_r = 5e5 N/m2 (ESTIMATE,
// conduits under crushing loads) that is 40 mm on a link of radius 0.1 m, 70 mm where a hose of bend radius 0.5 m
// lies on a face, and 16 mm on an edge rounded with 5 mm. So one diameter, and at guide rings a quarter of it
// (ESTIMATES). Sliding spreads w along the hose by itself. A footprint longer than the segments makes the depth
// independent of them.
//
// The jacket of a cable wears by the same law on the inside of its hose and on its neighbours (W41), with a footprint
// of ten diameters of the cable: before a place is worn through by t, the cable has to bend into it, and 384 E I t/l^4
// is what presses, 20 N/m of a cable of 0.03 N m2 at l = 0.16 m (ESTIMATE). The hose counts as flat, where its bore
// would widen the worn strip by an eighth. It counts as smooth: the crests of a corrugated hose touch less than all of
// the cable, but each wears a strip of 2 sqrt(2 r thickness), 70 % of the pitch of the shipped hose.
//
// Not contained: wear of the obstacle, a patch that grows along the hose, heat of friction, dirt, cuts, running-in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/cable/warmth.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::fatigue {

/// The surface that wears.
struct WornLayer {
  double radius = 0;     ///< R, outer radius of the hose [m]
  double thickness = 0;  ///< [m]
  double crest = 0;      ///< r, 0: it is smooth [m]
  double pitch = 0;      ///< of the corrugation [m]

  /// A of (F28), (F29) [m2]; depth, arc [m].
  double area(double depth, double arc) const;
  /// The depth at which area(depth, arc) has this value [m].
  double depth(double area, double arc) const;
};

/// The layer that a dresspack wears first, and its material; nothing: its thickness or its wear rates are not given.
struct WornMaterial {
  WornLayer layer;
  const pipeline::Material* material;  ///< of the dresspack's
  pipeline::WarmWear warm{};           ///< factor on its rates
};
std::optional<WornMaterial> worn_of(const pipeline::Dresspack& dresspack);

/// The jacket of a cable in the dresspack; nothing: it is not given.
std::optional<WornMaterial> jacket_of(const pipeline::Dresspack& dresspack, const pipeline::Component& cable);

/// Of a material with rates: against an obstacle of the strain file by its name.
const pipeline::WearRate& wear_rate(const pipeline::Material& material, const std::string& obstacle);

/// A patch of surface as in the strain file.
struct RubbedPatch {
  double position = 0, length = 0;  ///< its middle, from the base clamp; its length [m]
  double angle = 0, width = 0;      ///< [rad]
  std::string obstacle;
  double work = 0;  ///< of one repeat [J]
  double time = 0;  ///< when it is rubbed most [s]
};

/// Where a dresspack is worn through first.
struct Abrasion {
  double repeats = 0;       ///< in the median; infinite: nothing rubs
  double log10_spread = 0;  ///< standard deviation of log10 of repeats, by rate and thickness
  double position = 0;      ///< from the base clamp [m]
  std::string obstacle;     ///< that wears most there
  double time = 0;          ///< [s]
  double arc = 0;           ///< b that is worn through first [m]
};

/// (F30). patches: of one dresspack, sectors of one width.
Abrasion abrasion(const WornMaterial& worn, const std::vector<RubbedPatch>& patches);

/// Standard deviation of log10 of a thickness: a tenth, as walls of extruded hoses vary. ESTIMATE.
constexpr double thickness_spread = 0.0414;

}  // namespace dresslife::fatigue
