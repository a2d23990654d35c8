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
  const std::filesystem::path file =
      kind_of(options.file) == FileKind::folder ? life_in(options.file) : std::filesystem::path(options.file);
  if (file != options.file || is_dresslife_file(file)) {
    if (options.json || !options.sets.empty())
      throw InputError({options.file}, "is no job, so --json and --set have no effect",
                       "leave them out, or name a job");
    print(shown(file_summary(file)));
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
