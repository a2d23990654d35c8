// The folder of a job's results, and how it is removed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dresslife::pipeline {

/// Whether a run of ours made this folder for a job.
bool is_job_folder(const std::filesystem::path& folder);

/// Removes what runs have written there, and the folder when nothing else is in it. Returns the bytes that it freed.
/// Errors: InputError when a file cannot be removed.
std::uintmax_t remove_job(const std::filesystem::path& folder);

}  // namespace dresslife::pipeline
