#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/cable/excess.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/pictures.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {
namespace {

struct DrawOptions {
  std::string dresspack, picture;
};

int draw(const DrawOptions& options) {
  if (!options.picture.empty()) check_picture(options.picture);
  std::string faults;
  const Dresspack dresspack = read_dresspack(named_file(options.dresspack, "dresspacks"), faults);
  if (!faults.empty()) {  // the picture marks the parts that do not fit
    if (!options.picture.empty()) write_picture(options.picture, cross_section_picture(dresspack));
    write_stderr(faults + "\n");
    return 1;
  }
  print(shown(construction_text(dresspack)));
  if (!dresspack.estimates.empty()) print(shown(paragraph(estimate_line("", dresspack.estimates))));
  for (const Warning& warning : construction_warnings(dresspack, true)) write_stderr(warning.paragraph());
  if (!options.picture.empty()) write_picture(options.picture, cross_section_picture(dresspack));
  return 0;
}

}  // namespace

Command draw_command() {
  const auto options = std::make_shared<DrawOptions>();
  return {"draw",
          "list a dresspack's layers and what they add up to, and draw its cross-section to scale",
          {{"dresspack", "", "DRESSPACK.yaml, or a job with one dresspack", &options->dresspack, {.required = true}},
           {"-o,--output", "FILE", "picture to write, .svg or .png", &options->picture}},
          [options] { return draw(*options); }};
}

}  // namespace dresslife::pipeline
