// A test rig for cables, as standards and makers describe it: what the cable is put through, cycle after
// cycle (sim/README.md, D4 to D8, say how it becomes a prescribed deformation). One repeat of the motion is
// one cycle of the rig, so a life in repeats is a life in rig cycles.
#pragma once

#include <optional>
#include <string_view>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

enum class RigKind { torsion, rolling_flex, two_pulley, tick_tock, swivel, axial };
constexpr std::string_view word(RigKind value) {
  return word_at({"torsion", "rolling_flex", "two_pulley", "tick_tock", "swivel", "axial"}, value);
}

struct Rig {
  RigKind kind = RigKind::torsion;
  std::optional<double> length;            ///< torsion: between the grips [m]
  std::optional<double> twist;             ///< torsion: to either side [rad/m]
  std::optional<double> radius;            ///< of mandrel, chain or clip's edge, see radius_to_axis() [m]
  std::optional<double> radius_diameters;  ///< instead of radius: in diameters of the cable
  std::optional<double> pulley_diameter;   ///< two_pulley [m]
  std::optional<double> travel;            ///< rolling_flex, two_pulley: of the moving end or carriage [m]
  std::optional<double> angle;             ///< tick_tock, swivel: to either side; two_pulley: wrapped [rad]
  std::optional<double> weight;            ///< that pulls on the cable [kg]
  std::optional<double> elongation;        ///< axial: to either side of the mean [%]
  std::optional<double> mean_elongation;   ///< axial [%]
  double cycles_per_minute = 30;           ///< turns cycles into hours; damage does not depend on it
  Where where;
};

void describe(Fields& f, Rig& rig);

/// Defaults of the kind filled in; echoing and reading it again gives the same. Errors: InputError for a key
/// that its kind lacks or does not have.
void check_rig(Rig& rig);

/// Bend radius of the cable's axis [m]. diameter: of the cable [m]. Precondition: a checked rig that bends.
double axis_radius(const Rig& rig, double diameter);

/// Along the cable of a rig in which a bend passes: a straight lead, then `bend` of cable that is bent at a
/// time, which moves on by `sweep`, and a lead again [m]. Of travel beyond 5/4 of the bend only so much is
/// followed: what the further cable sees is the same.
struct BendWay {
  double lead = 0, bend = 0, sweep = 0;
  double length() const { return 2 * lead + bend + sweep; }
};
BendWay bend_way(const Rig& rig, double diameter);

/// Of the cable that is evaluated [m].
double rig_length(const Rig& rig, double diameter);

/// Of the tested cable from clamp to clamp, at least [m]: rig_length(), or where a bend passes, the bend and the cable over
/// which it passes (rolling_flex: half the travel). Parts of a cable even their strain out over it (strain/slip.h).
double clamped_length(const Rig& rig, double diameter);

}  // namespace dresslife::pipeline
