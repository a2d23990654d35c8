// Damage of every wire of every segment, for the coloured cross-section of a job's page.
#pragma once

#include <optional>

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// JSON: dresspacks as layers of parts [m, rad], segments with the damage of each wire in the order of
/// wire_paths() as one of 15 steps by its logarithm, 10^-4 of the largest and more (0: less), two to a byte,
/// and their five worst wires with damages as the file has them. As many of the
/// most damaged segments as fit into a third of a megabyte. Empty if the file's wires are not those of the setup.
/// Errors: InputError when the file cannot be read.
std::optional<Json> section_data(const FileReader& life, const Setup& setup);

}  // namespace dresslife::pipeline
