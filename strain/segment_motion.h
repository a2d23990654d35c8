// The deformation of the hose and of every cable in one segment over time. The state of a held cable follows from the hose's
// deformation and the cable's own strain. A loose cable has its own deformation, like a hose.
#pragma once

#include <vector>

#include "strain/construction.h"
#include "strain/history.h"
#include "strain/slip.h"

namespace dresslife::strain {

struct SegmentMotion {
  std::size_t samples = 0;
  DeformationColumns hose{};
  std::vector<const double*> strain{};      ///< (cable) pointer to (sample); null: it sticks to the hose in every plan
  std::vector<DeformationColumns> loose{};  ///< (cable) its own deformation, if it can lie loose

  /// Returns the deformation from which the nesting to a part starts.
  const DeformationColumns& columns(const Construction& construction, const std::vector<LayerSlip>& plan,
                                    int part) const {
    const int cable = construction.cable_of(part);
    if (cable == no_cable) return hose;
    return plan[construction.parts()[construction.cables()[cable]].layer].loose ? loose[cable] : hose;
  }
};

}  // namespace dresslife::strain
