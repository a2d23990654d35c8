// Chart of moment over curvature for a job's hose and the cables in it, by the friction law of the strain stage.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Returns an SVG with a panel for the hose (stiffness.h) and one for each component of it with wires (cable_bending.h, W29): the
/// first bend from straight, the loop between minus and plus the largest curvature in the motion (Masing: M = -M1(k0) + 2 M1((k +
/// k0)/2) for rising curvature), and that loop with the friction of 10 and 90 % of dresspacks. Shows the dresspack with the worst
/// wire, else the first. Cables have their own curvature (/cable/curvature), or that of the hose if it is not known. Errors:
/// InputError for a strain file that cannot be read, a job without friction or bend, or a cable with straight parts off its axis.
std::string bending_chart(const std::filesystem::path& strain_file, std::size_t dresspack);

}  // namespace dresslife::pipeline
