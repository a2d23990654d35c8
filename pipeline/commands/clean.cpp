#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <set>

#include "pipeline/base/readable.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/folder_lock.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// What a run writes into a job's folder; whatever else lies there is somebody's own.
constexpr std::array<const char*, 7> own_files{"job.yaml", "motion.h5", "strain.h5",   "life.h5",
                                               "log",      "page.html", "preview.html"};

struct Freed {
  std::uintmax_t bytes = 0;
  std::size_t folders = 0;
};

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t sum = 0;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) && !entry.is_symlink(ignored)) sum += entry.file_size(ignored);
  return sum;
}

/// Of a job that the study has no more: our files, and the folder if nothing else is in it.
void remove_job(const fs::path& folder, Freed& freed) {
  const std::uintmax_t before = bytes_in(folder);
  for (const char* file : own_files) remove_ours(folder / file);
  remove_notes(folder / ".stage");
  const std::uintmax_t left = bytes_in(folder);
  remove_empty(folder);
  freed.bytes += before - left;
  ++freed.folders;
}

bool is_job_folder(const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.is_directory(ignored) && !entry.is_symlink(ignored) &&
         lies_in_notes(entry.path() / ".stage" / "README") && is_ours(entry.path() / "job.yaml");
}

int clean(const StudyOptions& options) {
  const StudyRequest request = request_of(options);
  const fs::path folder = request.out / study_name(request.file);
  if (kind_of(folder) != FileKind::folder)
    throw InputError({folder.string()}, "is not there (the study has not run)",
                     "run it: dresslife run " + options.study);
  const FolderLock lock(folder);
  const Standing standing = standing_of(request);
  Freed freed;
  std::set<std::string> jobs;
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    jobs.insert(standing.study.jobs[k].name);
    freed.bytes += remove_unkept(standing.states[k], standing.places.job(standing.study.jobs[k].name));
  }
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_job_folder(entry) && !jobs.contains(entry.path().filename().string()))
      others.push_back(entry.path());
  for (const fs::path& other : others) remove_job(other, freed);
  constexpr double megabyte = 1e6;
  print(shown(fmt::format("{}: {} MB freed, {} jobs that the study has no more\n", folder.string(),
                          readable(static_cast<double>(freed.bytes) / megabyte), freed.folders)));
  return 0;
}

}  // namespace

Command clean_command() {
  const auto options = std::make_shared<StudyOptions>();
  return {"clean", "remove what a study does not keep (its key keep), and the results of jobs that it has no more",
          joined({{{"study", "", "STUDY.yaml", &options->study, {.required = true}}}, study_options(*options)}),
          [options] { return clean(*options); }};
}

}  // namespace dresslife::pipeline
