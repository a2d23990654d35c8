// The dresspack: the hose as a rod, and its parts down to the wires.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/job/material.h"
#include "pipeline/job/plain_part.h"
#include "pipeline/job/rating.h"
#include "pipeline/job/strain.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

enum class Hand { right, left };
constexpr std::string_view word(Hand value) { return word_at({"right", "left"}, value); }
/// Returns +1 for a right-handed helix (Z), -1 for a left-handed one (S).
constexpr int sign_of(Hand value) { return value == Hand::right ? 1 : -1; }

/// Position of a first-level part in the cross-section of its dresspack.
enum class Position { automatic, held, loose };
constexpr std::string_view word(Position value) { return word_at({"auto", "held", "loose"}, value); }

/// State of the parts for which a hose's stiffness is computed (stiffness.h).
enum class SlipState { sliding, friction, stuck };
constexpr std::string_view word(SlipState value) { return word_at({"sliding", "friction", "stuck"}, value); }

/// How a first-level part lies in its dresspack and how it is clamped (strain/theory.md, W32 to W37).
struct Laying {
  Position position = Position::automatic;
  double slack = 0;            ///< excess length over the path on which it was installed [% of that path]
  std::optional<double> play;  ///< free movement from its place in any direction [m]; absent: the room in the hose
  std::optional<double>
      base_grip;  ///< force at which the part slips through the base clamp [N]; absent: it never slips
  std::optional<double>
      tool_grip;               ///< force at which the part slips through the tool clamp [N]; absent: it never slips
  std::optional<double> mass;  ///< per length [kg/m]; absent: computed from wires and a polymer filling
  bool operator==(const Laying&) const = default;
};

/// A layer that wears: a sleeve over the hose, or the jacket of a cable.
struct Sleeve {
  double thickness = 0;  ///< [m]
  std::string material;  ///< a key of Dresspack::materials
  Where where;
};

/// K equal parts on one helix. Each of them may contain further layers of parts (strain/theory.md).
struct Component {
  std::string name;  ///< "signal cable"; parts are numbered "signal cable 1", ...
  std::string
      entry;  ///< number of its entry in the user's list, if `place: auto` divided entries of that list; else empty
  std::string layer;        ///< set if several layers of parts share a name: "layer 1"; else empty
  int count = 1;            ///< K
  double radius = 0;        ///< of the part [m]
  double helix_radius = 0;  ///< R, from the parent's axis to the part's [m]
  double lay_angle = 0;     ///< alpha >= 0 [rad]
  Hand hand = Hand::right;
  double phase = 0;                ///< theta_layer: angle of part 1 at the base clamp [rad]
  std::optional<double> friction;  ///< Coulomb coefficient against the surfaces that the part touches; absent: none
  std::optional<double> radial_line_load;            ///< line load between the part and its support [N/m]; absent: 0
  double tension = 0;                                ///< tension in the part while the dresspack is at rest [N]
  double jacket_stiffness = 0;                       ///< of a jacket that holds the part along its path [N/m2]
  std::optional<double> radial_stiffness;            ///< of the support under the helix [N/m2]; absent: rigid
  std::optional<double> measured_bending_stiffness;  ///< moment / curvature of a part that has parts [N m2]
  double measured_at_curvature = 1;                  ///< curvature of that measurement [1/m]
  double polymer_bending_stiffness = 0;              ///< its share from jacket and insulation [N m2]
  std::string material;            ///< of a wire; a key of Dresspack::materials; empty if the part has parts
  std::optional<PlainPart> plain;  ///< of a first-level part without wires
  Laying laying;                   ///< of a first-level part that is no wire
  std::vector<Rating> ratings;     ///< of a cable
  std::optional<Sleeve> jacket;    ///< of a cable in the dresspack; absent: its wear is not evaluated
  double stiffness_factor = 1;     ///< of jacket and insulation at the cell's temperature (pipeline/cable/warmth.h)
  std::vector<Component> components;
  Where where;
};

/// Returns the number of a component in a key path: that of its entry in the user's list.
inline std::string entry_number(const std::vector<Component>& components, std::size_t k) {
  return components[k].entry.empty() ? std::to_string(k + 1) : components[k].entry;
}

inline bool is_wire(const Component& part) { return part.components.empty() && !part.plain; }

/// Profile of a corrugated wall, as measured with a caliper.
struct Corrugation {
  double pitch = 0;   ///< of one corrugation along the hose [m]
  double height = 0;  ///< half the difference of outer and inner diameter [m]
  double wall = 0;    ///< thickness of the material [m]
  Where where;
};

/// A spring in parallel to the elastic bending of the hose. Friction limits its moment (S20 of sim/rod/theory.md).
struct BendingFriction {
  double stiffness = 0;  ///< before it slides [N m2]
  double slides_at = 0;  ///< change of curvature at which it begins to slide [1/m]
};

constexpr double least_lay_factor = 0.5, most_lay_factor = 2;  ///< range of estimated_lay_factor

