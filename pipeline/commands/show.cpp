#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/commands/as_json.h"
#include "pipeline/commands/options.h"
#include "pipeline/files/files.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/file_summary.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {
namespace {

struct ShowOptions {
  std::string file;
  std::vector<std::string> sets;
  bool json = false;
};

int show(const ShowOptions& options) {
  if (kind_of(options.file) == FileKind::folder) {
    print(shown(file_summary(job_files(options.file).life)));
    return 0;
  }
  if (is_dresslife_file(options.file)) {
    print(shown(file_summary(options.file)));
    return 0;
  }
  const std::string text = job_text(named_file(options.file, "jobs"), options.sets);
  print(options.json ? json_of(parse_yaml(text, options.file)).text + "\n" : text);
  return 0;
}

}  // namespace

Command show_command() {
  const auto options = std::make_shared<ShowOptions>();
  return {"show",
          "print a job with all its settings, or the content of an .h5 file (of a job's folder: life.h5)",
          {{"job", "", "JOB.yaml, FILE.h5, or a job's folder", &options->file, {.required = true}},
           {"--json", "", "print a job as JSON for other programs", &options->json},
           sets_option("override a key", options->sets)},
          [options] { return show(*options); }};
}

}  // namespace dresslife::pipeline
