// Determines which results of a study are up to date, and runs the other stages.
//
// A result is up to date if the receipts of its stages (pipeline/files/receipt.h) name the present settings, files
// beside the job and programs, and if each stage's input is the output of the previous stage. File times decide nothing. The
// other stages are a Ninja graph: per job the chain sim -> strain -> fatigue from the first stage that is not up to date. The
// targets of the graph are no files; Ninja only uses the cores and continues after failures. A stage with the same recipe and
// input as before leaves its output unchanged.
//
// A job is done only if its receipts are up to date after the run.
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
  std::string
      shard{};  ///< "2_of_8": this run has a graph of its own beside the other runs in the folder; empty: the whole study

  /// Paths in `folder`: internal files of a run, and its graph.
  std::filesystem::path notes() const { return shard.empty() ? ".stage" : ".stage/shard_" + shard; }
  std::filesystem::path graph() const { return shard.empty() ? "build.ninja" : notes() / "build.ninja"; }
  std::filesystem::path job(const std::string& name) const { return folder / name; }
  std::filesystem::path life(const std::string& name) const { return folder / name / "life.h5"; }
};

/// State of a job in words.
struct StateWords {
  std::string
      state;  ///< "done", "failed", "refused", "damaged", "foreign", "stale" (results of other settings exist), "to do"
  std::string reason{};  ///< empty: none
  /// Returns one line: the state and, in a column of its own, the reason.
  std::string line() const;
};

/// State of a job.
struct JobState {
  std::array<std::string, stage_count> recipes;  ///< recipes that the job's receipts must name
  std::string settings;  ///< digest of the job and the files beside it, twelve digits; independent of the programs
  std::size_t next = 0;  ///< the first stage to run; stage_count: the job is done
  std::array<std::string, stage_count> inputs;  ///< checksums of the inputs of the stages up to `next`
  std::string damaged;                          ///< "life.h5": this file differs from the output that its stage wrote
  bool foreign = false;                         ///< whether `damaged` is the user's own file
  std::string failure;                          ///< reason why the last attempt with these recipes failed
  bool has_results = false;                     ///< whether results of any settings exist
  std::vector<ResultValue> results;             ///< attributes of life.h5, if its receipt contains them
  /// For a job that is not done: whether a complete result of other settings, files or programs exists.
  bool has_last = false;
  std::string changed;  ///< changes since that result, as text (changes.h); empty: not compared
  Keep keep = Keep::all;
  std::vector<std::size_t> compared;  ///< stages whose bytes were compared, because the file times differ
  bool done() const { return next == stage_count; }
  StateWords words() const;
};

/// Returns the state of every job, read from the study's folder; of a job that cannot run only its last result. Writes no
/// file. Errors: InputError when a program is missing.
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places);
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places, Digests& digests);

/// Paths of one stage's files, relative to a job's folder.
struct StageFiles {
  std::filesystem::path output, receipt, log;
};
StageFiles files_of_stage(std::size_t stage);

/// Invalidates results of a job that differ from their receipts, so that the next run makes them again. Errors: DiskError.
void forget_damaged(const std::filesystem::path& folder);

/// Updates `state` from the job's folder. Precondition: its recipes are set.
void look_at(JobState& state, const std::filesystem::path& folder);

/// (stage) index of the job that makes the output, for stages that are not up to date: the job itself, or the first job with
/// the same recipe and input. Every job runs its own last stage.
using Makers = std::array<std::size_t, stage_count>;
std::vector<Makers> makers_of(const Study& study, const std::vector<JobState>& states);

/// Returns whether the output of a stage may be absent in a finished job.
bool may_lack(Keep keep, std::size_t stage);

/// Removes the files of a finished job that the study does not keep. Returns the number of freed bytes.
std::uintmax_t remove_unkept(const JobState& state, const std::filesystem::path& folder);

/// Writes the present file times of compared outputs into the receipts, so that the next run need not compare the bytes again.
void renew_receipts(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states);

/// Writes job.yaml of every job, and build.ninja. launcher: shell words in front of each stage's command; they start the stage
/// on another node and return its exit status ("srun -n1"). A launched stage does not end with this program, and it ignores
/// memory that other stages have reserved. Errors: InputError when the folder cannot be written.
void write_build_graph(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states,
                       const StageLimits& limits = {}, const std::string& launcher = "");

struct BuildEvent {
  int finished = 0, total = 0;
  std::string what;       ///< "sim easy"
  std::size_t stage = 0;  ///< index of "sim"
};

struct BuildResult {
  int executed = 0;   ///< stages that were started
  std::string words;  ///< reason why Ninja ended early; empty: it did not
};

/// Runs Ninja on the graph. Ninja and the stages end when this program ends.
/// on_event: called after every finished stage. Errors: InputError when Ninja is not installed.
BuildResult run_build_graph(const StudyPlaces& places, int parallel,
                            const std::function<void(const BuildEvent&)>& on_event);

/// Updates `states` after a run. The reason why a job is still not done is written to its `failure` and to its folder; its
/// logs are joined into `log`. before: digests of the files and programs at the start of the run.
void close_run(const Study& study, const StudyPlaces& places, const BuildResult& result, std::vector<JobState>& states,
               const Digests& before);

}  // namespace dresslife::pipeline
