#include "pipeline/study/job_folder.h"

#include <array>

#include "pipeline/base/ownership.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// What a run writes into a job's folder. All else in it is the user's.
constexpr std::array<const char*, 7> own_files{"job.yaml", "motion.h5", "strain.h5",   "life.h5",
                                               "log",      "page.html", "preview.html"};

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t sum = 0;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) && !entry.is_symlink(ignored)) sum += entry.file_size(ignored);
  return sum;
}

}  // namespace

bool is_job_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::symlink_status(folder, ignored).type() == fs::file_type::directory &&
         lies_in_notes(folder / ".stage" / "README") && is_ours(folder / "job.yaml");
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
