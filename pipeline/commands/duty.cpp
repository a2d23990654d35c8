#include <fmt/format.h>

#include <memory>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// The study that a file of duties names: by its name in the catalogue, or relative to the file.
fs::path study_of(const DutyFile& file) {
  const fs::path named = file.study;
  const bool is_path = named.extension() == ".yaml" && named.is_relative();
  return named_study((is_path ? folder_of(file.where) / named : named).string());
}

int duty(RunOptions options) {
  const fs::path name = named_file(options.study, "duties");
  const DutyFile file = read_duties(name);
  const StudyRequest request{study_of(file), options.sets, options.out, program_folder()};
  Standing standing = expanded(request);
  check_programs(file, standing.study);
  const FolderLock lock(standing.places.folder);
  look_again(standing);
  make_rest(request, standing, options);
  const std::vector<RankingRow> rows = ranking_of(standing.study, standing.places, standing.states);
  const std::vector<DutyResult> results = evaluated(file, standing.study, rows);
  const std::string csv = duty_csv(results);
  const fs::path table = standing.places.folder / ("duty_" + name.stem().string() + ".csv");
  write_text_if_changed(table, csv);
  print(options.json ? json_of_csv(csv).text + "\n"
                     : shown(fmt::format("{}\nTable: {}\n", duty_words(results), table.string())));
  if (!options.quiet) tell(warning_lines(rows_of(file, rows)));
  return 0;
}

}  // namespace

Command duty_command() {
  const auto options = std::make_shared<RunOptions>();
  return {"duty",
          "predict the life, or the remaining life, of a dresspack under several programs and their numbers of repeats",
          joined({{{"duties", "", "DUTIES.yaml", &options->study, {.required = true}}, json_option(options->json)},
                  run_options(*options), study_options(*options)}),
          [options] { return duty(*options); }};
}

}  // namespace dresslife::pipeline
