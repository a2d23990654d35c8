// The folder of a job's results, and how it is removed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dresslife::pipeline {

/// Whether a run made this folder for a job.
bool is_job_folder(const std::filesystem::path& folder);

/// Removes files of runs, and the folder if it is then empty. Returns the freed bytes.
/// Errors: InputError when a file cannot be removed.
std::uintmax_t remove_job(const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
