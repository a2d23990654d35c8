// All quick checks of a job, in seconds: of its description, and of its program by geometry and statics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

struct JobCheck {
  std::string refusal;             ///< why the simulation refuses the job; empty: it takes it
  std::vector<Warning> warnings;   ///< a run of the job has warnings of the same kinds; of strain.slip only a check has one
  std::vector<std::string> notes;  ///< which lengths suit, for each dresspack between two clamps
  std::vector<std::string> estimates;  ///< keys that each dresspack leaves out, with the values that count, as a run lists them
  std::string limits;              ///< what only a run finds, a sentence
};

/// Errors: InputError for all that a reader of jobs refuses, at once.
JobCheck check_of(const std::filesystem::path& job, const std::vector<std::string>& sets);
/// The same with the file of dresslife-sim --preview, which is written unless the motion is prescribed.
JobCheck check_of(const std::filesystem::path& job, const std::vector<std::string>& sets,
                  const std::filesystem::path& preview_file);

/// Prints warnings, lengths and the refusal.
void print_check(const JobCheck& check);

}  // namespace dresslife::pipeline
