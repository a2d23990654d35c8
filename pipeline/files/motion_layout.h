// Which segments and clamps of a motion file make which span of which dresspack.
//
// Dresspacks follow each other in the file, and so do their spans, each from clamp to clamp: segments
// [first_segment, first_segment + segments) between the clamps base_clamp and tool_clamp. The tool clamp of a
// span is the base clamp of the next of the same dresspack. A file without /clamp/segment has one span, whose
// clamps are the first and the last; one without /segment/dresspack has one dresspack.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

struct MotionSpan {
  std::size_t dresspack = 0;
  std::size_t first_segment = 0, segments = 0;
  std::size_t base_clamp = 0, tool_clamp = 1;
};

/// In the order of the file. Errors: InputError when /clamp/segment and /segment/dresspack contradict each
/// other.
std::vector<MotionSpan> motion_spans(const FileReader& motion);

/// (segment) of a motion or strain file: the dresspack that it belongs to.
std::vector<std::size_t> dresspack_of_segments(const FileReader& file);

/// The segments of each dresspack of a motion or strain file are as long together as what lies between its
/// clamps, as its job says: strains and places follow from them. free_lengths: (dresspack) [m]. Errors:
/// InputError, also where the job has another number of dresspacks.
void check_lengths(const FileReader& file, const std::vector<double>& free_lengths);

/// Names of the dresspacks where there are several, to tell them apart; {""}: one.
std::vector<std::string> dresspack_names(const FileReader& file);

}  // namespace dresslife::pipeline
