#include "pipeline/commands/command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "pipeline/cable/overlap.h"
#include "pipeline/cable/stiffness.h"
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
  if (!options.picture.empty()) check_replaceable(options.picture);
  const Dresspack dresspack = read_dresspack(named_file(options.dresspack, "dresspacks"));
  print(shown(construction_text(dresspack)));
  for (const Warning& warning : joined(overlap_warnings(dresspack), stiffness_warnings(dresspack)))
    tell(warning.line() + "\n");
  if (options.picture.empty()) return 0;
  write_picture(options.picture, cross_section_picture(dresspack));
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
