// The file whose results a folder holds. Two files with the same name (a/job.yaml and b/job.yaml) use the same folder runs/job;
// without this note, the second run would replace the results of the first.
#pragma once

#include <filesystem>

namespace dresslife::pipeline {

/// Checks that the folder holds no results of another file. An edited file, a moved file and a folder copied together with its
/// file are accepted. Errors: InputError when the other file still exists, unless --force was given.
void check_source(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Calls check_source(), then notes that the folder holds results of this file. Errors: InputError, also when the folder cannot
/// be written.
void claim_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace dresslife::pipeline
