#include "pipeline/study/study_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "pipeline/base/joined.h"
#include "pipeline/base/text.h"
#include "pipeline/job/job.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

std::string first_problem(const StudyJob& job) {
  const std::vector<std::string> lines = parts_between(job.failure, "\n");
  return lines.size() == 1
             ? job.failure
             : fmt::format("{} (and {} more problems, listed below the jobs)", lines.front(), lines.size() - 1);
}

std::string problem_words(const Study& study) {
  constexpr std::size_t named = 3;
  std::vector<std::string> lines;
  std::map<std::string, std::vector<std::string>> jobs_of;
  for (const StudyJob& job : study.jobs)
    for (const std::string& line :
         job.failure.empty() ? std::vector<std::string>{} : parts_between(job.failure, "\n")) {
      std::vector<std::string>& jobs = jobs_of[line];
      if (jobs.empty()) lines.push_back(line);
      jobs.push_back(job.name);
    }
  const bool complete = std::ranges::all_of(study.jobs, [&](const StudyJob& job) {
    return job.failure.empty() || (parts_between(job.failure, "\n").size() == 1 && jobs_of[job.failure].size() == 1);
  });
  if (complete) return "";
  std::string text;
  for (const std::string& line : lines) {
    const std::vector<std::string>& jobs = jobs_of[line];
    const std::vector<std::string> first(jobs.begin(), jobs.begin() + std::min(jobs.size(), named));
    text += line;
    if (study.jobs.size() > 1)
      text += fmt::format(" ({}{}{})", jobs.size() > 1 ? fmt::format("{} jobs: ", jobs.size()) : "job ",
                          joined(first, ", "), jobs.size() > named ? ", ..." : "");
    text += '\n';
  }
  return text;
}

void refuse_without_wires(const Where& where, const std::string& job) {
  throw InputError(
      where, fmt::format("job '{}' has no wires, and this command compares lives of wires", job),
      "describe a cable by its data sheet (config/README.md), or leave the job out; dresslife run predicts the "
      "other failure modes");
}

void require_wires(const Study& study, const Where& where) {
  for (const StudyJob& job : study.jobs)
    if (job.job && std::ranges::none_of(job.job.with(Piece::rest).dresspacks,
                                        [](const MountedDresspack& mounted) { return has_wires(mounted.dresspack); }))
      refuse_without_wires(where, job.name);
}

}  // namespace dresslife::pipeline
