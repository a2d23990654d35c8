#include "pipeline/study/study_state.h"

#include <algorithm>
#include <functional>

#include "pipeline/resolve/sources.h"
#include "pipeline/study/shards.h"

namespace dresslife::pipeline {
namespace {

/// read: returns the jobs. shard: name of the shard; empty for all jobs.
StudyState expanded_from(const StudyRequest& request, const std::function<Study()>& read, const std::string& shard) {
  const Sources sources;
  StudyState standing;
  standing.study = read();
  standing.places = {request.out / standing.study.name, request.programs, shard};
  standing.states = states_of(standing.study, standing.places, standing.digests);
  return standing;
}

}  // namespace

bool StudyState::all_done() const {
  return std::ranges::all_of(states, [](const JobState& state) { return state.done(); });
}

void look_again(StudyState& standing) {
  for (std::size_t k = 0; k < standing.states.size(); ++k)
    if (const StudyJob& job = standing.study.jobs[k]; job.failure.empty())
      look_at(standing.states[k], standing.places.job(job.name));
}

StudyState expanded(const StudyRequest& request) {
  return expanded_from(
      request, [&] { return read_study(request.file, request.sets); }, "");
}

StudyState expanded(const StudyRequest& request, const Shard& shard) {
  return expanded_from(
      request, [&] { return read_study(request.file, request.sets, shard); }, shard.name());
}

}  // namespace dresslife::pipeline
