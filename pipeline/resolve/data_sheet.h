// Converts a cable's data sheet ("7 x 0.5 mm2, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket 1.1 mm") into layers
// of cores and wires.
//
// Equal parts of diameter D are arranged like in a stranding machine: a first ring of s parts that touch, and rings
// around it, each further out by D,
//     R_1 = D / (2 sin(pi/s)), 0 for s = 1;  R_(j+1) = R_j + D,
// with space for floor(pi / asin(D / 2 R)) parts in a ring. One more part is in the middle of six to nine. Cores may also lie
// around a filler. The chosen s gives the narrowest bundle; among equal ones, that with the fullest outer ring. The parts of a
// ring are evenly spaced. A lay widens a ring until its neighbours touch (overlap.h).
//
// Conductors (IEC 60228, class 5 and 6) are described by their section: the number of wires is the section / the section of a
// wire, rounded. Conductors are bunched: all wires have one lay length and one hand, opposite to that of their core. Rings of
// cores alternate in hand. Without core_diameter_mm, the cores fill the space inside of the jacket. If a sheet has the
// conductor's class, the rules of standards (cable_rules.h) replace a missing wire diameter, insulation, jacket and cable
// diameter. Each of them is marked as an ESTIMATE in the dresspack's source.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

struct DataSheet {
  int cores = 1;                           ///< or groups of cores
  int cores_per_group = 1;                 ///< 2: pairs
  double cross_section = 0;                ///< of a core's metal, nominal value [m2]
  int conductor_class = 0;                 ///< of IEC 60228: 5 or 6; 0: missing
  std::optional<double> wire_diameter;     ///< [m]
  std::optional<double> outer_diameter;    ///< of the cable [m]
  std::optional<double> jacket_thickness;  ///< including tapes and screens [m]
  std::string jacket_material;             ///< a name of config/materials; empty: wear of the jacket is not evaluated
  std::optional<double> core_diameter;     ///< over the insulation [m]
  std::optional<double> lay_length;        ///< of the cores, or groups [m]
  std::optional<double> group_lay_length;  ///< of the cores in a group [m]
  std::optional<double> wire_lay_length;   ///< [m]
  std::string material = "copper_halved";  ///< of the wires
  std::optional<double> friction;         ///< Coulomb coefficient of cores and wires; absent: an ESTIMATE (estimates.h)
  std::optional<double> jacket_pressure;  ///< on cores and wires [Pa]; absent: an ESTIMATE
  std::string shield;                     ///< words of a sheet's line for a shield; its wires are not evaluated
  std::string unused;                     ///< words of a sheet's line that do not affect results
  Where where;
};

class Fields;
void describe(Fields& f, DataSheet& sheet);

/// Returns the keys of a data sheet for a line such as "7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer diameter 8.2
/// mm, jacket PUR 1.1 mm". For pairs: "4 x 2 x 0.25 mm2", "pair lay length 20 mm". Further phrases: "core diameter 1.4 mm", "wire
/// lay length 18 mm". The class may replace the lengths. A jacket's material determines its wear rates (PUR, TPU, PVC, TPE;
/// others have none). A jacket's material alone ("jacket PUR") gets its thickness from the rules. Words for a shield ("shielded",
/// "(C)", "copper braid"), also beside another phrase without a comma, are stored under the key `shield`, words without effect ("UL
/// 20276", "drag chain") under `unused`. Without wire and class, class 6 is used. With the
/// wire alone, the jacket or the core is required. Decimal commas are accepted. Errors: InputErrors at the line, one for each
/// unknown phrase, with the key that it probably means.
Node sheet_from_line(const Node& line);

/// Returns the phrases of a sheet's line with two examples, for the manual.
std::string sheet_syntax();

enum class Fillers { none, allowed };

struct CoreRing {
  int count;
  double radius;     ///< from the bundle's axis to the axes of its parts [m]
  double lay_angle;  ///< >= 0 [rad]
};

/// Text before the estimated values in the source of a dresspack.
inline constexpr std::string_view estimate_mark = " ESTIMATE by rules: ";

/// Returns the rings of `count` >= 1 parts of one diameter [m] and lay length [m] (infinity: straight), innermost first. Errors:
/// InputError at `where` for a lay length that is too short for the parts of a ring.
std::vector<CoreRing> packed(int count, double diameter, double lay_length, Fillers fillers, const Where& where);

/// Returns the diameter of the circle around the rings [m].
double width_of(const std::vector<CoreRing>& rings, double diameter);

/// Replaces `data_sheet` in every component of a dresspack's tree by radius_mm and components. Writes the lengths from rules into
/// `source`, and every missing key with its value into `estimates`. Errors: InputError at the sheet, with the parts that do not
/// fit into each other.
void expand_data_sheets(Node& dresspack);
/// Expands data sheets and adds errors to `problems`, under `path` and the number of the component.
void expand_data_sheets(Node& dresspack, const std::string& path, Problems& problems);

}  // namespace dresslife::pipeline
