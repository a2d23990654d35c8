#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>

#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/rate.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns the rows without warnings about bend radius and twist: a rig prescribes both.
std::vector<RankingRow> doubtful(std::vector<RankingRow> rows) {
  for (RankingRow& row : rows)
    if (row.warnings)
      std::erase_if(*row.warnings, [](const Warning& warning) {
        return warning.kind == WarningKind::bend_radius || warning.kind == WarningKind::twist;
      });
  return rows;
}

int rate(const RunOptions& options) {
  const fs::path file = named_file(options.study, "dresspacks");
  const RateStudy rated = rate_study(file, shipped_catalogue() / "rigs", options.sets);
  const OwnFolder own(options, rated.study.name, file);
  const StudyPlaces& places = own.places;
  const std::vector<RankingRow> rows = made_rows(rated.study, places, options);
  write_text_if_changed(places.folder / "rate.csv", rate_csv(rated, rows));
  print(shown(rate_table(rated, rows)));
  if (!rated.estimates.empty()) print(shown(paragraph(estimate_line("", rated.estimates))));
  print(shown(fmt::format("\nTable: {}\n", (places.folder / "rate.csv").string())));
  write_stderr(shown(warning_lines(doubtful(rows))));
  write_stderr(shown(problem_words(rated.study)));
  return say_failures(options.study, rows);
}

}  // namespace

Command rate_command() {
  const auto options = std::make_shared<RunOptions>();
  return {"rate",
          "print how many cycles a cable, or each of a dresspack's, lives in the standard test rigs, beside its "
          "ratings",
          joined({{{"cable", "", "DRESSPACK.yaml", &options->study, {.required = true}}},
                  run_options(*options),
                  study_options(*options)}),
          [options] { return rate(*options); }};
}

}  // namespace dresslife::pipeline
