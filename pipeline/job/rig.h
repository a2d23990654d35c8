// A test rig for cables, as in standards and data sheets: a deformation of the cable that repeats (sim/run/rig_deformation.h, D4 to D8,
// describe the prescribed deformation). One repeat of the motion is one cycle of the rig, so a life in repeats is a life in rig
// cycles.
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
  std::optional<double> radius;            ///< of mandrel, chain or edge of a clip, see axis_radius() [m]
  std::optional<double> radius_diameters;  ///< instead of radius: in diameters of the cable
  std::optional<double> pulley_diameter;   ///< two_pulley [m]
  std::optional<double> travel;            ///< rolling_flex, two_pulley: of the moving end or carriage [m]
  std::optional<double> angle;             ///< tick_tock, swivel: to either side; two_pulley: wrapped [rad]
  std::optional<double> weight;            ///< mass that pulls on the cable [kg]
  std::optional<double> elongation;        ///< axial: to either side of the mean [%]
  std::optional<double> mean_elongation;   ///< axial [%]
  double cycles_per_minute = 30;           ///< converts cycles into hours; does not affect damage
  Where where;
};

void describe(Fields& f, Rig& rig);

/// Fills in the defaults of the kind. Echoing and reading the rig again gives the same rig. Errors: InputError for a missing key,
/// or a key that the kind does not have.
void check_rig(Rig& rig);

/// Returns the bend radius of the cable's axis [m]. diameter: of the cable [m]. Precondition: a checked rig that bends the cable.
double axis_radius(const Rig& rig, double diameter);

/// Sections along the cable of a rig whose bend moves along the cable [m]: a straight lead, the length `bend` that is bent at one
/// time and moves by `sweep`, and a second lead. A travel beyond 5/4 of the bend is shortened to this length, because further
/// cable experiences the same deformation.
struct BendWay {
  double lead = 0, bend = 0, sweep = 0;
  double length() const { return 2 * lead + bend + sweep; }
};
BendWay bend_way(const Rig& rig, double diameter);

/// Returns the length of the evaluated cable [m].
double rig_length(const Rig& rig, double diameter);

/// Returns the least length of the tested cable from clamp to clamp [m]: rig_length(), for a moving bend the bend plus its travel
/// along the cable (rolling_flex: half the travel of the end), for a swivel, tick-tock and a pull a length of many turns. Strain in
/// the parts of a cable is averaged over this length (strain/slip.h).
double clamped_length(const Rig& rig, double diameter);

}  // namespace dresslife::pipeline
