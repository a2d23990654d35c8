// Stiffness and mass of a part without wires.
//
// A tube of polymer (polymer.h) with outer radius r and bore radius b has
//     E I = E pi (r^4 - b^4) / 4,   E A = E pi (r^2 - b^2),
//     mass per length = density pi (r^2 - b^2) + mass of what fills the bore.
// A bending stiffness that is given sets E.
#pragma once

#include "pipeline/job/plain_part.h"

namespace dresslife::pipeline {

/// Of a part of this radius [m].
struct PlainProperties {
  double bore = 0;     ///< inner radius [m]
  double bending = 0;  ///< E I [N m2]
  double axial = 0;    ///< E A [N]
  double mass = 0;     ///< per length [kg/m]
};
PlainProperties properties_of(const PlainPart& part, double radius);

}  // namespace dresslife::pipeline
