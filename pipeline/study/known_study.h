// What a run noted of its study when it had expanded it: names, recipes and settings of all jobs, and
// everything that was looked at for them. As long as every look finds the same, the study expands to the
// same, and who only wants to know how it stands need not expand it.
//
// Nothing is believed by its time: texts count by their digests, other looks by what they find. Only of the
// settings that the run wrote out, each job's job.yaml, size, inode and both times spare the look, as in
// receipts (pipeline/files/receipt.h): while they are what was noted, and the note is younger than they.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/resolve/sources.h"
#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// What is asked for, and where its results go.
struct StudyRequest {
  std::filesystem::path file;
  std::vector<std::string> sets;
  std::filesystem::path out;       ///< folder of studies
  std::filesystem::path programs;  ///< where the stages are
};

/// A study and how its jobs stand.
struct Standing {
  Study study;
  StudyPlaces places;
  std::vector<JobState> states;
  bool remembered = false;  ///< not expanded: its jobs are names
  // Of an expanded one:
  Sources::Looks looks{};
  Digests digests{};  ///< of programs, and of files beside the jobs

  bool all_done() const;
};

/// From memory where it holds, else expanded. Errors: as read_study() and states_of().
Standing standing_of(const StudyRequest& request);
/// Expanded, whatever is remembered.
Standing expanded(const StudyRequest& request);

/// Brings the states up to date: another run may have been at work.
void look_again(Standing& standing);

/// Notes an expanded study in its folder, after write_build_graph(). One with a job that cannot be run is
/// forgotten.
void remember(const StudyRequest& request, const Standing& standing);

}  // namespace dresslife::pipeline
