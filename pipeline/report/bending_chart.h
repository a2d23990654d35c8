// Moment over curvature of a job's hose and of the cables in it, by the law of friction of the strain stage.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// An SVG. A panel for the hose (stiffness.h) and one for each component of it with wires (cable_bending.h, W29): the first bend
/// from straight, the loop between minus and plus the largest curvature in the motion (Masing: M = -M1(k0) + 2 M1((k + k0)/2) on the way
/// up), and that loop with the friction of 10 and 90 % of dresspacks. Of the dresspack with the worst wire, else the first.
/// Cables bend as they lie (/cable/curvature), or where that is not known as the hose. Errors: InputError for a strain file
/// that cannot be read, without friction in the job, without a bend, and for a cable with straight parts beside its axis.
std::string bending_chart(const std::filesystem::path& strain_file, std::size_t dresspack);

}  // namespace dresslife::pipeline
