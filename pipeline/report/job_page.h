// The page of one job: robot and dresspack in motion, where and when the damage comes about, and what the
// numbers rest on. One HTML file of at most 5 MB for three minutes of motion, beside the results of the job.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Where the results of a job lie: motion.h5, strain.h5, life.h5 in its folder.
struct JobFolder {
  std::string name;  ///< of the job
  std::filesystem::path folder;

  std::filesystem::path motion() const { return folder / "motion.h5"; }
  std::filesystem::path strain() const { return folder / "strain.h5"; }
  std::filesystem::path life() const { return folder / "life.h5"; }
  std::filesystem::path page() const { return folder / "page.html"; }
};

/// The page as text. Without motion.h5 or strain.h5, which may have been cleared away, it shows what it can
/// and says what is missing. Errors: InputError when a file cannot be read or the files are not of one job.
std::string job_page(const JobFolder& files);

/// Writes the page of a job whose results have changed, or whose program has; leaves it alone otherwise.
/// Returns whether it was made. Errors: InputError as above, or when it cannot be written.
bool refresh_job_page(const JobFolder& files);

/// Lets the page of a last result say at its head that it is stale, in these words; a page that is not there
/// stays away. refresh_job_page() makes it again once there is a result of now. Errors: InputError when it
/// cannot be written.
void mark_job_page(const JobFolder& files, const std::string& words);

/// Removes a page; a file that is none of ours stays. Errors: InputError when it cannot be removed.
void remove_job_page(const JobFolder& files);

/// Removes a page that is not of the results that lie beside it, or damaged. Errors: as above.
void remove_old_job_page(const JobFolder& files);

}  // namespace dresslife::pipeline
