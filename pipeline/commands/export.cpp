#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/paraview.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string job, xdmf;
};

int export_job(const ExportOptions& options) {
  const fs::path file = options.xdmf;
  if (file.extension() != ".xdmf")
    throw InputError({file.string()}, "is no .xdmf", "name the file accordingly: ParaView goes by it");
  check_replaceable(file, "name another file with --paraview");
  write_text_if_changed(file, with_mark(xdmf_text(job_files(options.job), file), Mark::xml));
  return 0;
}

}  // namespace

Command export_command() {
  const auto options = std::make_shared<ExportOptions>();
  return {"export",
          "write a job's motion and results for ParaView (5.11 or newer), which plays them in 3D",
          {{"job", "", "the job's folder, or one of its .h5 files", &options->job, {.required = true}},
           {"--paraview",
            "FILE.xdmf",
            "file to write; it names the .h5 files, which must stay. Of ParaView's three readers only 'XDMF "
            "Reader' reads parts of their tables",
            &options->xdmf,
            {.required = true}}},
          [options] { return export_job(*options); }};
}

}  // namespace dresslife::pipeline
