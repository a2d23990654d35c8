// ways.h5: what the lines of a job's robot program could do instead, for `dresslife reprogram`, which runs them.
#pragma once

#include <filesystem>

#include "pipeline/files/files.h"
#include "sim/reprogram/program_ways.h"

namespace dresslife::sim {

/// Writes all of ways_format() but the stamp. life_file: of the job, with the damage of each line. most_lines: of those
/// that cost most. Errors: InputError for a job whose motion is no robot program; those of reading the program and the
/// file.
void write_ways(const pipeline::Job& job, const std::filesystem::path& life_file, std::size_t most_lines,
                pipeline::FileWriter& file);

}  // namespace dresslife::sim
