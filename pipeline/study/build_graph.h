// The study as a Ninja build graph: per job sim -> strain -> fatigue, each edge depending on just those
// settings that its result depends on, on the program that makes it and on the stage before. Content counts,
// not time: settings and program fingerprints are written only when they differ, and stages leave an output
// untouched that comes out the same.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace dresslife::pipeline {

struct StudyPlaces {
  std::filesystem::path folder;    ///< DIR/<study>
  std::filesystem::path programs;  ///< where dresslife-sim, -strain and -fatigue are

  std::filesystem::path job(const std::string& name) const { return folder / name; }
  std::filesystem::path life(const std::string& name) const { return folder / name / "life.h5"; }
};

/// Writes job.yaml and the stage settings of every job that can run, the program fingerprints and
/// build.ninja. Errors: InputError when a program or the folder is missing.
void write_build_graph(const Study& study, const StudyPlaces& places);

struct BuildEvent {
  int finished = 0, total = 0;
  std::string what;  ///< "sim easy"
};

struct BuildResult {
  std::map<std::string, std::string> failures;  ///< job -> the line that its failed stage wrote
  std::vector<std::string> pending;             ///< of a dry run: jobs with something to do
  int executed = 0;                             ///< edges that ran (or would run)
};

/// Runs Ninja on the graph. dry: only tells what would run. on_event: called for every finished edge.
/// Errors: InputError when Ninja is not installed.
BuildResult run_build_graph(const StudyPlaces& places, int parallel, bool dry,
                            const std::function<void(const BuildEvent&)>& on_event);

/// How a job with something left to do stands: "failed   WHY" when its last attempt failed with the settings
/// of now, "stale" when it has results of other settings, "to do" when it has none.
std::string pending_state(const StudyJob& job, const StudyPlaces& places);

/// Joins the stages' logs of each job into its `log`.
void join_logs(const Study& study, const StudyPlaces& places);

}  // namespace dresslife::pipeline
