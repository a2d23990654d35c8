#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/rate.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

int rate(const RunOptions& options) {
  const RateStudy rated =
      rate_study(named_file(options.study, "dresspacks"), shipped_catalogue() / "rigs", options.sets);
  const StudyPlaces places{fs::path(options.out) / rated.study.name, program_folder()};
  const FolderLock lock(places.folder);
  const std::vector<RankingRow> rows = made_rows(rated.study, places, options);
  write_text_if_changed(places.folder / "rate.csv", rate_csv(rated, rows));
  print(
      shown(fmt::format("{}\nTable: {}\n", rate_table(rated, rows), (places.folder / "rate.csv").string())));
  return say_failures(options.study, rows);
}

}  // namespace

Command add_rate(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* words = program.add_subcommand(
      "rate",
      "tell how many cycles a cable, or each of a dresspack's, lives in the standard test rigs, beside its "
      "ratings");
  words->add_option("cable", options->study, "DRESSPACK.yaml")->required()->type_name("");
  add_run_options(*words, *options);
  add_study_options(*words, *options);
  return {words, [options] { return rate(*options); }};
}

}  // namespace dresslife::pipeline
