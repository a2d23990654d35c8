// Common part of all stages' programs: the command line, exit statuses, the source of the settings, and the attributes that
// identify an output. A stage's main is a StageInfo and one call of run_stage().
//
// Exit status: 0 success, 1 wrong input, 2 wrong command line, 3 a bug of this project.
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
  std::string program;               ///< "dresslife-sim"
  std::string purpose;               ///< one sentence for --help
  std::string input;                 ///< name of the positional argument: "JOB.yaml", "motion.h5"
  std::string output;                ///< name of the argument of -o: "motion.h5"
  std::string example;               ///< a complete command line
  bool input_is_job = false;         ///< the input is the job itself; otherwise the stage has --job
  bool may_lack_output = false;      ///< without -o, no file is written
  std::vector<Option> options = {};  ///< of this stage only
  std::optional<JobPart> part =
      {};  ///< part of the job on which the result depends; std::nullopt: the program is no stage of a study
  /// Results for the receipt of the output, for programs that do not open the output; empty: none.
  std::function<std::vector<ResultValue>(const std::filesystem::path& output)> results = {};
};

/// An input file, and its state at the start of the stage.
struct StageInput {
  std::filesystem::path file;
  FileState state;
  std::optional<std::string> checksum;
  bool young = false;  ///< changed so recently that a later change may have the same state
};

struct StageCall {
  StageInfo info;
  StageLimits limits{};
  bool of_a_study = false;  ///< messages go into a log
  std::filesystem::path input{}, output{};
  std::filesystem::path job_file{};  ///< from --job; empty: the job in the input file
  std::vector<std::string> sets{};
  bool quiet = false;
  std::shared_future<std::string> input_sha256{};  ///< computed in parallel to the stage, for stamp()
  std::vector<StageInput> inputs{};
};

/// Parses the command line, runs `body` and prints its exceptions. Returns the exit status. With --receipt, `body` only runs if
/// the output is not up to date (pipeline/files/receipt.h).
int run_stage(const StageInfo& info, int argc, char** argv,
              const std::function<void(const StageCall&, Progress&)>& body);

/// Runs `body` and prints its exceptions on standard error. Returns its value, or the exit status of the failure.
int guarded(const std::string& program, const std::function<int()>& body);

/// Stores the reason (errno) why standard output could not be written, for finish_output().
void note_failed_output(int error);
/// Returns the exit status of a program that prints to standard output: `status`, or a failure if some output was not written.
int finish_output(int status);

/// Returns the settings of a stage whose input is a file: from --job, otherwise from the `job` attribute of the file; then
/// changed by --set. Errors: InputError also if the job differs from that of the file in a part of an earlier stage (`before`),
/// because the file then does not belong to the job.
Job job_of(const StageCall& call, const FileReader& input, const std::vector<JobPart>& before);

/// Writes the root attribute `warnings`: those of the input file (`before`), then those of this stage. Prints those of this stage
/// on a terminal, in a study into the log. If the input file has no attribute `warnings`, the output has none either.
void note_warnings(FileWriter& file, const StageCall& call, Progress& progress, const std::vector<Warning>& own,
                   const FileReader* before = nullptr);

/// Writes the root attributes `job`, `history` and `input_sha256`. earlier: history of the input file; empty: none. Precondition:
/// it is called directly before commit(). Errors: InputError if an input has changed since the start of the stage.
void stamp(FileWriter& file, const StageCall& call, const Job& job, const std::string& earlier);

}  // namespace dresslife::pipeline
