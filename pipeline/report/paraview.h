// A job for ParaView: an XDMF file that refers to the datasets of the HDF5 files beside it, one grid per sample. Only
// the shapes of the links in world coordinates are copied, because no file contains them.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/report/figures.h"

namespace dresslife::pipeline {

/// Returns the text of the XDMF file `output`; HDF5 files are named relative to its folder. One grid per sample contains the
/// dresspacks as lines through their segments' centres with radius, tension and contact force; with a strain file
/// curvature, twist and elongation; with a life file damage per repeat; the robot's links as the axes of their
/// capsules and as boxes, with radius and number of the link. Units as in the files. Made for ParaView's `XDMF Reader`:
/// its Xdmf3 readers cannot read parts of datasets. Errors: InputError when the motion file cannot be read, or as in
/// check_of_one_job().
std::string xdmf_text(const JobFiles& files, const std::filesystem::path& output);

}  // namespace dresslife::pipeline
