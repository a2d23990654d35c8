#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>
#include <set>

#include "pipeline/base/plain_file.h"
#include "pipeline/base/readable.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/job_folder.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

int clean(const StudyOptions& options) {
  const StudyRequest request = request_of(options);
  const fs::path folder = folder_of_results(request, options);
  const FolderLock lock(folder);
  check_source(folder, request.file);
  const StudyState standing = expanded(request);
  std::uintmax_t freed = 0;
  std::set<std::string> jobs;
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    jobs.insert(standing.study.jobs[k].name);
    freed += remove_unkept(standing.states[k], standing.places.job(standing.study.jobs[k].name));
  }
  std::size_t others = 0;
  for (const fs::path& entry : entries_of(folder))
    if (!jobs.contains(entry.filename().string()) && is_job_folder(entry)) freed += remove_job(entry), ++others;
  constexpr double megabyte = 1e6;
  print(shown(fmt::format("{}: {} MB freed, {} jobs that the study has no more\n", folder.string(),
                          readable(static_cast<double>(freed) / megabyte), others)));
  return 0;
}

}  // namespace

Command clean_command() {
  const auto options = std::make_shared<StudyOptions>();
  return {"clean", "remove what a study does not keep (its key keep), and the results of jobs that it has no more",
          joined({{study_or_job(*options)}, study_options(*options)}), [options] { return clean(*options); }};
}

}  // namespace dresslife::pipeline
