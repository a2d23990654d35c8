// The command line of a stage. A file of its own because the parser takes long to compile.
#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/stage/stage.h"

namespace dresslife::pipeline {

/// What only the command line of a stage says.
struct StageFlags {
  bool force = false;
  std::filesystem::path receipt;
  std::filesystem::path likes;  ///< names the folders of jobs to which this output belongs, too, line by line
};

/// Fills `call` and `flags`. Returns the exit status when that is all: the line is wrong, or has asked for
/// words.
std::optional<int> read_command_line(const StageInfo& info, int argc, char** argv, StageCall& call,
                                     StageFlags& flags);

}  // namespace dresslife::pipeline
