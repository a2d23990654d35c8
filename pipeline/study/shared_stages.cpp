#include "pipeline/study/shared_stages.h"

#include <map>
#include <set>
#include <system_error>

#include "pipeline/errors.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// What a job's stages up to one are made from.
std::string recipes_up_to(const JobState& state, std::size_t stage) {
  std::string all;
  for (std::size_t k = 0; k <= stage; ++k) all += state.recipes[k] + '\n';
  return all;
}

bool can_run(const StudyJob& job, const JobState& state) { return job.failure.empty() && !state.recipes[0].empty(); }

/// A second name for the file; where the file system has none, a copy.
void give(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  fs::remove(to, failure);
  fs::create_hard_link(from, to, failure);
  if (failure) fs::copy_file(from, to, fs::copy_options::overwrite_existing, failure);
  if (failure) throw InputError({to.string()}, "cannot be written (" + failure.message() + ")", "check the folder");
}

void give_stage(const fs::path& from, const fs::path& to, std::size_t stage) {
  std::error_code failure;
  fs::create_directories(to / ".stage", failure);
  const StageFiles files = files_of_stage(stage);
  give(from / files.output, to / files.output);
  fs::copy_file(from / files.receipt, to / files.receipt, fs::copy_options::overwrite_existing, failure);
  if (failure)
    throw InputError({(to / files.receipt).string()}, "cannot be written (" + failure.message() + ")", "check the folder");
  for (const fs::path& folder : {from, to}) renew_receipt(folder / files.receipt, folder / files.output);
}

}  // namespace

void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states) {
  for (std::size_t stage = 0; stage + 1 < stage_count; ++stage) {
    std::map<std::string, std::size_t> makers;
    for (std::size_t k = 0; k < states.size(); ++k)
      if (can_run(study.jobs[k], states[k]) && states[k].next > stage)
        makers.emplace(recipes_up_to(states[k], stage), k);
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (!can_run(study.jobs[k], states[k]) || states[k].next != stage) continue;
      const auto maker = makers.find(recipes_up_to(states[k], stage));
      if (maker == makers.end()) continue;
      give_stage(places.job(study.jobs[maker->second].name), places.job(study.jobs[k].name), stage);
      look_at(states[k], places.job(study.jobs[k].name));
    }
  }
}

std::vector<std::size_t> without_likes(const Study& study, const std::vector<JobState>& states) {
  std::vector<std::size_t> now;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (can_run(study.jobs[k], states[k]) && !states[k].done() &&
        taken.insert(recipes_up_to(states[k], states[k].next)).second)
      now.push_back(k);
  return now;
}

}  // namespace dresslife::pipeline
