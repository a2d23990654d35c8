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

/// Returns text: sums over the dresspack, its layers with widths, lays and hands, then wires, metal and stiffnesses. Each line
/// ends with a line feed.
std::string construction_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
