#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>

#include "pipeline/advise/calibrate/law_tests.h"
#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/observation_pictures.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Compares laws with published tests, at once and without jobs.
int validate_laws(const fs::path& file, const RunOptions& options) {
  const std::string table = law_table(read_law_tests(file));
  const OwnFolder own(options, "validate_" + file.stem().string(), file);
  write_text_if_changed(own.places.folder / "validation.md", with_mark(table, Mark::xml));
  print(shown(table));
  return 0;
}

int validate(const RunOptions& options) {
  const fs::path file = named_file(options.study, "observations");
  if (holds_law_tests(file)) return validate_laws(file, options);
  const ValidationStudy validation = read_observations(file, options.sets);
  for (const Warning& warning : validation.doubts) write_stderr(shown(warning.paragraph()));
  const OwnFolder own(options, validation.study.name, file);
  const StudyPlaces& places = own.places;
  const std::vector<RankingRow> rows = made_rows(validation.study, places, options);
  const std::string table = validation_table(validation, rows);
  write_text_if_changed(places.folder / "validation.md", with_mark(table, Mark::xml));
  write_text_if_changed(places.folder / "validation.svg", with_mark(validation_picture(validation, rows), Mark::xml));
  print(shown(fmt::format("{}\nPicture: {}\n", table, (places.folder / "validation.svg").string())));
  return say_failures(options.study, rows);
}

}  // namespace

Command validate_command() {
  const auto options = std::make_shared<RunOptions>();
  return {"validate", "compare observed lives of cables and wires with the model's predictions of the same tests",
          joined({{{"observations", "", "OBSERVATIONS.yaml", &options->study, {.required = true}}},
                  run_options(*options),
                  study_options(*options)}),
          [options] { return validate(*options); }};
}

}  // namespace dresslife::pipeline
