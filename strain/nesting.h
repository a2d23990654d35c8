// Input of the kernels for one part at one place along the dresspack, from the construction and its slip.
#pragma once

#include <vector>

#include "strain/construction.h"
#include "strain/kernels/kernels.h"
#include "strain/slip.h"

namespace dresslife::strain {

/// Returns the nesting from the dresspack to `part`, without nodes. arc: of the segment's centre along the dresspack [m].
/// fibres: of each wire, see surface_fibres().
BundleNesting nesting_to(const Construction& construction, const std::vector<LayerSlip>& plan, int part, double arc,
                         const std::vector<Fibre>& fibres);

/// Returns the node of part `number` of `layer` in the part at the end of `nesting`, moved by `turn` [rad] around the layer.
WireNode node_at(const Construction& construction, const std::vector<LayerSlip>& plan, const BundleNesting& nesting,
                 int layer, int number, int part, double arc, double turn);

/// Adds the input of the waves of wire layer `layer` in the part at the end of `nesting`: five nodes evenly around the layer,
/// and how it slides. Clamp means are not set.
void add_wire_layer(const Construction& construction, const std::vector<LayerSlip>& plan, BundleNesting& nesting,
                    int layer, int part, double arc);

/// Returns `count` fibres evenly around the wire; the first is the outward one, pi from n. count = 0: the wire's axis.
std::vector<Fibre> surface_fibres(int count);
/// Returns the order of the series of a part that contains these fibres: 1 if bend1 strains any of them.
int order_for(const std::vector<Fibre>& fibres);
double fibre_angle(int fibre, int count);  ///< from the inward normal toward the binormal [rad]

}  // namespace dresslife::strain
