// A picture of the robot and its dresspacks at one moment of a motion file, as inline SVG in the classes of
// report.cpp: parallel projection from the side, nearer parts over farther ones, the worst segment marked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// time: the sample nearest to it [s]; worst_from_tool: segment of the named dresspack to mark, 1 nearest to
/// the tool, 0: none. Errors: InputError when the file is missing or cannot be read.
std::string scene_picture(const std::filesystem::path& motion_file, double time, int worst_from_tool,
                          const std::string& worst_dresspack = "");

/// The sample nearest to a time; of two the earlier one. Precondition: times rise, and there is one.
std::size_t nearest_sample(const std::vector<double>& times, double time);

}  // namespace dresslife::pipeline
