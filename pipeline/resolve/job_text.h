// A job as a whole: read, written, and the parts of it on which results depend. Whoever only passes jobs on
// needs no more than this, and is not compiled again for a key.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct KeyRow;  // pipeline/settings/fields.h

struct Dresspack;
struct Job;
struct Setup;

/// Reads a job, looks up the catalogue entries that it names, applies `--set key.path=value` in their order,
/// checks everything that can be checked without running. Errors: InputError.
Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets = {});

/// The same for a job that is a tree already: a study's, or the `job` attribute of a file.
Job job_from(Node document, const std::vector<std::string>& sets = {});
Setup setup_from(Node document);

/// The resolved job as YAML: catalogue entries written out, defaults filled in. Reads back to the same job.
std::string job_text(const Job& job);
std::string job_text(const std::filesystem::path& file, const std::vector<std::string>& sets);
/// The same for a file in this folder: it names other files as seen from there, so that both may be moved together.
std::string stored_job_text(const Job& job, const std::filesystem::path& folder);

/// The keys of the job on which each stage's result depends; equal text and equal bytes of the files beside it, equal result.
/// The text names files without their folders.
enum class JobPart { sim, strain, fatigue };
std::string part_text(const Job& job, JobPart part);

/// Files beyond the job and the catalogue on which the result of dresslife-sim depends.
std::vector<std::filesystem::path> files_beside(const Job& job);

/// A dresspack's file by itself, with its materials, checked as in a job whose parts may all slide. Errors:
/// InputError.
Dresspack read_dresspack(const std::filesystem::path& file);
/// The same for a picture that marks what does not fit: problems of parts that do not are not thrown but go to `faults`, a
/// line each; then what is taken from the construction stays 0.
Dresspack read_dresspack(const std::filesystem::path& file, std::string& faults);

/// Every key of a job.
std::vector<KeyRow> job_keys();

}  // namespace dresslife::pipeline
