// Cross-section of a dresspack at its base clamp: a picture to scale, and a list of its layers with sums.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns a whole SVG file: hose, cables, cores, every wire; parts that overlap their neighbours in a warning colour; a scale,
/// and a line of text for each layer. Follows the reader's light or dark scheme. layers: whether the picture contains these
/// lines; a page prints them as text.
enum class LayerLines { drawn, left_out };
std::string cross_section_picture(const Dresspack& dresspack, LayerLines layers = LayerLines::drawn);

/// Returns the paths of all wires, in the order of the layers and of the parts in a layer.
std::vector<std::string> wire_paths(const Dresspack& dresspack);

/// Returns the bending stiffness of all wires [N m2], (levels + 1). Entry 0: each wire bends about its own axis. Next entries:
/// the parts that contain wires are solid, then the parts that contain these parts, and so on. Last entry: no part slides.
///     E A(part) = sum over its layers of K E A(inner) cos^3(alpha),
///     E I(part) = sum over its layers of K (E I(inner) + E A(inner) cos^3(alpha) R^2 / 2),
/// with the last term for solid parts only. Empty without wires. Wires of unknown material have stiffness 0.
std::vector<double> bending_stiffnesses(const Dresspack& dresspack);

/// Returns text: sums over the dresspack, its layers with widths, lays and hands, then wires, metal and stiffnesses. Each line
/// ends with a line feed.
std::string construction_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
