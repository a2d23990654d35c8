// A picture of the robot and its dresspacks at one moment of a motion file, as inline SVG in the classes of
// report.cpp: parallel projection from the side, nearer parts in front of farther ones, one segment marked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Returns the picture. time: the nearest sample is shown [s]; from_tool: segment of the named dresspack to mark, 1 is
/// nearest to the tool, 0: none. Errors: InputError when the file is missing or cannot be read.
std::string scene_picture(const std::filesystem::path& motion_file, double time, int from_tool,
                          const std::string& marked_dresspack = "");

/// Returns the sample nearest to a time; of two the earlier one. Preconditions: times rise, and at least one sample exists.
std::size_t nearest_sample(const std::vector<double>& times, double time);

}  // namespace dresslife::pipeline
