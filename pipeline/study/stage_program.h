// One of the stages' programs, started and waited for, and the file that it tells into.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/last_moment.h"

namespace dresslife::pipeline {

/// Runs the program of this name, which lies beside this one; it says what it says and ends with this one.
/// Returns its exit status. Errors: InputError when it cannot be started or is killed.
int run_stage_program(const std::string& program, const std::vector<std::string>& arguments);

/// A file in a folder of its own that live as long as this, for what a program is to tell. Errors: InputError
/// when there can be none (below TMPDIR, or /tmp).
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
