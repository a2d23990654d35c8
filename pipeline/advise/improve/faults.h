// Faults of a dresspack's description, reported before a search for routings.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

struct Job;

/// Returns the faults of the dresspacks that no routing can cure. refuse: throws InputError for a cable that is compressed in its
/// room beyond the limit of all results.
std::vector<Warning> dresspack_faults(const Job& job, bool refuse);

}  // namespace dresslife::pipeline
