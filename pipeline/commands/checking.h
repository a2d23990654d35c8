// All quick checks of a job, in seconds: checks of its description, and of its program by geometry and statics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

struct JobCheck {
  std::string refusal;            ///< reason why the simulation refuses the job; empty: the simulation accepts it
  std::vector<Warning> warnings;  ///< a run of the job has warnings of the same kinds
  /// suitable lengths of each dresspack between two clamps, and a note if strain.slip gives a bound only
  std::vector<std::string> notes;
  std::vector<std::string>
      estimates;       ///< keys that each dresspack leaves out, with the assumed values, in the format of a run
  std::string limits;  ///< a sentence with the faults that only a run finds
  bool ran = false;    ///< a short run followed the whole program
};

/// Checks a job. Errors: InputError with all faults that a reader of jobs finds.
JobCheck check_of(const std::filesystem::path& job, const std::vector<std::string>& sets);
/// Checks a job and writes the output of dresslife-sim --preview to `preview_file`, except if the motion is prescribed.
JobCheck check_of(const std::filesystem::path& job, const std::vector<std::string>& sets,
                  const std::filesystem::path& preview_file);

/// Adds the warnings of dresslife-strain for a dresspack that is a single cable, after two repeats with the job's own values. In a
/// hose, loose cables would take minutes. Precondition: `check` is of this job.
void add_cable_warnings(JobCheck& check, const std::filesystem::path& job, const std::vector<std::string>& sets);

/// Returns "ESTIMATE, not in the dresspack NAME: ..." for Dresspack::estimates. dresspack: name among several; empty: the only one.
std::string estimate_line(const std::string& dresspack, const std::string& estimates);

/// Prints the warnings, notes and the refusal.
void print_check(const JobCheck& check);

}  // namespace dresslife::pipeline
