// Reads and writes a whole job, and the parts of it that determine results. Code that only passes jobs on needs only this header,
// and is not compiled again after a change of a key.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct KeyRow;  // pipeline/settings/fields.h

struct Dresspack;
struct Job;
struct Setup;

/// Reads a job: looks up its catalogue entries, applies `--set key.path=value` in their order, and checks everything that can be
/// checked without a run. Errors: InputError.
Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets = {});
/// document: receives the job with its names resolved, for the places of keys.
Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets, Node& document);

/// Reads a job from a tree: that of a study, or of the `job` attribute of a file.
Job job_from(Node document, const std::vector<std::string>& sets = {});
Setup setup_from(Node document);

/// Returns the resolved job as YAML, with catalogue entries and defaults. It reads back to the same job.
std::string job_text(const Job& job);
std::string job_text(const std::filesystem::path& file, const std::vector<std::string>& sets);
/// Returns the resolved job for a file in this folder. Names of other files are relative to the folder, so that both can be moved
/// together.
std::string stored_job_text(const Job& job, const std::filesystem::path& folder);

/// part_text returns the keys of the job that determine a stage's result. Equal text and equal bytes of the files beside the job
/// give equal results. The text contains names of files without folders.
enum class JobPart { sim, strain, fatigue };
std::string part_text(const Job& job, JobPart part);
/// Returns the same text by its top-level keys, without these groups.
std::vector<std::pair<std::string, std::string>> part_sections(const Job& job, JobPart part,
                                                               const std::set<std::string, std::less<>>& omitted = {});

/// Returns a digest of motion, robot, routings and names of the dresspacks, with the content of the program. It does not depend on
/// folders, settings of the calculation and uncertain parameters. Errors: InputError for a file that cannot be read.
std::string motion_digest(const Job& job);

/// Returns the files, in addition to the job and the catalogue, on which the result of dresslife-sim depends.
std::vector<std::filesystem::path> files_beside(const Job& job);

/// Reads a dresspack's file with its materials, and checks it as in a job in which all parts can slide. Errors: InputError.
Dresspack read_dresspack(const std::filesystem::path& file);
/// Reads a dresspack for a picture that marks errors: problems of parts that do not fit are not thrown but written to `faults`,
/// one line each. Then values from the construction stay 0.
Dresspack read_dresspack(const std::filesystem::path& file, std::string& faults);

/// Returns every key of a job.
std::vector<KeyRow> job_keys();

}  // namespace dresslife::pipeline
