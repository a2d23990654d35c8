// A study with the states of its jobs. Each command expands the study again, which takes a tenth of a millisecond per job or less.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
  Digests digests{};  ///< digests of the programs and of the files beside the jobs

  bool all_done() const;
};

/// Returns the study and its states. Errors: those of read_study() and states_of().
StudyState expanded(const StudyRequest& request);

/// Updates the states after another program has run stages in the folder.
void look_again(StudyState& standing);

}  // namespace dresslife::pipeline
