// Settings of dresslife-strain. The enumerations are like those of fatigue.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/job/kinematics.h"

namespace dresslife::pipeline {

class Fields;

enum class DeformationMeasure { rotation_vector, thesis };
constexpr std::string_view word(DeformationMeasure value) { return word_at({"rotation_vector", "thesis"}, value); }
/// Returns whether curvature and twist are computed by (24) of the thesis.
constexpr bool is_thesis(DeformationMeasure value) { return value == DeformationMeasure::thesis; }

enum class Slip { free, stick, friction };
constexpr std::string_view word(Slip value) { return word_at({"free", "stick", "friction"}, value); }
/// Returns whether a part may move along its parent.
constexpr bool slides(Slip value) { return value != Slip::stick; }
/// Returns whether friction limits this motion.
constexpr bool rubs(Slip value) { return value == Slip::friction; }

enum class Equivalent { axial, shear_included, critical_plane };
constexpr std::string_view word(Equivalent value) {
  return word_at({"axial", "shear_included", "critical_plane"}, value);
}
/// Returns whether the shear of a wire contributes to its strain (W19).
constexpr bool counts_shear(Equivalent value) { return value != Equivalent::axial; }
/// Returns whether damage is computed for several planes (F18).
constexpr bool judges_planes(Equivalent value) { return value == Equivalent::critical_plane; }

struct ProbeRequest {
  int segment_from_tool = 1;
  std::string component;  ///< path of a wire
};

/// Uncertain parameters of cables and their hose (uncertainty.h). At 1, the values of the dresspack apply.
struct StrainFactors {
  double friction = 1;       ///< factor of friction coefficients inside the cables
  double hose_friction = 1;  ///< factor of friction coefficients of cables in a hose
  double slack = 1;          ///< factor of slack_percent
  double play = 1;           ///< factor of the space in which loose cables can move
  double grip = 1;           ///< factor of base_grip_N and tool_grip_N
  bool operator==(const StrainFactors&) const = default;
};

/// Largest number of elements per segment. A segment that needs more is too long to compute the motion of a cable in it.
constexpr int most_cable_elements = 16;

struct Strain {
  DeformationMeasure deformation = DeformationMeasure::rotation_vector;
  Kinematics kinematics = Kinematics::exact;
  std::vector<Slip> slip{Slip::friction};     ///< one for all levels, or one per level, outermost first
  Equivalent equivalent = Equivalent::axial;  ///< strain of a fibre that is counted
  int surface_fibres = 1;                     ///< per wire; 0: the wire's axis
  /// Reversals with a smaller strain range are dropped. An amplitude of half the default has a life of 1.6e14 cycles in soft
  /// copper by (8) of fatigue/theory.md; lives end at 5e14.
  double gate = 2e-4;
  int cable_elements = 0;  ///< elements of a loose cable per segment; 0: chosen from its wave length
  std::vector<ProbeRequest> probes;
  StrainFactors factors;
  double rest = 0;  ///< normal quantile of the rest position of loose cables: 0: the position with the median life
};

void describe(Fields& f, ProbeRequest& probe);
void describe(Fields& f, Strain& strain);

}  // namespace dresslife::pipeline
