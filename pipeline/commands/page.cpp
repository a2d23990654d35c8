#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/job_page.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Writes the page of any folder that contains a job's results.
int page(const fs::path& folder) {
  JobFolder files{fs::weakly_canonical(folder).filename().string(), folder};
  if (kind_of(files.life()) == FileKind::absent)
    throw InputError({folder.string()}, "holds no life.h5", "name the folder of a job that is done: runs/STUDY/JOB");
  refresh_job_page(files);
  print(shown(files.page().string() + "\n"));
  return 0;
}

}  // namespace

Command page_command() {
  const auto folder = std::make_shared<fs::path>();
  return {"page",
          "write the page of one job: robot and dresspack in motion, its damage over place and time",
          {{"folder", "", "folder of its results: runs/STUDY/JOB", folder.get(), {.required = true}}},
          [folder] { return page(*folder); }};
}

}  // namespace dresslife::pipeline
