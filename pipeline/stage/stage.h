// What every stage's program shares: the command line, exit statuses, where its settings come from and the
// stamp on its output. A stage's main is a StageInfo and one call of run_stage().
//
// Exit status: 0 done, 1 the input is wrong, 2 the command line is wrong, 3 our fault.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/limits.h"
#include "pipeline/base/progress.h"
#include "pipeline/base/warnings.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/files.h"
#include "pipeline/files/receipt.h"
#include "pipeline/stage/command_line.h"

namespace dresslife::pipeline {

struct Job;
enum class JobPart;

struct StageInfo {
  std::string program;           ///< "dresslife-sim"
  std::string purpose;           ///< one sentence for --help
  std::string input;             ///< what the positional argument is: "JOB.yaml", "motion.h5"
  std::string output;            ///< what -o names: "motion.h5"
  std::string example;           ///< a command that can be typed
  bool input_is_job = false;     ///< the input is the job itself; other stages take --job
  bool may_lack_output = false;  ///< without -o nothing is written
  std::vector<Option> options = {};      ///< of this stage only
  std::optional<JobPart> part =
      {};  ///< of the job, on which the result depends; nothing: no stage of a study
  /// What the receipt of its output tells, for who does not keep or open that; empty: nothing.
  std::function<std::vector<ResultValue>(const std::filesystem::path& output)> results = {};
};

/// A file that is read, as it was when the stage began.
struct StageInput {
  std::filesystem::path file;
  FileState state;
  std::optional<std::string> checksum;
  bool young = false;  ///< changed so lately that its state could hide a change
};

struct StageCall {
  StageInfo info;
  StageLimits limits{};
  bool of_a_study = false;  ///< what is said goes into a log
  std::filesystem::path input, output;
  std::filesystem::path job_file;  ///< of --job; empty: the job in the input file
  std::vector<std::string> sets;
  bool quiet = false;
  std::shared_future<std::string> input_sha256{};  ///< worked out beside the stage, for the stamp
  std::vector<StageInput> inputs{};
};

/// Parses the command line, runs `body`, words what it throws. Returns the exit status. With --receipt, the
/// body is only run when the output is not yet what it would make (pipeline/files/receipt.h).
int run_stage(const StageInfo& info, int argc, char** argv,
              const std::function<void(const StageCall&, Progress&)>& body);

/// Runs `body` and words what it throws on standard error. Returns its value, or the exit status of the
/// failure.
int guarded(const std::string& program, const std::function<int()>& body);

/// Notes why standard output could not be written (errno), for finish_output().
void note_failed_output(int error);
/// The exit status of a program that has printed to standard output: `status`, unless what it printed is
/// lost.
int finish_output(int status);

/// The settings of a stage whose input is a file: of --job, else of the file's `job` attribute; then --set.
/// Errors: InputError also when the job differs from the file's in a part of an earlier stage (`before`),
/// because the file then does not hold what the job asks for.
Job job_of(const StageCall& call, const FileReader& input, const std::vector<JobPart>& before);

/// Writes the root attribute `warnings`, those of the file that was read (before) first, and says this
/// stage's own: on a terminal, in a study into the log. Of a file that does not tell its warnings the output
/// does not, either.
void note_warnings(FileWriter& file, const StageCall& call, Progress& progress,
                   const std::vector<Warning>& own, const FileReader* before = nullptr);

/// Writes the root attributes `job`, `history` and `input_sha256`. earlier: history of the input file, "" for
/// none. Called last before commit(): Errors: InputError when an input has changed since the stage began.
void stamp(FileWriter& file, const StageCall& call, const Job& job, const std::string& earlier);

}  // namespace dresslife::pipeline
