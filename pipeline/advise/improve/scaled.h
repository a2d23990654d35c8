// A dresspack of the same make in another size, for another robot.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// All lengths times factor, so masses per length and forces by its square, bending and twisting stiffness by
/// its fourth power, line loads as lengths, curvatures by its inverse; angles, counts, materials and times
/// stay. Strains at bends that are tighter by the same factor are then the same. Ratings are of the maker's
/// size and are dropped. factor: > 0.
Dresspack scaled(Dresspack dresspack, double factor);

}  // namespace dresslife::pipeline
