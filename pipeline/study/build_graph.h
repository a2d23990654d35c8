// Which results of a study are up to date, and the run of the rest.
//
// A result is up to date if the receipts of its stages (pipeline/files/receipt.h) name the present settings, files
// beside the job and programs, and each stage's input is the output of the stage before. Times decide nothing. The
// rest is a Ninja graph: per job the chain sim -> strain -> fatigue from the first stage that is not up to date. Its
// targets are no files; Ninja only uses the cores and continues after failures. A stage with the same recipe and
// input as before leaves its output unchanged.
//
// A job is done only if its receipts say so after the run.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/base/limits.h"
#include "pipeline/files/receipt.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

inline constexpr std::size_t stage_count = 3;

struct StudyPlaces {
  std::filesystem::path folder;    ///< DIR/<study>
  std::filesystem::path programs;  ///< folder of dresslife-sim, -strain and -fatigue
  std::string shard{};  ///< "2_of_8": a graph beside those of other runs in this folder; empty: the whole

  /// In the folder: internal files of a run, and its graph.
  std::filesystem::path notes() const { return shard.empty() ? ".stage" : ".stage/shard_" + shard; }
  std::filesystem::path graph() const { return shard.empty() ? "build.ninja" : notes() / "build.ninja"; }
  std::filesystem::path job(const std::string& name) const { return folder / name; }
  std::filesystem::path life(const std::string& name) const { return folder / name / "life.h5"; }
};

/// State of a job.
struct JobState {
  std::array<std::string, stage_count> recipes;  ///< that its receipts must name
  std::string settings;  ///< digest of the job and the files beside it, twelve digits; programs do not matter
  std::size_t next = 0;  ///< the first stage to run; stage_count: the job is done
  std::array<std::string, stage_count> inputs;  ///< checksums of the inputs of the stages up to the next
  std::string damaged;                          ///< "life.h5": is not what its stage wrote
  bool foreign = false;                         ///< whether `damaged` is a file of the user
  std::string failure;                          ///< why the last attempt with these recipes failed
  bool has_results = false;                     ///< of any settings
  std::vector<ResultValue> results;                ///< attributes of its life.h5, if its receipt has them
  /// Of a job that is not done: whether there is a complete result of other settings, files or programs.
  bool has_last = false;
  std::string changed;  ///< changes since that result, as text (changes.h); empty: not compared
  Keep keep = Keep::all;
  std::vector<std::size_t> compared;  ///< stages whose bytes were compared, because the file times differ
  bool done() const { return next == stage_count; }
  /// "done", "failed   WHY", "damaged  life.h5 ...", "foreign  life.h5 ...", "stale" with results of other settings
  /// and what changed, "to do" without any.
  std::string words() const;
};

/// The state of every job that can run (of others only their last results), from the folder. Writes nothing. Errors:
/// InputError when a program is missing.
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places);
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places, Digests& digests);

/// In a job's folder.
struct StageFiles {
  std::filesystem::path output, receipt, log;
};
StageFiles files_of_stage(std::size_t stage);

/// Invalidates results of a job that differ from their receipts: the next run makes them again. Errors: DiskError.
void forget_damaged(const std::filesystem::path& folder);

/// Updates a state with known recipes.
void look_at(JobState& state, const std::filesystem::path& folder);

/// The job that makes the output of each stage that is not up to date: itself, or the first job with the same recipe
/// and input. Every job runs its own last stage.
using Makers = std::array<std::size_t, stage_count>;
std::vector<Makers> makers_of(const Study& study, const std::vector<JobState>& states);

/// Whether an output of a finished job may be absent.
bool may_lack(Keep keep, std::size_t stage);

/// Removes the files of a finished job that the study does not keep. Returns their bytes.
std::uintmax_t remove_unkept(const JobState& state, const std::filesystem::path& folder);

/// Notes the file times of outputs whose bytes were compared, so that the next run need not compare them.
void renew_receipts(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states);

/// Writes every job's job.yaml and build.ninja. launcher: shell words before each stage's command that start it
/// elsewhere and return its exit status ("srun -n1"). A launched stage does not end with this program and ignores
/// memory that other stages have reserved. Errors: InputError when the folder cannot be written.
void write_build_graph(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states,
                       const StageLimits& limits = {}, const std::string& launcher = "");

struct BuildEvent {
  int finished = 0, total = 0;
  std::string what;  ///< "sim easy"
};

struct BuildResult {
  int executed = 0;   ///< stages that were started
  std::string words;  ///< why Ninja ended early; empty: it did not
};

/// Runs Ninja on the graph. Ninja and the stages end with this program.
/// on_event: called for every finished stage. Errors: InputError when Ninja is not installed.
BuildResult run_build_graph(const StudyPlaces& places, int parallel,
                            const std::function<void(const BuildEvent&)>& on_event);

/// Updates `states` after a run. A job that is still not done keeps the reason in its `failure`,
/// here and in its folder; its logs are joined into `log`. before: digests of the files and programs when the run began.
void close_run(const Study& study, const StudyPlaces& places, const BuildResult& result,
               std::vector<JobState>& states, const Digests& before);

}  // namespace dresslife::pipeline
