// From the construction and its slip to the numbers that the kernels run on, for one part at one place along
// the dresspack.
#pragma once

#include <vector>

#include "strain/construction.h"
#include "strain/kernels/kernels.h"
#include "strain/slip.h"

namespace dresslife::strain {

/// The nesting from the dresspack down to `part`, without nodes. arc: of the segment's centre along the
/// dresspack [m]. fibres: of each wire, see surface_fibres().
BundleNesting nesting_to(const Construction& construction, const std::vector<LayerSlip>& plan, int part,
                         double arc, const std::vector<Fibre>& fibres);

/// A place in the part at the end of `nesting`: of part `number` of `layer`, moved by `turn` [rad] around the
/// layer.
WireNode node_at(const Construction& construction, const std::vector<LayerSlip>& plan,
                 const BundleNesting& nesting, int layer, int number, int part, double arc, double turn);

/// Five places evenly around wire layer `layer` of the part at the end of `nesting`, and how it slides: what
/// its waves need. Without the clamp means.
void add_wire_layer(const Construction& construction, const std::vector<LayerSlip>& plan,
                    BundleNesting& nesting, int layer, int part, double arc);

/// count = 0: the wire's axis. Otherwise `count` fibres evenly around the wire, the first the outward one, pi
/// from n.
std::vector<Fibre> surface_fibres(int count);
/// Order of the series of a part in which such fibres lie: 1 when bend1 strains any.
int order_for(const std::vector<Fibre>& fibres);
double fibre_angle(int fibre, int count);  ///< from the inward normal toward the binormal [rad]

}  // namespace dresslife::strain
