#include "pipeline/commands/command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "pipeline/cable/excess.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/pictures.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {
namespace {

struct Options {
  std::string dresspack, picture;
};

int draw(const Options& options) {
  if (!options.picture.empty()) check_picture(options.picture);
  std::string faults;
  const Dresspack dresspack = read_dresspack(named_file(options.dresspack, "dresspacks"), faults);
  if (!faults.empty()) {  // the picture marks what does not fit
    if (!options.picture.empty()) write_picture(options.picture, cross_section_picture(dresspack));
    tell(faults + "\n");
    return 1;
  }
  print(shown(construction_text(dresspack)));
  for (const Warning& warning : construction_warnings(dresspack, true)) tell(warning.line() + "\n");
  if (!options.picture.empty()) write_picture(options.picture, cross_section_picture(dresspack));
  return 0;
}

}  // namespace

Command add_draw(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* words = program.add_subcommand(
      "draw", "list a dresspack's layers and what they add up to, and draw its cross-section to scale");
  words->add_option("dresspack", options->dresspack, "DRESSPACK.yaml")->required()->type_name("");
  words->add_option("-o,--output", options->picture, "picture to write, .svg or .png")->type_name("FILE");
  return {words, [options] { return draw(*options); }};
}

}  // namespace dresslife::pipeline
