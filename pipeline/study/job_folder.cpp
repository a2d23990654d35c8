#include "pipeline/study/job_folder.h"

#include <array>

#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Files that a run writes into a job's folder. All other files in it are the user's.
constexpr std::array<const char*, 7> own_files{"job.yaml", "motion.h5", "strain.h5",   "life.h5",
                                               "log",      "page.html", "preview.html"};

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::path& file : files_below(folder))
    if (const FileState state = state_of(file); state.exists()) sum += static_cast<std::uintmax_t>(state.size);
  return sum;
}

}  // namespace

bool is_job_folder(const fs::path& folder) {
  return kind_of_name(folder) == FileKind::folder && lies_in_notes(folder / ".stage" / "README") &&
         is_ours(folder / "job.yaml");
}

std::uintmax_t remove_job(const fs::path& folder) {
  const std::uintmax_t before = bytes_in(folder);
  for (const char* file : own_files) remove_ours(folder / file);
  remove_notes(folder / ".stage");
  const std::uintmax_t left = bytes_in(folder);
  remove_empty(folder);
  return before - left;
}

}  // namespace dresslife::pipeline
