// A strain file like those of dresslife-strain, without wires, for tests of what reads bends and twists.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// Two samples of three segments that bend by `most` 1/m at most; without wires. of_cables: largest curvature of the cables; 0: as of an
/// older file.
inline void write_sample_strain(const std::filesystem::path& name, const std::string& job, double most,
                                double of_cables) {
  FileWriter file(name, strain_format());
  file.set_axis("level", 1), file.set_axis("segment", 3), file.set_axis("sample", 2);
  file.append("/time", std::vector<double>{0, 1});
  file.append("/program/step", std::vector<std::int32_t>{0, 0});
  file.append("/program/text", std::vector<std::string>{"home"});
  for (const char* of_segment : {"/segment/length", "/segment/wires_at"})
    file.append(of_segment, std::vector<double>(3, 0.2));
  file.append("/deformation/curvature",
              std::vector<float>{0.1f, 0, 0, 0.2f, 0.1f, 0, 0, 0.1f, float(-0.6 * most), float(0.8 * most), 0, 0});
  file.append("/deformation/twist", std::vector<float>{0, 0.5f, 0, -2, 1, 0});
  file.append("/deformation/elongation", std::vector<float>(6));
  for (const std::string set : {"", "/bound_stick", "/bound_free"}) {
    file.append(set + "/site/segment", std::vector<std::int32_t>{});
    for (const char* text : {"/site/component", "/site/material"}) file.append(set + text, std::vector<std::string>{});
    for (const char* number : {"/site/helix", "/reversal/strain"}) file.append(set + number, std::vector<float>{});
    file.append(set + "/site/fibre", std::vector<double>{});
    file.append(set + "/reversal/offset", std::vector<std::uint64_t>{0});
    file.append(set + "/reversal/sample", std::vector<std::uint32_t>{});
  }
  file.append("/probe/site", std::vector<std::uint32_t>{});
  file.append("/probe/strain", std::vector<float>{});
  if (of_cables > 0) {
    file.append("/cable/curvature", std::vector<double>{of_cables / 2, of_cables, 9, 9});
    file.append("/cable/dresspack", std::vector<std::int32_t>{0, 0, 1, 0});
    file.append("/cable/component", std::vector<std::int32_t>{0, 0, 0, 1});
  }
  file.attribute("job", job);
  for (const char* attribute : {"history", "input_sha256"}) file.attribute(attribute, "");
  file.commit();
}

}  // namespace dresslife::pipeline
