// Forces of the cables in one variation. dresslife-fatigue compares them with the limits of the forces at the job's own values.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/cable/cable_pulls.h"
#include "strain/evaluation.h"
#include "strain/shortening.h"

namespace dresslife::strain {

/// Cables and spans are counted as in /cable and /cable_span of strain.h5.
struct VariedPulls {
  std::vector<double> tension;        ///< (cable) force of largest size over the motion, with its sign [N]
  std::vector<std::uint32_t> sample;  ///< (cable) its sample in the whole motion
  std::vector<double>
      place;  ///< (cable) its place, from the dresspack's base clamp [m]; -1: it is the same along the cable
  std::vector<double> moment;  ///< (span, 2) largest moment of all cables and of the hose, at the clamps [N m]
  std::vector<std::uint32_t> moment_place;  ///< (span, 2) sample of the cables' moment; cable that pulls most then
  std::vector<double> moment_tension;       ///< (span) force of that cable [N]
};

/// Precondition: the first pass has ended. shortening: of the motion that the evaluations follow, unless they follow all of it.
VariedPulls varied_pulls(const std::vector<std::unique_ptr<Evaluation>>& spans, const Shortening& shortening);

}  // namespace dresslife::strain
