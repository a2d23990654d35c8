// The noted expansion of a study: names, recipes and settings of all jobs, and every file that was read or searched for
// them. While all of these are unchanged, the study is not expanded again. Without the note a run of 10,000 jobs with nothing
// to do takes ten times as long (noop_10k_s and regraph_10k_s in scripts/speed.md).
//
// Texts are compared by their digests and searches by their results, not by file times. Exception: a job.yaml that the run
// wrote is unchanged if its size, inode and both times equal the note and the note is younger (pipeline/files/receipt.h).
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
  std::filesystem::path out;       ///< folder that contains the folders of studies
  std::filesystem::path programs;  ///< folder of the stage programs
};

/// A study and the states of its jobs.
struct StudyState {
  Study study;
  StudyPlaces places;
  std::vector<JobState> states;
  bool remembered = false;  ///< from the note, not expanded: its jobs have names but no settings
  bool rated = false;       ///< (remembered) whether a job has ratings, whose rigs need its settings: with_dresspacks()
  // Only of an expanded study:
  Sources::LookUps look_ups{};
  Digests digests{};  ///< digests of the programs and of the files beside the jobs

  bool all_done() const;
};

/// Returns the study and its states from the note if the note is valid; otherwise expands the study. Errors: those of
/// read_study() and states_of().
StudyState standing_of(const StudyRequest& request);
/// Returns the study and its states. Always expands the study.
StudyState expanded(const StudyRequest& request);

/// Reads the settings of a remembered study's jobs from job.yaml; jobs with the same recipes share one object.
/// Precondition: every job has a result. Errors: InputError.
void read_jobs(StudyState& standing);
/// Returns a remembered study with jobs for rated_study(), in a small part of the time of read_jobs(): their motions and routings
/// may be those of other jobs. Precondition and errors: those of read_jobs().
Study with_dresspacks(const StudyState& standing);

/// Updates the states after another program has run stages in the folder.
void look_again(StudyState& standing);

/// Writes the note of an expanded study into its folder. A study with an invalid job gets no note. Precondition:
/// write_build_graph() was called.
void remember(const StudyRequest& request, const StudyState& standing);

}  // namespace dresslife::pipeline
