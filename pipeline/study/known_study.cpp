#include "pipeline/study/known_study.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string_view>
#include <thread>

#include "pipeline/base/digest.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/words.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/relative_life.h"
#include "pipeline/study/shards.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

fs::path memory_of(const StudyPlaces& places) { return places.folder / ".stage" / "study"; }
fs::path settings_of(const StudyPlaces& places, const std::string& job) { return places.job(job) / "job.yaml"; }

/// Returns a digest of all inputs of the expansion that are in no file.
std::string digest_of(const StudyRequest& request) {
  Xxh3 digest;
  const auto add =
      [&](const std::string&
              text) {  // the length stands before each text, so that different lists never give the same bytes
        const std::string whole = fmt::format("{}:{}", text.size(), text);
        digest.add(whole.data(), whole.size());
      };
  add(xxh3_of_file(program_file()));  // this program does the expansion
  add(fs::absolute(request.file).string());
  add(fs::absolute(request.programs).string());
  add(fs::current_path().string());
  const char* const catalogue = std::getenv("DRESSLIFE_CONFIG");
  add(catalogue ? catalogue : "");
  for (const std::string& set : request.sets) add(set);
  return digest.hex();
}

std::string noted(const std::string& found) { return found == "yes" || found == "no" ? found : xxh3(found); }

constexpr std::string_view first_line = "dresslife study 4";

/// Returns whether the search noted in a line still has the same result.
bool finds_the_same(Words& line) {
  const auto kind = static_cast<Sources::Kind>(line.number<int>(' '));
  const std::string_view found = line.until(' ');
  return noted(Sources::found_at(kind, line.until('\n'))) == found;
}

JobState state_from(Words& line, std::string& name, FileState& settings) {
  JobState state;
  name = line.until(' ');
  state.settings = line.until(' ');
  for (std::string& recipe : state.recipes) recipe = line.until(' ');
  settings.size = line.number<std::int64_t>(' ');
  settings.modified_ns = line.number<std::int64_t>(' ');
  settings.changed_ns = line.number<std::int64_t>(' ');
  settings.inode = line.number<std::uint64_t>('\n');
  return state;
}

std::optional<StudyState> recalled(const StudyRequest& request, const StudyPlaces& places) {
  if (!state_of(memory_of(places)).exists()) return std::nullopt;
  const std::string text = read_text(memory_of(places));
  const std::int64_t written = state_of(memory_of(places)).changed_ns;
  Words lines(text);
  if (lines.until('\n') != first_line) return std::nullopt;
  const std::string_view digest = lines.until('\n');
  if (digest != xxh3(std::string_view(text).substr(std::min(text.size(), first_line.size() + digest.size() + 2))))
    return std::nullopt;
  if (lines.until('\n') != digest_of(request)) return std::nullopt;
  StudyState standing{{places.folder.filename().string(), {}}, places, {}, true};
  while (lines.any()) {
    const std::string_view what = lines.until(' ');
    if (what == "look") {
      if (!finds_the_same(lines)) return std::nullopt;
    } else if (what == "keep") {
      standing.study.keep = static_cast<Keep>(lines.number<int>('\n'));
    } else if (what == "rated") {
      standing.rated = lines.number<int>('\n') != 0;
    } else if (what == "varied") {
      standing.study.varied.emplace_back(lines.until('\n'));
    } else if (what == "value") {
      standing.study.jobs.back().values.emplace_back(lines.until('\n'));
    } else if (what == "digest") {
      const std::string_view was = lines.until(' ');
      if (standing.digests.of(lines.until('\n')) != was) return std::nullopt;
    } else {
      StudyJob& job = standing.study.jobs.emplace_back();
      FileState settings;
      standing.states.push_back(state_from(lines, job.name, settings));
      standing.states.back().keep = standing.study.keep;
      if (settings.changed_ns >= written || state_of(settings_of(places, job.name)) != settings) return std::nullopt;
    }
  }
  look_again(standing);
  return standing;
}

/// Returns whether a path contains no line feed, so that it can end a line of the note.
bool fits_a_line(const std::string& path) { return path.find('\n') == std::string::npos; }

