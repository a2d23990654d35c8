#include "pipeline/report/hose_line.h"

#include "pipeline/files/motion_layout.h"

namespace dresslife::pipeline {

std::vector<Eigen::Vector3d> DresspackLine::in(const std::vector<double>& clamps,
                                               const std::vector<double>& centres) const {
  const auto at = [](const std::vector<double>& of, std::size_t i) {
    return Eigen::Vector3d(of[3 * i], of[3 * i + 1], of[3 * i + 2]);
  };
  std::vector<Eigen::Vector3d> line{at(clamps, base_clamp)};
  for (std::size_t i = 0; i < segments; ++i) line.push_back(at(centres, first_segment + i));
  line.push_back(at(clamps, tool_clamp));
  return line;
}

std::vector<DresspackLine> hose_lines(const FileReader& motion) {
  std::vector<DresspackLine> lines;
  std::size_t dresspack = 0;
  for (const MotionSpan& span : motion_spans(motion)) {
    if (lines.empty() || span.dresspack != dresspack)
      lines.push_back({span.base_clamp, span.first_segment, 0, span.tool_clamp});
    dresspack = span.dresspack;
    lines.back().segments += span.segments;
    lines.back().tool_clamp = span.tool_clamp;
  }
  return lines;
}

}  // namespace dresslife::pipeline
