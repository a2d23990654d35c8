// What observations have taught, as a picture that stands alone (SVG): each parameter before and after, and
// each row's life as it was foretold before and after beside what was seen.
#pragma once

#include <string>

#include "pipeline/advise/calibrate/learning.h"

namespace dresslife::pipeline {

std::string calibration_picture(const Learned& learned);

}  // namespace dresslife::pipeline
