// A job with one thing off by what an installer does not see: how much a routing forgives.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace dresslife::pipeline {

struct Nudge {
  std::string what;               ///< "base clamp, x + 10 mm"
  std::vector<std::string> sets;  ///< "KEY.PATH=VALUE"
};

/// Each coordinate of each clamp and ring, and the length, off to both sides [m]. jobs: nothing where their routings
/// differ, as no one change is that of all.
std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, double by);

}  // namespace dresslife::pipeline
