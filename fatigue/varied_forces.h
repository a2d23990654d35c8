// Forces of cables that keep their limits with the job's own values, and exceed them with other values of an uncertain parameter.
#pragma once

#include <cstdint>
#include <vector>

#include "fatigue/cable_cures.h"
#include "pipeline/base/warnings.h"

namespace dresslife::fatigue {

/// The cables of a strain file, (cable).
struct FileCables {
  const std::vector<CableFacts>& facts;
  const std::vector<pipeline::CableForce>& force;
  const std::vector<std::int32_t>& span;
};

/// Largest force of a cable over its breaking force, and moment of all cables at a clamp over that of the hose.
struct ForceShares {
  double force = 0, moment = 0;
};

/// Returns at most one warning for each of both limits (pipeline/cable/believable.h). own: with the job's own values; a limit
/// that these exceed has no further warning. Empty if the file has no forces of variations.
std::vector<pipeline::Warning> varied_force_warnings(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                     const FileCables& cables, const ForceShares& own);

}  // namespace dresslife::fatigue
