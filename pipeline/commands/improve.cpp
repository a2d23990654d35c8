#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "pipeline/advise/improve/finals.h"
#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/story.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/progress.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/study/folder_lock.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct Options : RunOptions {
  ImproveRequest request;
  std::string method = "surrogate", second = "none";
  double off_mm = 10;
};

int improve_study(Options options) {
  options.request.file = named_study(options.study);
  options.request.sets = options.sets;
  const std::string name = study_name(options.request.file);
  const StudyPlaces places{fs::path(options.out) / (name + "_improve"), program_folder()};
  const FolderLock lock(places.folder);
  RunOptions quiet = options;
  quiet.quiet = true;
  Progress progress(name, options.quiet);
  const TrialMakers makers{
      [&](const Study& study) { return made_rows(study, places, quiet); },
      [&](const Improvement& so_far) {
        const std::optional<std::size_t> best = so_far.best();
        progress.show(
            fmt::format("{}/{}  best {}", so_far.trials.size(), options.request.trials,
                        best ? hours_text(so_far.trials[*best].worst.hours) : "none within the limits"));
      }};
  const Improvement found = improve(options.request, places, makers);
  progress.clear();
  write_text_if_changed(places.folder / "improve.csv", improvement_csv(found));
  const MakeRows make_rows = [&](const Study& study) { return made_rows(study, places, options); };
  const Finals finals = finals_of(found, options.request, make_rows);
  const bool all_written = write_results(finals.study, places, finals.rows).empty();
  const double off = options.off_mm / 1000;
  const ImprovementStory story = story_of(found, finals, options.request, off, places, make_rows);
  write_text_if_changed(places.folder / "improve.html", with_mark(improvement_page(story), Mark::page));
  print(shown(improvement_words(found, finals, story, options.request.second, off, places)));
  print(shown(fmt::format("Trials: {}\nReport: {}\n", (places.folder / "improve.csv").string(),
                          (places.folder / "improve.html").string())));
  const int failed = say_failures(options.study, finals.rows);
  return failed != 0 || finals.of.size() == 1 || !all_written ? 1 : 0;
}

template <class Enum>
Enum value_of(const std::string& text, std::initializer_list<Enum> values) {
  for (const Enum value : values)
    if (text == word(value)) return value;
  throw std::logic_error("the command line let '" + text + "' through");
}

}  // namespace

Command add_improve(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* words = program.add_subcommand(
      "improve", "search for jobs that live longer: keys that are freed, under the limits of the checks");
  words
      ->add_option("study", options->study,
                   "STUDY.yaml with `free`, or JOB.yaml whose clamps and length are then free")
      ->required()
      ->type_name("");
  words
      ->add_option(
          "--free", options->request.frees,
          "free a key: 'LOW .. HIGH', 'SPREAD around', 'ANGLE deg around', 'LOW .. HIGH along LINK' or '[A, B]'; "
          "may be repeated")
      ->type_name("KEY.PATH=RANGE")
      ->allow_extra_args(false);
  words->add_option("--trials", options->request.trials, "jobs to try, or sets of all the study's jobs")
      ->check(CLI::Range(2, 100'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words
      ->add_option("--at-a-time", options->request.at_a_time,
                   "trials that are thought of together; another number, another search")
      ->check(CLI::Range(1, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  words->add_option("--seed", options->request.seed, "of the search's chances")
      ->check(CLI::Range(0, 1'000'000'000))
      ->type_name("NUMBER")
      ->capture_default_str();
  words
      ->add_option(
          "--rehearsals", options->request.rehearsals,
          "short runs before the first trial, at most; each trial adds a few; 0: none; -1: 40 for each variable")
      ->check(CLI::Range(-1, 100'000))
      ->type_name("COUNT")
      ->capture_default_str();
  words
      ->add_option("--method", options->method,
                   "models of lives and limits, or chance alone to hold against it")
      ->check(CLI::IsMember({"surrogate", "random"}))
      ->type_name("surrogate|random")
      ->capture_default_str();
  words->add_option("--second", options->second, "a second aim, to be small: the answer is the front of both")
      ->check(CLI::IsMember({"none", "hose_length", "cycle_time"}))
      ->type_name("none|hose_length|cycle_time")
      ->capture_default_str();
  words
      ->add_option("--off", options->off_mm,
                   "what a clamp or the length may be off by: told of the best job; 0: not asked")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  add_run_options(*words, *options);
  add_launcher(*words, *options);
  add_study_options(*words, *options);
  return {
      words, [options] {
        options->request.method = value_of(options->method, {SearchMethod::surrogate, SearchMethod::random});
        options->request.second =
            value_of(options->second, {SecondAim::none, SecondAim::hose_length, SecondAim::cycle_time});
        return improve_study(*options);
      }};
}

}  // namespace dresslife::pipeline
