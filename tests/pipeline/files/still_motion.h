// A motion.h5 without samples, for tests of the other data in the file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Writes the file. more: called as more(file) to write further data.
template <class More>
void write_still_motion(const std::filesystem::path& name, std::size_t segments, std::size_t clamps, const More& more) {
  FileWriter file(name, motion_format());
  file.set_axis("segment", segments);
  file.set_axis("clamp", clamps);
  for (const char* dataset : {"/time", "/segment/position", "/segment/orientation", "/clamp/position",
                              "/clamp/orientation", "/contact/max_depth", "/energy", "/tension"})
    file.append(dataset, std::span<const double>());
  for (const char* dataset : {"/program/step", "/contact/count"}) file.append(dataset, std::span<const std::int32_t>());
  file.append("/program/text", std::vector<std::string>{"home"});
  file.append("/segment/length", std::vector<double>(segments, 0.1));
  more(file);
  for (const char* attribute : {"job", "history", "input_sha256"}) file.attribute(attribute, "");
  file.commit();
}

}  // namespace dresslife::pipeline
