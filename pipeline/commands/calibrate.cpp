#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>

#include "pipeline/advise/calibrate/doubtful_rows.h"
#include "pipeline/advise/calibrate/learning.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/calibration_picture.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/folder_lock.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

int calibrate(const RunOptions& options) {
  const fs::path file = named_file(options.study, "observations");
  const std::vector<ObservedTest> tests = read_observed_tests(file);
  for (const Warning& warning : doubtful_rows(tests)) tell(shown(warning.line() + "\n"));
  const StudyPlaces places{fs::path(options.out) / ("calibrate_" + file.stem().string()), program_folder()};
  const FolderLock lock(places.folder);
  const Learned learned = learn(tests, options.sets, places,
                                [&](const Study& study) { return made_rows(study, places, options); });
  const std::string table = learned_table(learned);
  write_text_if_changed(places.folder / "calibration.yaml",
                        with_mark(to_yaml(echo_fields(learned.calibration)), Mark::yaml));
  write_text_if_changed(places.folder / "calibration.svg", with_mark(calibration_picture(learned), Mark::xml));
  print(shown(fmt::format("{}\nCalibration: {}\nPicture: {}\n", table,
                          (places.folder / "calibration.yaml").string(),
                          (places.folder / "calibration.svg").string())));
  return 0;
}

}  // namespace

Command calibrate_command() {
  const auto options = std::make_shared<RunOptions>();
  return {"calibrate",
          "learn what is not known of cables from lives that were observed; a job that names the result starts "
          "from it",
          joined({{{"observations", "", "OBSERVATIONS.yaml", &options->study, {.required = true}}},
                  run_options(*options), study_options(*options)}),
          [options] { return calibrate(*options); }};
}

}  // namespace dresslife::pipeline
