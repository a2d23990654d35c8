// Result of a calibration as a complete SVG file: each parameter before and after, and each row's observed life with
// its predictions before and after.
#pragma once

#include <string>

#include "pipeline/advise/calibrate/learning.h"

namespace dresslife::pipeline {

std::string calibration_picture(const Learned& learned);

}  // namespace dresslife::pipeline
