// Settings of dresslife-strain. Enumerations as in fatigue.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/job/kinematics.h"

namespace dresslife::pipeline {

class Fields;

enum class DeformationMeasure { rotation_vector, thesis };
constexpr std::string_view word(DeformationMeasure value) {
  return word_at({"rotation_vector", "thesis"}, value);
}
/// Whether curvature and twist are the thesis' (24).
constexpr bool is_thesis(DeformationMeasure value) { return value == DeformationMeasure::thesis; }

enum class Slip { free, stick, friction };
constexpr std::string_view word(Slip value) { return word_at({"free", "stick", "friction"}, value); }
/// Whether a part may move along its parent.
constexpr bool slides(Slip value) { return value != Slip::stick; }
/// Whether friction holds it back there.
constexpr bool rubs(Slip value) { return value == Slip::friction; }

enum class Equivalent { axial, shear_included, critical_plane };
constexpr std::string_view word(Equivalent value) {
  return word_at({"axial", "shear_included", "critical_plane"}, value);
}
/// Whether the shear of a wire enters its strain (W19).
constexpr bool counts_shear(Equivalent value) { return value != Equivalent::axial; }
/// Whether planes are judged one by one (F18).
constexpr bool judges_planes(Equivalent value) { return value == Equivalent::critical_plane; }

struct ProbeRequest {
  int segment_from_tool = 1;
  std::string component;  ///< path of a wire
};

/// Of what is not known of cables and their hose (uncertainty.h): everything as the dresspack says at 1.
struct StrainFactors {
  double friction = 1;       ///< of friction coefficients inside the cables
  double hose_friction = 1;  ///< of those of cables in a hose
  double slack = 1;          ///< of slack_percent
  double play = 1;           ///< of the room in which loose cables can move
  double grip = 1;           ///< of base_grip_N and tool_grip_N
  bool operator==(const StrainFactors&) const = default;
};

/// Beyond, a segment is too long to tell what a cable does within it.
constexpr int most_cable_elements = 16;

struct Strain {
  DeformationMeasure deformation = DeformationMeasure::rotation_vector;
  Kinematics kinematics = Kinematics::exact;
  std::vector<Slip> slip{Slip::friction};     ///< one for every level, or one per level, outermost first
  Equivalent equivalent = Equivalent::axial;  ///< which strain of a fibre is counted
  int surface_fibres = 1;                     ///< per wire; 0: the wire's axis
  double gate = 5e-4;                         ///< turning points of a smaller strain range are dropped
  int cable_elements = 0;                     ///< pieces of a loose cable per segment; 0: as its waves ask
  std::vector<ProbeRequest> probes;
  StrainFactors factors;
  double rest = 0;  ///< normal quantile of the place of rest of loose cables: 0, that with the median life
};

void describe(Fields& f, ProbeRequest& probe);
void describe(Fields& f, Strain& strain);

}  // namespace dresslife::pipeline