/// Returns the note of a study; std::nullopt if the note could not be read back exactly.
std::optional<std::string> text_of(const StudyRequest& request, const StudyState& standing) {
  std::string text = digest_of(request) + '\n';
  for (const auto& [look, found] : standing.look_ups) {
    if (!fits_a_line(look.second)) return std::nullopt;
    text += fmt::format("look {} {} {}\n", static_cast<int>(look.first), noted(found), look.second);
  }
  for (const auto& [file, digest] : standing.digests.all()) {
    if (!fits_a_line(file.string())) return std::nullopt;
    text += fmt::format("digest {} {}\n", digest, file.string());
  }
  text += fmt::format("keep {}\n", static_cast<int>(standing.study.keep));
  text += fmt::format("rated {}\n", static_cast<int>(std::ranges::any_of(standing.study.jobs, [](const StudyJob& job) {
                        return job.job && has_ratings(*job.job);
                      })));
  for (const std::string& key : standing.study.varied) {
    if (!fits_a_line(key)) return std::nullopt;
    text += fmt::format("varied {}\n", key);
  }
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    const StudyJob& job = standing.study.jobs[k];
    const JobState& state = standing.states[k];
    if (!job.failure.empty()) return std::nullopt;
    const FileState settings = state_of(settings_of(standing.places, job.name));
    text +=
        fmt::format("job {} {} {} {} {} {} {} {} {}\n", job.name, state.settings, state.recipes[0], state.recipes[1],
                    state.recipes[2], settings.size, settings.modified_ns, settings.changed_ns, settings.inode);
    for (const std::string& value : job.values) {
      if (!fits_a_line(value)) return std::nullopt;
      text += fmt::format("value {}\n", value);
    }
  }
  return fmt::format("{}\n{}\n", first_line, xxh3(text)) + text;
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

void read_jobs(StudyState& standing) {
  StoredJobs stored;
  std::map<std::array<std::string, stage_count>, std::pair<std::shared_ptr<const Job>, std::size_t>> known;
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    StudyJob& job = standing.study.jobs[k];
    auto& [same, beside_motion] = known[standing.states[k].recipes];
    if (!same) same = stored.read(settings_of(standing.places, job.name)), beside_motion = stored.beside_motion();
    job.job = same, job.beside_motion = beside_motion;
  }
}

Study with_dresspacks(const StudyState& standing) {
  StoredJobs stored;
  Study study = standing.study;
  for (StudyJob& job : study.jobs) job.job = stored.read_dresspacks(settings_of(standing.places, job.name));
  return study;
}

namespace {

/// read: returns the jobs. shard: name of the shard; empty for all jobs.
StudyState expanded_from(const StudyRequest& request, const std::function<Study()>& read, const std::string& shard) {
  Sources sources;
  StudyState standing;
  standing.study = read();
  standing.places = {request.out / standing.study.name, request.programs, shard};
  standing.states = states_of(standing.study, standing.places, standing.digests);
  standing.look_ups = sources.take();
  return standing;
}

}  // namespace

StudyState expanded(const StudyRequest& request) {
  return expanded_from(
      request, [&] { return read_study(request.file, request.sets); }, "");
}

StudyState expanded(const StudyRequest& request, const Shard& shard) {
  return expanded_from(
      request, [&] { return read_study(request.file, request.sets, shard); }, shard.name());
}

StudyState standing_of(const StudyRequest& request) {
  const StudyPlaces places{request.out / study_name(request.file), request.programs};
  if (std::optional<StudyState> standing = recalled(request, places)) return std::move(*standing);
  return expanded(request);
}

void remember(const StudyRequest& request, const StudyState& standing) {
  const fs::path memory = memory_of(standing.places);
  const std::optional<std::string> text = text_of(request, standing);
  if (!text) {
    remove_ours(memory);
    return;
  }
  // The note must be younger than every job.yaml by the file system's clock, which ticks every 1 .. 10 ms.
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  write_text_if_changed(memory, *text, Sync::never);
  ::utimensat(AT_FDCWD, memory.c_str(), nullptr, 0);
}

}  // namespace dresslife::pipeline
