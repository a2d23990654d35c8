// What happens in one segment over time: the deformation of the hose, and of every cable in it. A cable that
// keeps its place follows from the hose's deformation and its own strain; one that lies loose has a
// deformation of its own, as if it were a hose itself.
#pragma once

#include <vector>

#include "strain/construction.h"
#include "strain/history.h"
#include "strain/slip.h"

namespace dresslife::strain {

struct SegmentMotion {
  std::size_t samples = 0;
  DeformationColumns hose{};
  std::vector<const double*> strain{};  ///< (cable) of (sample); null: it sticks to the hose in every plan
  std::vector<DeformationColumns> loose{};  ///< (cable) its own deformation, where it can lie loose

  /// What the nesting to a part starts from.
  const DeformationColumns& columns(const Construction& construction, const std::vector<LayerSlip>& plan,
                                    int part) const {
    const int cable = construction.cable_of(part);
    if (cable == no_cable) return hose;
    return plan[construction.parts()[construction.cables()[cable]].layer].loose ? loose[cable] : hose;
  }
};

}  // namespace dresslife::strain
