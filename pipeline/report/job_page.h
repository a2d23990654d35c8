// The page of one job: robot and dresspack in motion, place and time of the damage, and the estimates behind the
// numbers. One HTML file of at most 5 MB for three minutes of motion, beside the results of the job.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// The folder of a job, which contains motion.h5, strain.h5 and life.h5.
struct JobFolder {
  std::string name;  ///< name of the job
  std::filesystem::path folder;

  std::filesystem::path motion() const { return folder / "motion.h5"; }
  std::filesystem::path strain() const { return folder / "strain.h5"; }
  std::filesystem::path life() const { return folder / "life.h5"; }
  std::filesystem::path page() const { return folder / "page.html"; }
};

/// Returns the page as text. Without motion.h5 or strain.h5, which a study need not keep, the page contains the other sections
/// and names the missing files. Errors: InputError when a file cannot be read or the files belong to different jobs.
std::string job_page(const JobFolder& files);

enum class StaleMark { removed, kept };

/// Writes the page if the results of the job or this program changed, or to remove a mark of mark_job_page(). Returns whether it
/// was written. Errors: InputError as in job_page(), or when the page cannot be written.
bool refresh_job_page(const JobFolder& files, StaleMark mark = StaleMark::removed);

/// Marks an existing page as stale, with `words` at its head. Errors: InputError when it cannot be written.
void mark_job_page(const JobFolder& files, const std::string& words);

/// Removes a page; a file of the user stays. Errors: InputError when it cannot be removed.
void remove_job_page(const JobFolder& files);

/// Removes a page that is damaged, marked, or does not belong to the results beside it. Errors: InputError when it cannot be removed.
void remove_old_job_page(const JobFolder& files);

}  // namespace dresslife::pipeline
