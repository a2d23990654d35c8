#include "pipeline/study/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_plain(const Node& node) {
  return node.is_list() && std::ranges::all_of(node.items, [](const Node& item) { return item.is_scalar(); });
}

std::string value_words(const Node* value) {
  constexpr std::size_t longest = 40;
  if (!value || value->kind == Node::Kind::null) return "nothing";
  if (value->is_scalar())
    return value->text.size() <= longest ? value->text : fmt::format("a text of {} letters", value->text.size());
  if (value->is_map()) return fmt::format("{} keys", value->entries.size());
  if (!is_plain(*value)) return fmt::format("{} entries", value->items.size());
  const std::string list = fmt::format("[{}]", joined(mapped(value->items, &Node::text), ", "));
  return list.size() <= longest ? list : fmt::format("a list of {}", value->items.size());
}

/// Returns a number of many digits with six digits; any other text unchanged.
std::string rounded(const std::string& text) {
  const std::optional<double> number = number_in(text);
  return number && text.size() > 8 ? fmt::format("{:.6g}", *number) : text;
}

std::string change_words(const Node* was, const Node* now) {
  std::string before = value_words(was), after = value_words(now);
  if (rounded(before) != rounded(after)) before = rounded(before), after = rounded(after);
  return fmt::format("{} -> {}", before, after);
}

class Comparison {
 public:
  void compare(const Node* was, const Node* now, const std::string& path) {
    const bool maps = was && now && was->is_map() && now->is_map();
    const bool lists = was && now && was->is_list() && now->is_list() && was->items.size() == now->items.size();
    if (maps)
      compare_maps(*was, *now, path);
    else if (lists && !(is_plain(*was) && is_plain(*now)))
      for (std::size_t i = 0; i < was->items.size(); ++i)
        compare(&was->items[i], &now->items[i], fmt::format("{}[{}]", path, i + 1));
    else if (!same(was, now))
      found.push_back(fmt::format("{} {}", path, change_words(was, now)));
  }
  std::vector<std::string> found;

 private:
  static bool same(const Node* was, const Node* now) { return was && now && to_yaml(*was) == to_yaml(*now); }
  void compare_maps(const Node& was, const Node& now, const std::string& path) {
    const auto key = [&](const Entry& entry) { return path.empty() ? entry.key : path + '.' + entry.key; };
    for (const Entry& entry : was.entries) compare(&entry.value, now.find(entry.key), key(entry));
    for (const Entry& entry : now.entries)
      if (!was.find(entry.key)) compare(nullptr, &entry.value, key(entry));
  }
};

/// Returns the keys whose values differ between the last result and the present settings. Empty if life.h5 is not kept.
std::vector<std::string> changed_settings(const StudyJob& job, const StudyPlaces& places) {
  const fs::path life = places.life(job.name);
  if (!state_of(life).exists()) return {};
  const std::string was = FileReader(life, life_format(), FileReader::Scope::attributes).text_attribute("job");
  const fs::path settings = places.job(job.name) / "job.yaml";  // of a job that was not expanded
  const std::string now = job.job ? stored_job_text(*job.job, places.job(job.name)) : read_text(settings);
  return changed_keys(parse_yaml(was, life.string()), parse_yaml(now, settings.string()));
}

/// Returns the programs and files that changed after the last result was made. Ignores a stage that ran again since, because
/// its receipt belongs to another result.
std::vector<std::string> changed_files(const StudyJob& job, const StudyPlaces& places, Digests& digests) {
  const fs::path folder = places.job(job.name);
  std::vector<std::string> changed;
  std::optional<Receipt> later;
  for (std::size_t stage = stage_count; stage-- > 0;) {
    const std::optional<Receipt> receipt = read_receipt(folder / files_of_stage(stage).receipt);
    if (!receipt || (later && receipt->output != later->input)) break;
    for (const auto& [what, digest] : receipt->made_with) {
      const bool program = what.starts_with("dresslife-");
      const fs::path file = program ? places.programs / what : seen_file(folder, what);
      const std::string& now = digests.of(file);
      if (now == digest) continue;
      const char* how = program ? "is another program" : now == "absent" ? "is gone" : "has changed";
      changed.push_back(fmt::format("{} {}", program ? what : file.string(), how));
    }
    // The files beside a job belong to its first stage.
    for (const fs::path& file : stage == 0 && job.job ? files_beside(*job.job) : std::vector<fs::path>{})
      if (const std::string seen = as_seen_from(folder, file).string();
          std::ranges::none_of(receipt->made_with, [&](const auto& noted) { return noted.first == seen; }))
        changed.push_back(fmt::format("{} is new beside the program", seen_file(folder, seen).string()));
    later = receipt;
  }
  std::ranges::reverse(changed);
  return changed;
}

