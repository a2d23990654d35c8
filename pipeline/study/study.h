// A study: one base job and its variations. It expands into named, independent jobs.
//
//   base: irb6640_spot_welding          a job of config/jobs, a file, or the job itself
//   vary:                               every combination of these values ...
//     motion: [easy, hard]
//     fatigue.stress: [cyclic, elastic]
//   jobs:                               ... for each of these named changes of the base
//     stiff: {dresspack.bending_stiffness_Nm2: 8}
//   table: fleet.csv                    ... for each row of a table (fleet_table.h) ...
//   sample:                             ... and each sample of keys with known distributions (sampling.h)
//     jobs: 20
//     keys: {routing.free_length_m: !normal {mean: 1.4, deviation: 0.05}}
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/resolve/pieces.h"

namespace dresslife::pipeline {

struct KeyRow;  // pipeline/settings/fields.h

struct Job;

struct StudyJob {
  std::string name;                   ///< unique in the study, fit for a folder
  SharedJob job;                      ///< only of a valid job
  std::string failure;                ///< reasons why the job is invalid, one line per problem; empty: it is valid
  std::vector<std::string> values{};  ///< (varied) values of the varied keys, as in the name
};

/// Files of a finished job that stay on the disk.
enum class Keep {
  all,
  histories,  ///< strain.h5 and life.h5: enough for other materials
  lives,      ///< no result files; the receipts contain the ranking
};
constexpr std::string_view word(Keep value) { return word_at({"all", "histories", "lives"}, value); }

struct Study {
  std::string name;
  std::vector<StudyJob> jobs;  ///< jobs in the order of the file
  Keep keep = Keep::all;
  bool removes_unkept = true;  ///< false: files that `keep` does not name stay until the caller removes them
  /// "jobs", "table", the keys of vary, "sample"; in the order in which they form the jobs' names
  std::vector<std::string> varied{};
};

/// Returns the name of a study, without expanding it. Errors: InputError.
std::string study_name(const std::filesystem::path& file);

/// Reads and expands a study; a single job is a study of one job. sets: `--set` for every job, applied after the
/// study's own changes. Errors: InputError for faults of the study itself. An invalid job has a `failure`.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& sets = {});

/// Returns notes about `--set` of keys that named jobs, rows of the table or parts of varied values have; empty: none. Errors:
/// InputError for a key whose values make names of jobs, because the names would state values that the jobs do not have.
std::string replaced_by_sets(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// Returns the keys of a study file.
std::vector<KeyRow> study_keys();

}  // namespace dresslife::pipeline
