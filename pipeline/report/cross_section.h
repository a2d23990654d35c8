// A dresspack's cross-section at its base clamp: as a picture to scale, and as a list of its layers with sums.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// A whole SVG file: hose, cables, cores, every wire; parts that overlap their neighbours in the colour of a
/// warning; a scale, and a line for each layer. Follows the reader's light or dark scheme.
/// layers: whether it contains the lines; a page has them as text.
enum class LayerLines { drawn, left_out };
std::string cross_section_picture(const Dresspack& dresspack, LayerLines layers = LayerLines::drawn);

/// Paths of all wires, layer after layer and part after part, as the layers are listed.
std::vector<std::string> wire_paths(const Dresspack& dresspack);

/// Bending stiffness of all wires [N m2], (levels + 1): first when each bends about its own axis, then when
/// the parts that hold wires are solid, then those that hold them, last when nothing slides:
///     E A(part) = sum over its layers of K E A(inner) cos^3(alpha),
///     E I(part) = sum over its layers of K (E I(inner) + E A(inner) cos^3(alpha) R^2 / 2),
/// the last term for solid parts. Without wires empty. Wires of unknown material count as
/// zero.
std::vector<double> bending_stiffnesses(const Dresspack& dresspack);

/// Sums over the dresspack, its layers with widths, lays and hands, then wires, metal and stiffnesses. Lines end with a
/// line feed.
std::string construction_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
