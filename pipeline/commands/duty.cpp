#include <fmt/format.h>

#include <memory>

#include "pipeline/advise/plan/doubtful_plan.h"
#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/duty_words.h"
#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/duties_run.h"
#include "pipeline/report/duty_page.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

int duty(const RunOptions& options) {
  const fs::path name = named_file(options.study, "duties");
  const DutyFile file = read_duties(name);
  for (const Warning& warning : doubtful_duties(file)) write_stderr(shown(warning.paragraph()));
  const DutiesRun made = run_duties(file, options);
  const std::vector<DutyResult> results = evaluated(file, made.study, made.rows);
  const fs::path table = made.places.folder / ("duty_" + name.stem().string() + ".csv");
  write_text_if_changed(table, csv_text(duty_table(results)));
  const fs::path page = made.places.folder / ("duty_" + name.stem().string() + ".html");
  write_text_if_changed(page,
                        with_mark(duty_page(name.stem().string(), results, table.filename().string()), Mark::page));
  print(options.json ? json_of(results, made.rows).text + "\n"
                     : shown(fmt::format("{}\nTable: {} (columns: comma, decimals: point)\nPage: {}\n",
                                         duty_words(results), table.string(), page.string())));
  write_stderr(warning_lines(rows_of(file, made.rows)));
  return 0;
}

}  // namespace

Command duty_command() {
  const auto options = std::make_shared<RunOptions>();
  return {"duty",
          "predict the life, or the remaining life, of a dresspack under several programs and their numbers of repeats",
          joined({{{"duties", "", "DUTIES.yaml", &options->study, {.required = true}}, json_option(options->json)},
                  run_options(*options),
                  study_options(*options)}),
          [options] { return duty(*options); }};
}

}  // namespace dresslife::pipeline
