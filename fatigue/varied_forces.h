// Forces of cables that keep their limits with the job's own values, and exceed them with other values of an uncertain parameter.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fatigue/cable_cures.h"
#include "pipeline/base/warning_words.h"

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

/// Returns the slack of all entries of cables together with which the run would warn of no force, from the forces at its other
/// slacks; if no slack does so, the slack with a measurement of it, or what else cures. The ring of cables turns as a whole, so
/// that one cable alone with another slack is held by its neighbours: on a KUKA KR 210 half the slack of one of four entries raised the
/// clamps' moment at a softer hose from 0.6 to 23 times its limit, and that of all to 4. nullopt: the file has no other slack.
std::optional<pipeline::Remedy> slack_remedy(const pipeline::FileReader& strain, const pipeline::Job& job,
                                             const FileCables& cables, const ForceShares& own);

/// Returns at most one warning for each of both limits (pipeline/cable/believable.h). own: with the job's own values; a limit
/// that these exceed has no further warning. together: slack_remedy(). Empty if the file has no forces of variations.
std::vector<pipeline::Warning> varied_force_warnings(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                     const FileCables& cables, const ForceShares& own,
                                                     const std::optional<pipeline::Remedy>& together);

}  // namespace dresslife::fatigue