/// Returns the reason why a job without changed keys, files and programs is stale.
std::string other_reason(const JobState& state, const StudyPlaces& places, const std::string& job) {
  if (!state_of(places.life(job)).exists()) return "its settings have changed (keep: lives keeps no old ones)";
  for (std::size_t stage = state.next; stage < stage_count; ++stage) {
    const StageFiles files = files_of_stage(stage);
    const fs::path output = places.job(job) / files.output;
    if (!may_lack(state.keep, stage) && read_receipt(places.job(job) / files.receipt) && !state_of(output).exists())
      return files.output.string() + (kind_of_name(output) == FileKind::absent ? " is gone" : " is no plain file");
  }
  return "its last run did not end";
}

/// Returns whether the changed key is a name or a source, which have no influence on a life.
bool is_prose(const std::string& change) {
  const std::string key = change.substr(0, change.find(' '));
  return key.ends_with("source") || key.ends_with(".name");
}

/// Returns the changes as text. Precondition: `changed` is not empty.
std::string words_of(std::vector<std::string> changed) {
  constexpr std::size_t named = 3;
  std::stable_partition(changed.begin(), changed.end(), [](const std::string& change) { return !is_prose(change); });
  const std::size_t more = changed.size() - std::min(changed.size(), named);
  changed.resize(changed.size() - more);
  return fmt::format("{}{}", joined(changed, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

}  // namespace

FilesAtStart::FilesAtStart(std::vector<std::shared_ptr<const Job>> jobs) : jobs_(std::move(jobs)) {
  for (const auto& job : jobs_)
    for (const fs::path& file : files_beside(*job)) {
      const FileState state = state_of(file);
      files_.try_emplace(file, state, Digests().of(file));
    }
}

void FilesAtStart::check() const {
  const auto changed = [](const fs::path& file, const char* how) {
    throw FilesChanged({file.string()}, fmt::format("{} during the search", how), "let nothing change it meanwhile");
  };
  for (const auto& [file, was] : files_) {
    if (state_of(file) == was.first) continue;
    const std::string now = Digests().of(file);
    if (now != was.second) changed(file, now == "absent" ? "was removed" : "has changed");
  }
  for (const auto& job : jobs_)
    for (const fs::path& file : files_beside(*job))
      if (!files_.contains(file)) changed(file, "came beside the program");
}

std::vector<std::string> changed_keys(const Node& was, const Node& now) {
  Comparison comparison;
  comparison.compare(&was, &now, "");
  return std::move(comparison.found);
}

void report_changes(const Study& study, const StudyPlaces& places, std::vector<JobState>& states) {
  constexpr std::size_t most = 50;  // limits the time: 10 ms per job if programs are long
  std::size_t named = 0;
  Digests digests;
  for (std::size_t k = 0; k < states.size() && named < most; ++k) {
    const StudyJob& job = study.jobs[k];
    if (!states[k].has_last || !job.failure.empty()) continue;
    ++named;
    try {
      std::vector<std::string> changed = changed_settings(job, places);
      for (std::string& file : changed_files(job, places, digests)) changed.push_back(std::move(file));
      if (changed.empty()) changed.push_back(other_reason(states[k], places, job.name));
      states[k].changed = words_of(std::move(changed));
    } catch (const InputError& problem) {
      states[k].changed = problem.what();
    }
  }
}

}  // namespace dresslife::pipeline
