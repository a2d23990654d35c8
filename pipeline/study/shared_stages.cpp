#include "pipeline/study/shared_stages.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "pipeline/base/errors.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/files/checksum.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns the recipes of a job's stages up to `stage`, as one text.
std::string recipes_up_to(const JobState& state, std::size_t stage) {
  std::string all;
  for (std::size_t k = 0; k <= stage; ++k) all += state.recipes[k] + ' ';
  return all;
}

/// Returns whether a job has the results of its stages up to `stage`: the last output as a file, and the earlier outputs if
/// the study keeps them.
bool has_up_to(const JobState& state, const fs::path& folder, std::size_t stage) {
  if (state.next <= stage) return false;
  for (std::size_t k = 0; k <= stage; ++k)
    if ((k == stage || !may_lack(state.keep, k)) && !state_of(folder / files_of_stage(k).output).exists()) return false;
  return true;
}

/// Number of stages that a study takes from another study. The last stage is computed again, because it takes only seconds.
constexpr std::size_t taken_count = stage_count - 1;

/// In place of an output that is not given: remove_ours() leaves an empty file there, which must not get a receipt.
const fs::path no_output;

/// Name of the folder of a study's rigs, inside the study's folder (commands/making).
constexpr const char* rigs = ".rigs";

/// Returns the job folders with a simulation, of this study and of the studies beside it. Folders that cannot be read are left
/// out, because they are no fault of this study.
std::vector<fs::path> job_folders_beside(const fs::path& study_folder) {
  std::vector<fs::path> folders;
  const bool of_rigs = study_folder.filename() == rigs;
  const fs::path out = of_rigs ? study_folder.parent_path().parent_path() : study_folder.parent_path();
  try {
    for (const fs::path& study : entries_of(out)) {
      if (kind_of_name(study) != FileKind::folder || !lies_in_notes(study / ".stage" / "README")) continue;
      for (const fs::path& of : {study, study / rigs})
        for (const fs::path& job : entries_of(of))
          if (kind_of_name(job) == FileKind::folder && state_of(job / files_of_stage(0).receipt).exists())
            folders.push_back(job);
    }
  } catch (const std::runtime_error&) {
  }
  return folders;
}

/// (stage) recipes up to a stage, from the receipts of a job of another study, in the format of recipes_up_to().
std::vector<std::string> noted_recipes(const fs::path& folder) {
  std::vector<std::string> keys;
  std::string recipes, input = "-";
  try {
    for (std::size_t stage = 0; stage < taken_count; ++stage) {
      const std::optional<Receipt> receipt = read_receipt(folder / files_of_stage(stage).receipt);
      if (!receipt || receipt->input != input) break;
      keys.push_back(recipes += receipt->recipe + ' ');
      input = receipt->output;
    }
  } catch (const std::runtime_error&) {
  }
  return keys;
}

/// Links the outputs up to a stage from the folder of another study into a job's folder. Another run may use that study, so
/// nothing is written there, and the bytes are compared after linking. Returns false if they differ from the receipt.
bool take_up_to(const fs::path& from, const fs::path& to, const JobState& state, std::size_t last) {
  const auto needed = [&](std::size_t stage) { return stage == last || !may_lack(state.keep, stage); };
  for (std::size_t stage = state.next; stage <= last; ++stage)
    if (needed(stage) && !state_of(from / files_of_stage(stage).output).exists()) return false;
  make_notes(to / ".stage");
  std::string input = state.inputs[state.next];
  for (std::size_t stage = state.next; stage <= last; ++stage) {
    const StageFiles files = files_of_stage(stage);
    const std::optional<Receipt> receipt = read_receipt(from / files.receipt);
    if (!receipt || receipt->recipe != state.recipes[stage] || receipt->input != input) return false;
    if (needed(stage) && !is_as_noted(*receipt, from / files.output)) return false;
    remove_ours(to / files.receipt);
    if (needed(stage)) {
      give_second_name(from / files.output, to / files.output);
      if (checksum_of(to / files.output) != receipt->output) {  // another run or the user has replaced the file
        remove_ours(to / files.output);
        return false;
      }
    } else {
      remove_ours(to / files.output);  // it belongs to the removed receipt
    }
    copy_if_there(from / files.log, to / files.log);
    write_receipt(to / files.receipt, *receipt, needed(stage) ? to / files.output : no_output);
    input = receipt->output;
  }
  return true;
}

/// Returns whether a job may take stages from another study.
bool may_take(const StudyJob& job, const JobState& state) {
  return job.failure.empty() && state.next < taken_count && !state.recipes[0].empty() && !state.foreign;
}

void share_with_other_studies(const Study& study, const StudyPlaces& places, std::vector<JobState>& states) {
  // job folders that have an output, by the recipes that this study needs
  std::unordered_map<std::string, std::vector<fs::path>> havers;
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t stage = states[k].next; may_take(study.jobs[k], states[k]) && stage < taken_count; ++stage)
      havers[recipes_up_to(states[k], stage)];
  if (havers.empty()) return;
  const fs::path here = fs::absolute(places.folder);
  for (const fs::path& folder : job_folders_beside(here))
    for (const std::string& recipes : noted_recipes(folder))
      if (const auto found = havers.find(recipes); found != havers.end()) found->second.push_back(folder);
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!may_take(study.jobs[k], states[k])) continue;
    const fs::path folder = here / study.jobs[k].name;
    bool taken = false;
    for (std::size_t stage = taken_count; !taken && stage-- > states[k].next;)
      for (const fs::path& from : havers[recipes_up_to(states[k], stage)])
        if (!taken && from != folder) taken = take_up_to(from, folder, states[k], stage);
    if (taken) look_at(states[k], folder);
  }
}

/// A job that gets the outputs of another job, and the last stage of these outputs.
struct Receiver {
  std::size_t to, last;
};

void give_stage(const fs::path& from, const std::vector<fs::path>& folders, std::size_t stage) {
  const StageFiles files = files_of_stage(stage);
  const bool is_there = state_of(from / files.output).exists();
  for (const fs::path& to : folders) {
    make_notes(to / ".stage");
    remove_ours(to / files.receipt);  // the receipt describes a file that is replaced below
    if (is_there)
      give_second_name(from / files.output, to / files.output);
    else
      remove_ours(to / files.output);  // it belongs to the removed receipt
    copy_if_there(from / files.log, to / files.log);
    if (stage + 1 == stage_count) copy_if_there(from / "log", to / "log");
  }
  if (is_there)
    renew_receipt(from / files.receipt, from / files.output);  // the new hard link changed one of the file's times
  const std::optional<Receipt> receipt = read_receipt(from / files.receipt);
  for (const fs::path& to : folders)
    if (receipt) write_receipt(to / files.receipt, *receipt, is_there ? to / files.output : no_output);
}

}  // namespace

void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states) {
  if (std::ranges::all_of(states, [](const JobState& state) { return state.done() || state.recipes[0].empty(); }))
    return;
  std::unordered_map<std::string, std::size_t> havers;
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t stage = 0; study.jobs[k].failure.empty() && stage < stage_count; ++stage)
      if (has_up_to(states[k], places.job(study.jobs[k].name), stage))
        havers.emplace(recipes_up_to(states[k], stage), k);
  std::map<std::size_t, std::vector<Receiver>> gifts;  // (giving job) receivers
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty() || states[k].foreign) continue;
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
  share_with_other_studies(study, places, states);
}

}  // namespace dresslife::pipeline
