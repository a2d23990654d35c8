#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "pipeline/advise/calibrate/doubtful_rows.h"
#include "pipeline/advise/calibrate/learning.h"
#include "pipeline/advise/calibrate/service_records.h"
#include "pipeline/base/exported.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/report/observation_pictures.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct CalibrateOptions : RunOptions {
  std::vector<std::string> files;
  std::string job, since, today;
};

bool is_table(const fs::path& file) { return file.extension() == ".csv" || file.extension() == ".CSV"; }

/// Reads the tests from a table of a maintenance system (CSV) or from a file of observations.
ServiceTests tests_of(const CalibrateOptions& options, const fs::path& file) {
  if (!is_table(file)) return {read_observed_tests(file), ""};
  std::optional<Day> since;
  if (!options.since.empty()) since = day_of("--records-since", options.since);
  const Day today = options.today.empty() ? pipeline::today() : day_of("--today", options.today);
  if (since && *since > today)
    throw InputError({"--records-since"}, fmt::format("{} is after today, {}", options.since, day_text(today)),
                     "correct it");
  return read_service_tests({file, options.job, since, today, options.sets});
}

/// Reads the tests of all files. A test whose name an earlier file has gets the name of its own file, too.
ServiceTests tests_of(const CalibrateOptions& options, const std::vector<fs::path>& files) {
  if (std::ranges::none_of(files, is_table))
    for (const auto& [option, text] :
         {std::pair{"--job", &options.job}, {"--records-since", &options.since}, {"--today", &options.today}})
      if (!text->empty())
        throw InputError(
            {option},
            fmt::format("is of a maintenance system's table (.csv), not of {}", files.front().filename().string()),
            "leave it out");
  ServiceTests all;
  std::set<std::string> names;
  for (const fs::path& file : files) {
    ServiceTests of_file = tests_of(options, file);
    const bool typical = std::ranges::any_of(of_file.tests, &ObservedTest::typical);
    if (typical && files.size() > 1)
      throw InputError({file.string()}, "is of typical cables, whose tests cannot be joined with tests of one cable",
                       "calibrate with it alone");
    if (files.size() > 1 && !of_file.words.empty()) all.words += file.filename().string() + "\n";
    all.words += of_file.words;
    for (ObservedTest& test : of_file.tests) {
      if (names.contains(test.observation.name)) test.observation.name += ", " + file.stem().string();
      if (!names.insert(test.observation.name).second)
        throw InputError(test.where, fmt::format("'{}' is in two files", test.observation.name), "give one file");
      all.tests.push_back(std::move(test));
    }
  }
  return all;
}

int calibrate(const CalibrateOptions& options) {
  const std::vector<fs::path> files =
      mapped(options.files, [](const std::string& name) { return named_file(name, "observations"); });
  const fs::path& file = files.front();
  const auto [tests, words] = tests_of(options, files);
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
      "narrow the uncertain parameters by observed lives, tests and maintenance systems' tables of dresspacks; "
      "a job names the result as its calibration",
      joined(
          {{{"observations", "", "OBSERVATIONS.yaml or RECORDS.csv, one or more", &options->files, {.required = true}},
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
