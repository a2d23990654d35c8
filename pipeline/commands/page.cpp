#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/job_page.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Writes the page of any folder that contains a job's results.
int page(const fs::path& folder) {
  JobFolder files{fs::weakly_canonical(folder).filename().string(), folder};
  life_in(folder);  // refuses a folder without it
  if (state_of(files.page()).exists() && !is_ours(files.page()) && !replaces_files_of_others())
    throw InputError({files.page().string()}, "is there already and was not written by dresslife",
                     "move it away, or replace it with --force");
  refresh_job_page(files, StaleMark::kept);
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
