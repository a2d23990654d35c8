// Start of a stage's program, and the file of its results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/last_moment.h"

namespace dresslife::pipeline {

enum class StageWords { shown, dropped };

/// Runs the program of this name from the folder of this program, with the same streams. It ends when this program ends.
/// dropped: its standard error is discarded. Returns its exit status. Errors: InputError when it cannot be started or is killed.
int run_stage_program(const std::string& program, const std::vector<std::string>& arguments,
                      StageWords said = StageWords::shown);

/// The same; the program's standard error goes to a file.
int run_stage_program(const std::string& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& errors);

/// A temporary file in its own folder (in TMPDIR, or /tmp) for the results of a program, removed with this object.
/// Errors: InputError when the file cannot be created.
class PassingFile {
 public:
  explicit PassingFile(const std::string& name);
  ~PassingFile();
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path file_;
  std::optional<RemovedAtTheEnd> folder_at_the_end_, file_at_the_end_;
};

}  // namespace dresslife::pipeline
