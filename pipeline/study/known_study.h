// The noted expansion of a study: names, recipes and settings of all jobs, and every file that was read or searched for
// them. While all of these are unchanged, the study need not be expanded again. 10,000 jobs: 0.6 s in place of 3.5 to
// 5 s (two idle cores, pipeline/study/README.md).
//
// Texts are compared by their digests, searches by their results, not by file times. Exception: a job.yaml that the run
// wrote is unchanged if size, inode and both times are as noted and the note is younger (pipeline/files/receipt.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/resolve/sources.h"
#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// A study and the folder of its results.
struct StudyRequest {
  std::filesystem::path file;
  std::vector<std::string> sets;
  std::filesystem::path out;       ///< folder of studies
  std::filesystem::path programs;  ///< folder of the stages
};

/// A study and the states of its jobs.
struct StudyState {
  Study study;
  StudyPlaces places;
  std::vector<JobState> states;
  bool remembered = false;  ///< not expanded: its jobs are names
  // Of an expanded one:
  Sources::Looks looks{};
  Digests digests{};  ///< of programs, and of files beside the jobs

  bool all_done() const;
};

/// From the note if it is valid, else expanded. Errors: as read_study() and states_of().
StudyState standing_of(const StudyRequest& request);
/// Always expanded.
StudyState expanded(const StudyRequest& request);

/// Gives the jobs of a remembered study their settings, from the job.yaml of each: one for all jobs with the same recipes.
/// Precondition: jobs with a result each. Errors: InputError.
void read_jobs(StudyState& standing);

/// Updates the states after another run.
void look_again(StudyState& standing);

/// Notes an expanded study in its folder, after write_build_graph(). A study with an invalid job is not noted.
void remember(const StudyRequest& request, const StudyState& standing);

}  // namespace dresslife::pipeline