struct Dresspack {
  std::string name, source;
  std::string estimates;  ///< keys that the user omitted, with their estimated values (estimates.h); empty: none
  std::optional<double> estimated_lay_factor;  ///< of lay lengths that data sheets leave out; absent: 1
  bool cable_alone =
      false;            ///< the dresspack is a single cable (cable_alone.h); its stiffness and mass may be unknown (0)
  double diameter = 0;  ///< outer, of the hose [m]
  double mass_per_length = 0;      ///< of the filled hose [kg/m]
  double bending_stiffness = 0;    ///< EI [N m2]
  double torsional_stiffness = 0;  ///< GJ [N m2]
  double axial_stiffness = 0;      ///< EA [N]
  /// Whether the preceding four values were computed from the construction. The stiffnesses are those in construction_state at
  /// construction_curvature (stiffness.h).
  bool mass_from_construction = false;
  bool bending_from_construction = false, torsional_from_construction = false, axial_from_construction = false;
  SlipState construction_state = SlipState::friction;
  double construction_curvature = 1;             ///< [1/m]
  std::optional<double> core_bending_stiffness;  ///< EI of the core, which fills the middle and is no component [N m2]
  std::optional<double> core_torsional_stiffness;  ///< GJ of the core [N m2]
  std::optional<double> core_axial_stiffness;      ///< EA of the core [N]
  double rest_curvature = 0;                       ///< of the unloaded hose, toward x of the base clamp [1/m]
  double damping_time = 0;                        ///< Kelvin-Voigt tau of twist, and of bending without loss_factor [s]
  std::optional<double> loss_factor;              ///< of bending without friction; absent: damping_time is used
  std::vector<BendingFriction> bending_friction;  ///< shares of bending_stiffness that friction limits
  std::string damping_source;                   ///< source of the damping: a measurement, or the reason of an estimate
  double friction = 0;                          ///< Coulomb coefficient, hose against robot
  std::optional<double> least_bend_radius;      ///< allowed in motion [m]; absent: pipeline/cable/bend_limit.h
  Where least_bend_radius_where = {};           ///< of its key
  std::optional<double> most_twist;             ///< allowed in motion [rad/m]; absent: 180 deg/m
  std::optional<double> most_tension;           ///< of the hose, allowed in motion [N]; absent: no limit
  std::string hose_material;                    ///< of the hose's wall; empty: the strain of the wall is not evaluated
  std::optional<double> hose_strain_factor;     ///< strain of the wall / strain of a smooth hose
  std::optional<Corrugation> hose_corrugation;  ///< determines that factor instead; both absent: a smooth hose
  std::optional<double> inner_diameter;  ///< of the space in which parts can move [m]; absent: see inner_radius()
  double core_diameter = 0;              ///< of the core, which fills the middle and is no component [m]
  std::string core_parts;                ///< content of the core in words; empty: unknown
  std::vector<Component>
      core_components;  ///< parts of the core with a life; the keys core_.. contain their stiffness, mass_per_length their mass
  double stiffness_factor = 1;   ///< of the polymer of wall or jacket at the cell's temperature
  std::optional<Sleeve> sleeve;  ///< absent: abrasion acts on the wall of hose_corrugation
  std::vector<Component> components;
  std::vector<Material> materials;  ///< materials of the wires, from the catalogue
  std::vector<Rating> ratings;      ///< of a dresspack that is a single cable
  Where where;
};

/// Returns the radius of the space in which parts can move [m]: the given value, or the radius inside of the corrugation.
/// std::nullopt: the dresspack is no hose; a jacket holds its parts.
std::optional<double> inner_radius(const Dresspack& dresspack);

/// Largest lay angle of a loose part [rad]. W32 computes with the slope R t squared, which is larger than the exact value by a
/// factor of 1/cos(lay). cos(lay) is 0.94 at this angle.
constexpr double steepest_loose_lay = std::numbers::pi / 9;

/// Returns whether a first-level part is loose: by its key, or because it is in a hose and its lay angle is at most
/// steepest_loose_lay.
bool lies_loose(const Dresspack& dresspack, const Component& component);

/// Returns the material of this name from dresspack.materials; null if it is missing.
const Material* find_material(const Dresspack& dresspack, std::string_view name);

/// The hose's wall as a part of the dresspack: "hose 1" to "hose 16" are places around the circumference.
constexpr std::string_view hose_wall_name = "hose";
/// Returns whether a path in this dresspack names a place on the hose's wall instead of a wire.
bool is_hose_wall(const Dresspack& dresspack, std::string_view component);

void describe(Fields& f, Component& component);
void describe(Fields& f, Corrugation& corrugation);
void describe(Fields& f, Sleeve& sleeve);
void describe(Fields& f, BendingFriction& friction);
void describe(Fields& f, Dresspack& dresspack);

/// Returns whether the dresspack contains a wire at any level.
bool has_wires(const Dresspack& dresspack);

/// Returns E I of the hose without friction [N m2]: bending_stiffness minus the share of bending_friction in it at
/// construction_curvature.
double elastic_bending_stiffness(const Dresspack& dresspack);
/// Largest number of bending frictions, limited by the space in the simulation's links.
inline constexpr std::size_t most_bending_frictions = 4;

/// Returns whether any of its stiffnesses or its mass is computed from its construction.
bool is_from_construction(const Dresspack& dresspack);

/// Returns whether its bending stiffness is a number without the part of it that is friction, and its parts have friction.
bool lacks_friction(const Dresspack& dresspack);

/// Removes keys that only dresslife-fatigue uses: ratings, core components, damage exponents and least bend radii.
void drop_ratings(Dresspack& dresspack);

/// Returns the number of levels of parts. slip: setting of the job. Errors: InputErrors at each part that does not fit into its
/// parent, or has a key that its level or slip does not allow.
int check_dresspack(const Dresspack& dresspack, const std::vector<Slip>& slip);

}  // namespace dresslife::pipeline
