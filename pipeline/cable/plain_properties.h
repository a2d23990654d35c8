// Stiffness and mass of a part without wires.
//
// A tube of polymer (polymer.h) with outer radius r and bore radius b has
//     E I = E pi (r^4 - b^4) / 4,   E A = E pi (r^2 - b^2),
//     mass per length = density pi (r^2 - b^2) + mass of the content of the bore.
// A given bending stiffness determines E.
#pragma once

#include "pipeline/job/plain_part.h"

namespace dresslife::pipeline {

/// Properties of a part with a given radius [m].
struct PlainProperties {
  double bore = 0;     ///< inner radius [m]
  double bending = 0;  ///< E I [N m2]
  double axial = 0;    ///< E A [N]
  double mass = 0;     ///< per length [kg/m]
};
PlainProperties properties_of(const PlainPart& part, double radius);

}  // namespace dresslife::pipeline
