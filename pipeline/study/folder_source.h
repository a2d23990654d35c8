// The file whose results a folder holds. Two files of one name (a/job.yaml and b/job.yaml) share the folder runs/job;
// without this note, the second run would replace the results of the first.
#pragma once

#include <filesystem>

namespace dresslife::pipeline {

/// Errors: InputError when the folder holds results of another file that still exists, unless --force was given. An
/// edited file, a moved one and a folder copied together with its file are accepted.
void check_source(const std::filesystem::path& folder, const std::filesystem::path& file);

/// check_source(), then notes that the folder holds results of this file. Errors: InputError, also when the folder cannot be
/// written.
void claim_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace dresslife::pipeline
