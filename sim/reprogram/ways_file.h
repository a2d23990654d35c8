// ways.h5: alternatives for the lines of a job's robot program, which `dresslife reprogram` runs.
#pragma once

#include <filesystem>

#include "pipeline/files/files.h"
#include "sim/reprogram/program_ways.h"

namespace dresslife::sim {

/// Writes all of ways_format() except the stamp. life_file: life file of the job, with the damage of each line. most_lines:
/// number of lines, most damaging first. Errors: InputError for a job whose motion is no robot program; errors of reading the
/// program and the file.
void write_ways(const pipeline::Job& job, const std::filesystem::path& life_file, std::size_t most_lines,
                pipeline::FileWriter& file);

}  // namespace dresslife::sim
