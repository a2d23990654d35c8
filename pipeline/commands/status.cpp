#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <memory>

#include "pipeline/commands/as_json.h"
#include "pipeline/commands/options.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

int status(const StudyOptions& options) {
  const StudyState standing = standing_study(request_of(options));
  std::size_t done = 0;
  JobList jobs(options.json);
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    const StudyJob& job = standing.study.jobs[k];
    const StateWords words =
        job.failure.empty() ? standing.states[k].words() : StateWords{"refused", first_problem(job)};
    done += standing.states[k].done();
    jobs.add(job.name, words);
  }
  jobs.end(shown(problem_words(standing.study)) +
           fmt::format("{} of {} jobs done\n", done, standing.study.jobs.size()));
  return 0;
}

}  // namespace

Command status_command() {
  const auto options = std::make_shared<StudyOptions>();
  return {"status", "print which jobs of a study are done, stale, failed, refused or to do",
          joined({{study_or_job(*options), json_option(options->json)}, study_options(*options)}),
          [options] { return status(*options); }};
}

}  // namespace dresslife::pipeline
