// Abrasion: number of repeats until the surface of a hose, sleeve or jacket is worn through.
//
// Archard's law: the worn volume is a wear rate k [m3/(N m)] times normal force times sliding distance (S23). The shape of the
// worn volume gives the depth. An obstacle is taken as flat across the hose.
// A round surface of radius R is worn to a depth h by contacts at angles spread over an arc b. It loses per length
//   A(h, b) = b h + 4/3 h sqrt(2 R h)                                                                       (F28)
// (a strip, and the two halves of a circular segment that is 2 sqrt(2 R h) wide). A corrugated wall touches only with
// crests of radius r = pitch/4. Each is worn off like a paraboloid:
//   A(h, b) = [ pi h^2 sqrt(R r) + 4/3 b h sqrt(2 r h) ] / pitch                                            (F29)
// With w(s, theta) the work by length and angle, A grows per repeat by k times the integral of w over the angles.
// Of all arcs b the one that is worn through first counts,
//   repeats = min over s, b of A(thickness, b) / (integral over b of k w)                                   (F30)
// exact for one angle and for an even distribution over a wide arc.
// Along the hose w is a mean over the footprint of a contact. A place that a rounded obstacle presses with N, and
// that yields by N/(footprint k_r), has a footprint of 2 (r_s N/k_r)^(1/3). With 50 N and k_r = 5e5 N/m2 (ESTIMATE,
// conduits under crushing loads) this is 40 mm on a link of radius 0.1 m, 70 mm where a hose of bend radius 0.5 m
// lies on a face, and 16 mm on an edge rounded with 5 mm. Used are one diameter, and at guide rings a quarter of it
// (ESTIMATES). Sliding spreads w along the hose in addition. A footprint longer than the segments makes the depth
// independent of them.
//
// The jacket of a cable wears by the same law on the inside of its hose and on its neighbours (W41). The footprint is
// ten diameters of the cable: before a place is worn through by t, the cable has to bend into it. The force for this bend is
// 384 E I t/l^4, 20 N/m for a cable of 0.03 N m2 at l = 0.16 m (ESTIMATE). The hose is taken as flat; its bore
// would widen the worn strip by an eighth. It is taken as smooth: the crests of a corrugated hose touch less than the whole
// cable, but each wears a strip of 2 sqrt(2 r thickness), 70 % of the pitch of the shipped hose.
//
// Not contained: wear of the obstacle, a patch that grows along the hose, heat of friction, dirt, cuts, running-in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/cable/warmth.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::fatigue {

/// The surface that is worn.
struct WornLayer {
  double radius = 0;     ///< R, outer radius of the hose [m]
  double thickness = 0;  ///< [m]
  double crest = 0;      ///< r; 0: smooth [m]
  double pitch = 0;      ///< of the corrugation [m]

  /// Returns A of (F28), (F29) [m2]. depth, arc: [m].
  double area(double depth, double arc) const;
};

/// The layer of a dresspack that is worn first, and its material. Without a hose and a sleeve it is the jacket of the cable.
struct WornMaterial {
  WornLayer layer;
  const pipeline::Material* material;  ///< of the dresspack
  pipeline::WarmWear warm{};           ///< factor on its wear rates
};
std::optional<WornMaterial> worn_of(const pipeline::Dresspack& dresspack);

/// Returns whether the dresspack has a hose around its parts.
bool is_hose(const pipeline::Dresspack& dresspack);

/// Returns whether the jacket of a cable is the surface of a dresspack without a hose: abrasion alone wears it.
bool is_surface(const pipeline::Dresspack& dresspack, const pipeline::Component& part);

/// Returns the jacket of a cable in the dresspack; std::nullopt: it or its wear rates are not given.
std::optional<WornMaterial> jacket_of(const pipeline::Dresspack& dresspack, const pipeline::Component& cable);

/// Returns the material's wear rate against an obstacle, which is named as in the strain file. Precondition: it has rates.
const pipeline::WearRate& wear_rate(const pipeline::Material& material, const std::string& obstacle);

/// A rubbed patch of the surface, as in the strain file.
struct RubbedPatch {
  double position = 0, length = 0;  ///< its middle, from the base clamp; its length [m]
  double angle = 0, width = 0;      ///< [rad]
  std::string obstacle;
  double work = 0;  ///< in one repeat [J]
  double time = 0;  ///< time of the largest work [s]
};

/// The place at which a dresspack is worn through first.
struct Abrasion {
  double repeats = 0;       ///< median; infinite: nothing rubs
  double log10_spread = 0;  ///< standard deviation of log10 of repeats, from wear rate and thickness
  double position = 0;      ///< from the base clamp [m]
  std::string obstacle;     ///< obstacle with the largest wear there
  double time = 0;          ///< [s]
  double arc = 0;           ///< b of the arc that is worn through first [m]
};

/// Returns the result of (F30). patches: of one dresspack, with sectors of one width.
Abrasion abrasion(const WornMaterial& worn, const std::vector<RubbedPatch>& patches);

/// Standard deviation of log10 of a thickness: a tenth, as walls of extruded hoses vary. ESTIMATE.
constexpr double thickness_spread = 0.0414;

}  // namespace dresslife::fatigue
