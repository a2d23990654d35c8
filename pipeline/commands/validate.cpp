#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/validation_picture.h"
#include "pipeline/study/folder_lock.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

int validate(const RunOptions& options) {
  const ValidationStudy validation =
      read_observations(named_file(options.study, "observations"), options.sets);
  const StudyPlaces places{fs::path(options.out) / validation.study.name, program_folder()};
  const FolderLock lock(places.folder);
  const std::vector<RankingRow> rows = made_rows(validation.study, places, options);
  const std::string table = validation_table(validation, rows);
  write_text_if_changed(places.folder / "validation.md", with_mark(table, Mark::xml));
  write_text_if_changed(places.folder / "validation.svg",
                        with_mark(validation_picture(validation, rows), Mark::xml));
  print(shown(fmt::format("{}\nPicture: {}\n", table, (places.folder / "validation.svg").string())));
  return say_failures(options.study, rows);
}

}  // namespace

Command add_validate(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* words = program.add_subcommand(
      "validate", "hold observed lives of cables and wires against what the model says of the same tests");
  words->add_option("observations", options->study, "OBSERVATIONS.yaml")->required()->type_name("");
  add_run_options(*words, *options);
  add_study_options(*words, *options);
  return {words, [options] { return validate(*options); }};
}

}  // namespace dresslife::pipeline
