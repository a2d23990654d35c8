// Faults of a dresspack's description, reported before a search for routings.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

struct Job;

/// Faults of the dresspacks that no routing can cure. refuse: InputError for a cable that is pressed in its room beyond
/// the limit of all results.
std::vector<Warning> dresspack_faults(const Job& job, bool refuse);

}  // namespace dresslife::pipeline
