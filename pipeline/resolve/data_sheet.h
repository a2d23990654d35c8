// A cable as its data sheet describes it ("7 x 0.5 mm2, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm,
// jacket 1.1 mm"), as the layers of cores and wires that it stands for.
//
// Equal parts of diameter D are packed as a stranding machine packs them: a first ring of s parts that touch,
// and rings around it, each D further out,
//     R_1 = D / (2 sin(pi/s)), 0 for s = 1;  R_(j+1) = R_j + D,
// with room for floor(pi / asin(D / 2 R)) parts in a ring. In the middle of six to nine lies one more; cores
// may also lie around a filler. Of all s the narrowest bundle is taken, of equal ones that with the fullest
// outer ring, whose parts are evenly spaced. A lay widens a ring until its neighbours touch (overlap.h).
//
// Conductors (IEC 60228, class 5 and 6) are described by their section: the number of wires is section over that
// of a wire, rounded. They are bunched: all wires have one lay length and one hand, against that of their
// core; rings of cores alternate. Without core_diameter_mm the cores are as thick as the jacket leaves room
// for. Where a sheet gives the conductor's class and not these lengths, the rules of the standards (cable_rules.h) stand
// in for the wire's diameter, the insulation, the jacket and the cable's diameter; each is marked as an ESTIMATE in the
// dresspack's source.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

struct DataSheet {
  int cores = 1;                           ///< or groups of them
  int cores_per_group = 1;                 ///< 2: pairs
  double cross_section = 0;                ///< of a core's metal, nominal [m2]
  int conductor_class = 0;                 ///< of IEC 60228: 5 or 6; 0: not given
  std::optional<double> wire_diameter;     ///< [m]
  std::optional<double> outer_diameter;    ///< of the cable [m]
  std::optional<double> jacket_thickness;  ///< with tapes and screens [m]
  std::string jacket_material;             ///< a name of config/materials; empty: its wear is not evaluated
  std::optional<double> core_diameter;     ///< over the insulation [m]
  std::optional<double> lay_length;        ///< of the cores, or groups [m]
  std::optional<double> group_lay_length;  ///< of the cores in a group [m]
  std::optional<double> wire_lay_length;   ///< [m]
  std::string material = "copper_halved";  ///< of the wires
  std::optional<double> friction;          ///< Coulomb, of cores and wires; absent: an ESTIMATE (estimates.h)
  std::optional<double> jacket_pressure;   ///< on cores and wires [Pa]; absent: an ESTIMATE
  std::string unused;                      ///< words of a sheet's line that change no result
  Where where;
};

class Fields;
void describe(Fields& f, DataSheet& sheet);

/// A sheet's line as keys of a data sheet: "7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer
/// diameter 8.2 mm, jacket PUR 1.1 mm". Of pairs "4 x 2 x 0.25 mm2", "pair lay length 20 mm"; "core
/// diameter 1.4 mm", "wire lay length 18 mm". The class may stand in for the lengths. A jacket's material (PUR,
/// TPU, PVC, TPE) gives its wear rates; others give none.
/// A jacket's material alone ("jacket PUR") leaves its thickness to the rules. Words that change nothing here ("shielded",
/// "UL 20276", "drag chain") are noted under the key `unused`.
/// Without the wire and the class, class 6 counts; with the wire alone, the jacket or core must be given. Decimal commas are
/// accepted. Errors: InputErrors at the line, one for each phrase that is none of these, with the key that takes it.
Node sheet_from_line(const Node& line);

enum class Fillers { none, allowed };

struct CoreRing {
  int count;
  double radius;     ///< from the bundle's axis to those of its parts [m]
  double lay_angle;  ///< >= 0 [rad]
};

/// Before what rules stand in for, in the source of a dresspack.
inline constexpr std::string_view estimate_mark = " ESTIMATE by rules: ";

/// Rings of `count` >= 1 parts of one diameter [m] and lay length [m] (infinity: straight), innermost first.
/// Errors: InputError at `where` for a lay too short for them to lie
/// beside each other.
std::vector<CoreRing> packed(int count, double diameter, double lay_length, Fillers fillers,
                             const Where& where);

/// Diameter of the circle around them [m].
double width_of(const std::vector<CoreRing>& rings, double diameter);

/// Replaces `data_sheet` in every component of a dresspack's tree by what it stands for: radius_mm and
/// components; says in `source` what rules stood in for, and in `estimates` every key that was left out, with its value. Errors: InputError at the sheet, which says what does not fit into what.
void expand_data_sheets(Node& dresspack);
/// The same. Components that cannot be are added to the problems, under `path` and their number.
void expand_data_sheets(Node& dresspack, const std::string& path, Problems& problems);

}  // namespace dresslife::pipeline
