// Settings of dresslife-strain.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

class Fields;

enum class DeformationMeasure { rotation_vector, thesis };
enum class Kinematics { exact, thesis };
enum class Slip { free, stick, friction };
enum class Equivalent { axial, shear_included, critical_plane };

struct Probe {
  int segment_from_tool = 1;
  std::string component;  ///< path of a wire
};

struct Strain {
  DeformationMeasure deformation = DeformationMeasure::rotation_vector;
  Kinematics kinematics = Kinematics::exact;
  std::vector<Slip> slip{Slip::free};         ///< one for every level, or one per level, outermost first
  Equivalent equivalent = Equivalent::axial;  ///< which strain of a fibre is counted
  int surface_fibres = 1;                     ///< per wire; 0: the wire's axis
  double gate = 5e-4;                         ///< turning points of a smaller strain range are dropped
  std::vector<Probe> probes;
};

void describe(Fields& f, Probe& probe);
void describe(Fields& f, Strain& strain);

}  // namespace dresslife::pipeline
