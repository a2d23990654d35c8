// Faults of a dresspack's description, reported before a search for routings.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

struct Job;

/// What is wrong with the dresspacks whatever their routing. refuse: Errors: InputError for a cable that its room
/// presses beyond the limit that every result must keep, so that no routing can.
std::vector<Warning> dresspack_faults(const Job& job, bool refuse);

}  // namespace dresslife::pipeline
