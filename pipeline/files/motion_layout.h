// Assigns the segments and clamps of a motion file to spans of dresspacks.
//
// The dresspacks follow each other in the file, and so do their spans. A span goes from clamp to clamp: segments [first_segment,
// first_segment + segments) between the clamps base_clamp and tool_clamp. The tool clamp of a span is the base clamp of the next
// span of its dresspack. A file without /clamp/segment has one span, between its first and its last clamp. A file without
// /segment/dresspack has one dresspack.
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

/// Returns the spans in the order of the file. Errors: InputError if /clamp/segment and /segment/dresspack contradict each other.
std::vector<MotionSpan> motion_spans(const FileReader& motion);

/// Returns the dresspack of each segment of a motion or strain file, (segment).
std::vector<std::size_t> dresspack_of_segments(const FileReader& file);

/// Checks that the segments of each dresspack in a motion or strain file have together the length between its clamps in the job,
/// because strains and positions are computed from it. free_lengths: (dresspack) [m]. Errors: InputError, also for another number
/// of dresspacks.
void check_lengths(const FileReader& file, const std::vector<double>& free_lengths);

/// Returns the names of the dresspacks; {""} for a single one.
std::vector<std::string> dresspack_names(const FileReader& file);

}  // namespace dresslife::pipeline
