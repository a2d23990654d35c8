// A dresspack of the same make in another size, for another robot.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns a dresspack with all lengths multiplied by `factor`, masses per length and forces by its square, bending and twisting
/// stiffness by its fourth power, line loads as lengths, curvatures by its inverse. Angles, counts, materials and times do not
/// change. Strains at bends that are tighter by the same factor are then the same. Ratings belong to the maker's
/// size and are dropped. Precondition: factor > 0.
Dresspack scaled(Dresspack dresspack, double factor);

}  // namespace dresslife::pipeline
