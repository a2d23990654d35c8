// Damage of every wire of every segment, for the coloured cross-section of a job's page.
#pragma once

#include <optional>

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// Returns JSON: dresspacks as layers of parts [m, rad], and segments. A segment has the damage of each wire in the order of
/// wire_paths() as one of 15 steps of its logarithm, from 10^-4 of the largest damage (0: less), two wires per byte, and its five
/// worst wires with their exact damage. The most damaged segments are included until a third of a megabyte is full.
/// std::nullopt if the wires of the file are not those of the setup. Errors: InputError when the file cannot be read.
std::optional<Json> section_data(const FileReader& life, const Setup& setup);

}  // namespace dresslife::pipeline
