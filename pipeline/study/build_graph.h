// What of a study is up to date, and how the rest is made.
//
// A result is up to date when the receipts of its stages say that they were made from what the study says now
// (pipeline/files/receipt.h): same settings, same files beside the job, same programs, each from the file
// that the stage before made. Times decide nothing. What is left is a Ninja graph: per job the chain sim ->
// strain -> fatigue from the first stage that is not up to date. Its targets are no files; Ninja only keeps
// the cores busy and carries on past failures. A stage whose recipe and input turn out as before leaves its
// output alone.
//
// Whatever becomes of Ninja and the stages, a job is done only when its receipts say so afterwards.
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
  std::filesystem::path programs;  ///< where dresslife-sim, -strain and -fatigue are
  std::string shard{};  ///< "2_of_8": a graph beside those of other runs in this folder; empty: the whole

  /// Within the folder: what of a run is not for people, and its graph.
  std::filesystem::path notes() const { return shard.empty() ? ".stage" : ".stage/shard_" + shard; }
  std::filesystem::path graph() const { return shard.empty() ? "build.ninja" : notes() / "build.ninja"; }
  std::filesystem::path job(const std::string& name) const { return folder / name; }
  std::filesystem::path life(const std::string& name) const { return folder / name / "life.h5"; }
};

/// How a job stands.
struct JobState {
  std::array<std::string, stage_count> recipes;  ///< that its receipts must name
  std::string settings;  ///< digest of the job and the files beside it, twelve digits; programs do not matter
  std::size_t next = 0;  ///< the first stage to run; stage_count: the job is done
  std::array<std::string, stage_count> inputs;  ///< checksums of what the stages up to the next read
  std::string damaged;                          ///< "life.h5": is not what its stage wrote
  bool foreign = false;                         ///< whether `damaged` is a file that no program of ours wrote
  std::string failure;                          ///< why the last attempt with these recipes failed
  bool has_results = false;                     ///< of any settings
  std::vector<Told> told;                       ///< what its life.h5 says, where its receipt tells
  /// Of a job that is not done: whether there is a result of other settings, files or programs, whole as it
  /// was made.
  bool has_last = false;
  std::string changed;  ///< since that result, in words (changes.h); empty: not looked at
  Keep keep = Keep::all;
  std::vector<std::size_t> compared;  ///< stages whose bytes had to be compared, as no times vouch for them
  bool done() const { return next == stage_count; }
  /// "done", "failed   WHY", "damaged  life.h5 ...", "foreign  life.h5 ...", "stale" with results of other settings and what changed,
  /// "to do" without any.
  std::string words() const;
};

/// The state of every job that can run (of others only their last results), from what lies in the folder;
/// nothing is written. Errors: InputError when a program is missing.
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places);
std::vector<JobState> states_of(const Study& study, const StudyPlaces& places, Digests& digests);

/// In a job's folder.
struct StageFiles {
  std::filesystem::path output, receipt, log;
};
StageFiles files_of_stage(std::size_t stage);

/// Forgets results of a job that are not what their receipts say: the next run makes them again. Errors: DiskError.
void forget_damaged(const std::filesystem::path& folder);

/// Brings a state up to date whose recipes are known.
void look_at(JobState& state, const std::filesystem::path& folder);

/// Which job of the study makes the output of each stage that is not up to date: itself, or the first of
/// those that make the same from the same. The last stage is each job's own.
using Makers = std::array<std::size_t, stage_count>;
std::vector<Makers> makers_of(const Study& study, const std::vector<JobState>& states);

/// Whether an output may be absent of a job that is done.
bool may_lack(Keep keep, std::size_t stage);

/// Removes what the study does not keep of a job that is done. Returns the bytes that it took.
std::uintmax_t remove_unkept(const JobState& state, const std::filesystem::path& folder);

/// Before anything is computed. Errors: InputError where a run would replace a file that is not ours.
void check_places(const Study& study, const StudyPlaces& places);

/// Notes of outputs whose bytes had to be compared that they need no look the next time.
void renew_receipts(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states);

/// Writes every job's job.yaml and build.ninja. launcher: shell words before each stage's command, that start
/// it elsewhere and end with its exit status ("srun -n1"); a stage that is launched does not end with this
/// program and minds no memory that others were promised. Errors: InputError when the folder cannot be
/// written.
void write_build_graph(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states,
                       const StageLimits& limits = {}, const std::string& launcher = "");

struct BuildEvent {
  int finished = 0, total = 0;
  std::string what;  ///< "sim easy"
};

struct BuildResult {
  int executed = 0;   ///< stages that were started
  std::string words;  ///< why Ninja ended before it was through; empty: it was
};

/// Runs Ninja on the graph. It and the stages end with this program, however that ends.
/// on_event: called for every finished stage. Errors: InputError when Ninja is not installed.
BuildResult run_build_graph(const StudyPlaces& places, int parallel,
                            const std::function<void(const BuildEvent&)>& on_event);

/// Brings `states` up to date after a run. A job that is still not done keeps the reason in its `failure`,
/// here and in its folder; its logs are joined into `log`.
void close_run(const Study& study, const StudyPlaces& places, const BuildResult& result,
               std::vector<JobState>& states);

}  // namespace dresslife::pipeline
