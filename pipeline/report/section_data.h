// What a job's page holds of damage across its dresspacks: of every segment every wire, for a cross-section
// that is coloured.
#pragma once

#include <optional>

#include "pipeline/files/files.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// JSON: dresspacks as layers of parts [m, rad], segments with the damage of each wire in the order of
/// wire_paths() as one of 15 steps by its logarithm, 10^-4 of the largest and more (0: less), two to a byte,
/// and their five worst wires with damages as the file has them. The segments that are damaged most, as many
/// as fit in a third of a megabyte. Nothing where the file's wires are not those of the setup. Errors:
/// InputError when the file cannot be read.
std::optional<Json> section_data(const FileReader& life, const Setup& setup);

}  // namespace dresslife::pipeline
