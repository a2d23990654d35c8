// A job for ParaView: an XDMF file that names the datasets where they lie, in the HDF5 files beside it,
// moment by moment. Nothing is copied but the links' shapes, which no file holds in the world.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/report/figures.h"

namespace dresslife::pipeline {

/// The text of the XDMF file `output`; names of the HDF5 files in it are relative to its folder. One grid a
/// moment: the dresspacks as lines through their segments' centres with radius, tension and contact force,
/// with curvature, twist and elongation where a strain file lies there, with damage per repeat where a life
/// file does; the robot's links as the axes of their capsules, and their boxes, with radius and the link's
/// number. Units as in the files. For ParaView's `XDMF Reader`: its Xdmf3 readers leave out parts of
/// datasets. Errors: InputError when the motion file cannot be read, or another is of another motion.
std::string xdmf_text(const JobFiles& files, const std::filesystem::path& output);

}  // namespace dresslife::pipeline
