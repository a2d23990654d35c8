// A dresspack's cross-section at its base clamp: as a picture to scale, and as a list of its layers with what
// they add up to.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// A whole SVG file: hose, cables, cores, every wire; parts that overlap their neighbours in the colour of a
/// warning; a scale, and a line for each layer. Follows the reader's light or dark scheme.
/// marked: path of a part as strain.h5 and life.h5 name it ("signal cable 3/conductor 2/layer 1/wire 17"), which gets a
/// ring around it; what names no part marks nothing.
/// layers: whether the lines are there; a page has them as text, which is never too small to be read.
enum class LayerLines { drawn, left_out };
std::string cross_section_picture(const Dresspack& dresspack, const std::string& marked = "",
                                  LayerLines layers = LayerLines::drawn);

/// Middle of such a part at the base clamp, from the dresspack's axis [m], and its radius [m].
struct PartPlace {
  double x = 0, y = 0, radius = 0;
};
std::optional<PartPlace> place_of_part(const Dresspack& dresspack, std::string_view path);

/// Paths of all wires, layer after layer and part after part, as the layers are listed.
std::vector<std::string> wire_paths(const Dresspack& dresspack);

/// Bending stiffness of all wires [N m2], (levels + 1): first when each bends about its own axis, then when
/// the parts that hold wires are solid, then those that hold them, last when nothing slides:
///     E A(part) = sum over its layers of K E A(inner) cos^3(alpha),
///     E I(part) = sum over its layers of K (E I(inner) + E A(inner) cos^3(alpha) R^2 / 2),
/// the last term for solid parts. Without wires empty. Wires of a material that is not known count as
/// nothing.
std::vector<double> bending_stiffnesses(const Dresspack& dresspack);

/// The layers with widths, lays and hands; lines end with a line feed.
std::string layers_text(const Dresspack& dresspack);

/// The same below what the dresspack has in all, then wires, metal and stiffnesses.
std::string construction_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
