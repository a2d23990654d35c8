#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>

#include "pipeline/advise/calibrate/doubtful_rows.h"
#include "pipeline/advise/calibrate/learning.h"
#include "pipeline/advise/calibrate/service_records.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/observation_pictures.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct CalibrateOptions : RunOptions {
  std::string job, since, today;
};

/// Reads the tests from a table of a maintenance system (CSV) or from a file of observations.
ServiceTests tests_of(const CalibrateOptions& options, const fs::path& file) {
  if (file.extension() != ".csv" && file.extension() != ".CSV") {
    for (const auto& [option, text] :
         {std::pair{"--job", &options.job}, {"--records-since", &options.since}, {"--today", &options.today}})
      if (!text->empty())
        throw InputError({option},
                         fmt::format("is of a maintenance system's table (.csv), not of {}", file.filename().string()),
                         "leave it out");
    return {read_observed_tests(file), ""};
  }
  std::optional<Day> since;
  if (!options.since.empty()) since = day_of("--records-since", options.since);
  const Day today = options.today.empty() ? pipeline::today() : day_of("--today", options.today);
  if (since && *since > today)
    throw InputError({"--records-since"}, fmt::format("{} is after today, {}", options.since, day_text(today)),
                     "correct it");
  return read_service_tests({file, options.job, since, today, options.sets});
}

int calibrate(const CalibrateOptions& options) {
  const fs::path file = named_file(options.study, "observations");
  const auto [tests, words] = tests_of(options, file);
  for (const Warning& warning : doubtful_rows(tests)) write_stderr(shown(warning.paragraph()));
  if (!words.empty()) write_stderr(words);  // printed before hours of computation
  const OwnFolder own(options, "calibrate_" + file.stem().string(), file);
  const StudyPlaces& places = own.places;
  const Learned learned =
      learn(tests, options.sets, places, [&](const Study& study) { return made_rows(study, places, options); });
  const std::string table = learned_table(learned);
  write_text_if_changed(places.folder / "calibration.yaml",
                        with_mark(to_yaml(echo_fields(learned.calibration)), Mark::yaml));
  write_text_if_changed(places.folder / "calibration.svg", with_mark(calibration_picture(learned), Mark::xml));
  print(shown(fmt::format("{}\nCalibration: {}\nPicture: {}\n", table, (places.folder / "calibration.yaml").string(),
                          (places.folder / "calibration.svg").string())));
  return 0;
}

}  // namespace

Command calibrate_command() {
  const auto options = std::make_shared<CalibrateOptions>();
  return {
      "calibrate",
      "narrow the uncertain parameters by observed lives or by a maintenance system's table of dresspacks; "
      "a job names the result as its calibration",
      joined(
          {{{"observations", "", "OBSERVATIONS.yaml or RECORDS.csv", &options->study, {.required = true}},
            {"--job", "JOB.yaml",
             "of the dresspacks in the table, unless its column job names one; default: the only job in its folder",
             &options->job},
            {"--records-since", "DATE",
             "the first day from which the table has every removal; default: that of its first removal, which does not count then",
             &options->since},
            {"--today", "DATE", "the day of the table; default: the computer's date", &options->today}},
           run_options(*options),
           study_options(*options)}),
      [options] { return calibrate(*options); }};
}

}  // namespace dresslife::pipeline
