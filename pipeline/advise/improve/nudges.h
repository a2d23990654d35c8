// A job with one clamp, ring or its length off by the mounting tolerance.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace dresslife::pipeline {

struct Nudge {
  std::string what;               ///< "base clamp, x + 10 mm"
  std::vector<std::string> sets;  ///< "KEY.PATH=VALUE"
};

/// Each coordinate of each clamp and ring, and the length, off to both sides [m]. Empty if the routings of the jobs
/// differ.
std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, double by);

}  // namespace dresslife::pipeline
