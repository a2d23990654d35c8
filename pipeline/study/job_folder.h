// The folder of a job's results, and its removal.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dresslife::pipeline {

/// Returns whether a run made this folder for a job.
bool is_job_folder(const std::filesystem::path& folder);

/// Removes the files that runs wrote, and the folder if it is then empty. Returns the number of freed bytes. Errors: InputError
/// when a file cannot be removed.
std::uintmax_t remove_job(const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
