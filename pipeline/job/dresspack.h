// The dresspack: the hose as a rod, and what lies in it down to the wires.
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
/// +1 of a right-handed helix (Z), -1 of a left-handed one (S).
constexpr int sign_of(Hand value) { return value == Hand::right ? 1 : -1; }

/// Where a part of the first level lies in the cross-section of its dresspack.
enum class Position { automatic, held, loose };
constexpr std::string_view word(Position value) { return word_at({"auto", "held", "loose"}, value); }

/// Of what a hose's stiffness is taken from (stiffness.h): whether its parts slip.
enum class SlipState { sliding, friction, stuck };
constexpr std::string_view word(SlipState value) { return word_at({"sliding", "friction", "stuck"}, value); }

/// How a part of the first level is laid into its dresspack and clamped (strain/README.md, W32 to W37).
struct Laying {
  Position position = Position::automatic;
  double slack = 0;                 ///< length beyond the path on which it was installed [% of that]
  std::optional<double> play;       ///< from its place in any direction [m]; absent: what the hose leaves
  std::optional<double> base_grip;  ///< force at which the base clamp lets it slip [N]; absent: never
  std::optional<double> tool_grip;  ///< the same of the tool clamp [N]
  std::optional<double> mass;       ///< per length [kg/m]; absent: of wires and a filling of polymer
  bool operator==(const Laying&) const = default;
};

/// What wears: a sleeve over the hose, the jacket of a cable without a hose, or of a cable in a hose.
struct Sleeve {
  double thickness = 0;  ///< [m]
  std::string material;  ///< a key of Dresspack::materials
  Where where;
};

/// K equal parts on one helix, each of which may hold further layers of parts (strain/README.md).
struct Component {
  std::string name;         ///< "signal cable"; parts are numbered "signal cable 1", ...
  std::string layer;        ///< set where several layers of parts share a name: "layer 1"; else empty
  int count = 1;            ///< K
  double radius = 0;        ///< of the part [m]
  double helix_radius = 0;  ///< R, from the parent's axis to the part's [m]
  double lay_angle = 0;     ///< alpha >= 0 [rad]
  Hand hand = Hand::right;
  double phase = 0;                ///< theta_layer: angle of part 1 at the base clamp [rad]
  std::optional<double> friction;          ///< Coulomb, on what it lies against; absent: none
  std::optional<double> radial_line_load;  ///< presses the part on what it lies against [N/m]; absent: 0
  double tension = 0;                      ///< of the part in the dresspack at rest [N]
  double jacket_stiffness = 0;             ///< of a jacket that holds the part along its path [N/m2]
  std::optional<double> radial_stiffness;  ///< of what the helix lies on [N/m2]; absent: rigid
  std::optional<double> measured_bending_stiffness;  ///< M / curvature of a part with parts [N m2]
  double measured_at_curvature = 1;                  ///< [1/m]
  double polymer_bending_stiffness = 0;              ///< of it, of jacket and insulation [N m2]
  std::string material;            ///< of a wire; a key of Dresspack::materials; empty for a part with parts
  std::optional<PlainPart> plain;  ///< of a part of the first level that is no wire and holds none
  Laying laying;                   ///< of a part of the first level that is no wire
  std::vector<Rating> ratings;     ///< of a cable
  std::optional<Sleeve> jacket;    ///< of a cable in the dresspack; absent: its wear is not evaluated
  double stiffness_factor = 1;     ///< of jacket and insulation, by the temperature of the cell (pipeline/cable/warmth.h)
  std::vector<Component> components;
  Where where;
};

inline bool is_wire(const Component& part) { return part.components.empty() && !part.plain; }

/// The profile of a hose's wall, as a caliper finds it.
struct Corrugation {
  double pitch = 0;   ///< of one corrugation along the hose [m]
  double height = 0;  ///< half the difference of outer and inner diameter [m]
  double wall = 0;    ///< thickness of the material [m]
  Where where;
};

/// A spring beside the hose's elastic bending whose moment friction limits (S20 of sim/rod/theory.md).
struct BendingFriction {
  double stiffness = 0;  ///< while it holds [N m2]
  double slides_at = 0;  ///< from this change of curvature on [1/m]
};

