#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct PreviewOptions {
  std::string job, page;
  std::vector<std::string> sets;
};

/// Writes the page of a job before its run and prints the results of a check. A refused job also gets a page: exit
/// status 0 means that the page was written.
int preview(const PreviewOptions& options) {
  const fs::path job = named_file(options.job, "jobs");
  const fs::path page = options.page.empty() ? fs::path(job.stem().string() + "_preview.html") : fs::path(options.page);
  check_replaceable(page);
  const PassingFile file("preview.h5");
  const JobCheck check = check_of(job, options.sets, file.path());
  // the stage prints the error
  if (kind_of(file.path()) != FileKind::file) return print_preview(job, options.sets, {}, file.path());
  write_text_if_changed(page, preview_page(file.path(), job.stem().string(), xxh3(shell_digest())));
  print_check(check);
  print(shown("Preview: " + page.string() + "\n"));
  return 0;
}

}  // namespace

Command preview_command() {
  const auto options = std::make_shared<PreviewOptions>();
  return {"preview",
          "show a job before its run: robot, clamps and dresspack over the program, which lengths suit, and what "
          "is refused",
          {{"job", "", "JOB.yaml", &options->job, {.required = true}},
           {"-o,--output", "FILE.html", "page to write (HTML); else JOB_preview.html here", &options->page},
           sets_option("override a key", options->sets)},
          [options] { return preview(*options); }};
}

}  // namespace dresslife::pipeline
