#include "pipeline/study/shared_stages.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// What a job's stages up to one are made from.
std::string recipes_up_to(const JobState& state, std::size_t stage) {
  std::string all;
  for (std::size_t k = 0; k <= stage; ++k) all += state.recipes[k] + ' ';
  return all;
}

/// Whether the job has what its stages up to this one made: the last of it as a file, and before it what is
/// kept.
bool has_up_to(const JobState& state, const fs::path& folder, std::size_t stage) {
  if (state.next <= stage) return false;
  for (std::size_t k = 0; k <= stage; ++k)
    if ((k == stage || !may_lack(state.keep, k)) && !state_of(folder / files_of_stage(k).output).exists())
      return false;
  return true;
}

/// Who gets the outputs of a job, up to and with which stage.
struct Receiver {
  std::size_t to, last;
};

void give_stage(const fs::path& from, const std::vector<fs::path>& folders, std::size_t stage) {
  const StageFiles files = files_of_stage(stage);
  const bool is_there = state_of(from / files.output).exists();
  for (const fs::path& to : folders) {
    make_notes(to / ".stage");
    remove_ours(to / files.receipt);  // it is of a file that is about to go
    if (is_there) give_second_name(from / files.output, to / files.output);
    copy_if_there(from / files.log, to / files.log);
    if (stage + 1 == stage_count) copy_if_there(from / "log", to / "log");
  }
  if (is_there)
    renew_receipt(from / files.receipt, from / files.output);  // another name changed one of its times
  const std::optional<Receipt> receipt = read_receipt(from / files.receipt);
  for (const fs::path& to : folders)
    if (receipt) write_receipt(to / files.receipt, *receipt, to / files.output);
}

}  // namespace

void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states) {
  if (std::all_of(states.begin(), states.end(),
                  [](const JobState& state) { return state.done() || state.recipes[0].empty(); }))
    return;
  std::unordered_map<std::string, std::size_t> havers;
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t stage = 0; study.jobs[k].failure.empty() && stage < stage_count; ++stage)
      if (has_up_to(states[k], places.job(study.jobs[k].name), stage))
        havers.emplace(recipes_up_to(states[k], stage), k);
  std::map<std::size_t, std::vector<Receiver>> gifts;  // by giving job
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty()) continue;
    for (std::size_t stage = stage_count; stage-- > states[k].next;)
      if (const auto haver = havers.find(recipes_up_to(states[k], stage)); haver != havers.end()) {
        gifts[haver->second].push_back({k, stage});
        break;
      }
  }
  for (const auto& [from, all] : gifts) {
    for (std::size_t stage = 0; stage < stage_count; ++stage) {
      std::vector<fs::path> folders;
      for (const Receiver& gift : all)
        if (gift.last >= stage) folders.push_back(places.job(study.jobs[gift.to].name));
      if (!folders.empty()) give_stage(places.job(study.jobs[from].name), folders, stage);
    }
    for (const Receiver& gift : all) look_at(states[gift.to], places.job(study.jobs[gift.to].name));
  }
}

}  // namespace dresslife::pipeline