struct Dresspack {
  std::string name, source;
  std::string estimates;  ///< keys that the user left out, with their values (estimates.h); empty: none
  bool cable_alone =
      false;            ///< it is one cable by itself (cable.h), whose stiffness and mass may be missing (0)
  double diameter = 0;  ///< outer, of the hose [m]
  double mass_per_length = 0;      ///< of the filled hose [kg/m]
  double bending_stiffness = 0;    ///< EI [N m2]
  double torsional_stiffness = 0;  ///< GJ [N m2]
  double axial_stiffness = 0;      ///< EA [N]
  /// Whether those four were taken from the construction, stiffnesses in that state and bent as far
  /// (stiffness.h).
  bool mass_from_construction = false;
  bool bending_from_construction = false, torsional_from_construction = false,
       axial_from_construction = false;
  SlipState construction_state = SlipState::friction;
  double construction_curvature = 1;             ///< [1/m]
  std::optional<double> core_bending_stiffness;  ///< of what fills the middle and is no component: EI [N m2]
  std::optional<double> core_torsional_stiffness;  ///< GJ [N m2]
  std::optional<double> core_axial_stiffness;      ///< EA [N]
  double rest_curvature = 0;                       ///< of the unloaded hose, toward x of its base clamp [1/m]
  double damping_time = 0;                         ///< Kelvin-Voigt tau of twist, and of bending without loss_factor [s]
  std::optional<double> loss_factor;               ///< of bending without friction; absent: damping_time's
  std::vector<BendingFriction> bending_friction;   ///< share of bending_stiffness that friction holds
  std::string damping_source;                      ///< where the damping was measured or why it is guessed
  double friction = 0;                             ///< Coulomb, hose against robot
  std::optional<double> least_bend_radius;         ///< allowed in motion [m]; absent: pipeline/cable/bend_limit.h
  std::optional<double> most_twist;                ///< allowed in motion [rad/m]; absent: 180 deg/m
  std::optional<double> most_tension;              ///< of the hose, allowed in motion [N]; absent: no limit
  std::string hose_material;                       ///< of the hose's wall; empty: its strain is not evaluated
  std::optional<double> hose_strain_factor;        ///< strain of the wall over that of a smooth hose
  std::optional<Corrugation> hose_corrugation;     ///< gives that factor instead; neither: a smooth hose
  std::optional<double> inner_diameter;  ///< in which parts can move [m]; absent: see inner_radius()
  double core_diameter = 0;              ///< of what fills the middle and is no component [m]
  std::string core_parts;                ///< what that is, in words; empty: not said
  std::vector<Component> core_components;  ///< parts of it that have a life; stiffness and mass are those of the keys core_..
  double stiffness_factor = 1;           ///< of the polymer of wall or jacket, by the temperature of the cell
  std::optional<Sleeve> sleeve;          ///< absent: abrasion wears the wall of hose_corrugation
  std::vector<Component> components;
  std::vector<Material> materials;  ///< those that the wires name, looked up in the catalogue
  std::vector<Rating> ratings;      ///< of a dresspack that is a cable itself
  Where where;
};

/// Radius of the space in which parts can move [m]: given, or within the corrugation; absent: it is no hose,
/// its parts are held by a jacket.
std::optional<double> inner_radius(const Dresspack& dresspack);

/// Of a loose part [rad]: W32 counts its slope R t to its square, which is cos(lay) of what it does, 0.94
/// here.
constexpr double steepest_loose_lay = std::numbers::pi / 9;

/// Whether a part of the first level lies loose: asked for, or in a hose and no steeper than that.
bool lies_loose(const Dresspack& dresspack, const Component& component);

/// One of dresspack.materials by its name; null: there is none.
const Material* find_material(const Dresspack& dresspack, std::string_view name);

/// The hose's wall as a part of the dresspack: "hose 1" to "hose 16" are places around it.
constexpr std::string_view hose_wall_name = "hose";
/// Whether a part's path in this dresspack names a place of the hose's wall, not a wire.
bool is_hose_wall(const Dresspack& dresspack, std::string_view component);

void describe(Fields& f, Component& component);
void describe(Fields& f, Corrugation& corrugation);
void describe(Fields& f, Sleeve& sleeve);
void describe(Fields& f, BendingFriction& friction);
void describe(Fields& f, Dresspack& dresspack);

/// Whether it holds a wire at any level.
bool has_wires(const Dresspack& dresspack);

/// E I of the hose without the friction in it: bending_stiffness less what bending_friction holds of it at
/// construction_curvature [N m2].
double elastic_bending_stiffness(const Dresspack& dresspack);
/// The simulation's links have room for so many.
inline constexpr std::size_t most_bending_frictions = 4;

/// Whether any of its stiffnesses is taken from its construction.
bool is_from_construction(const Dresspack& dresspack);

/// Takes out what no stage reads.
void drop_ratings(Dresspack& dresspack);

/// Levels of parts in it. slip: of the job. Errors: InputError at the part that does not fit into its parent
/// or has what its level or slip does not allow.
int check_dresspack(const Dresspack& dresspack, const std::vector<Slip>& slip);

}  // namespace dresslife::pipeline
