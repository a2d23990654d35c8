#include "pipeline/advise/improve/screened.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/advise/improve/outcome.h"
#include "pipeline/base/stage_failed.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {

double ScreenedCandidate::violation() const { return sum_above_zero(beyond); }

std::string ScreenedList::words(const ScreenedCandidate& candidate) const {
  std::string text;
  for (std::size_t k = 0; k < limits.size(); ++k)
    if (candidate.beyond[k] > 0)
      text +=
          fmt::format("{}{} by {}", text.empty() ? "" : ", ", limits[k], passed_text(limits[k], candidate.beyond[k]));
  return text;
}

ScreenedList read_screening(const std::filesystem::path& path) {
  const FileReader file(path, screening_format());
  ScreenedList list;
  list.limits = file.read<std::string>("/limit/name");
  list.motion = file.text_attribute("motion");
  const auto changes = file.read<std::string>("/candidate/changes"),
             refusals = file.read<std::string>("/candidate/refusal");
  const auto rejected = file.read<std::int32_t>("/candidate/rejected");
  const auto beyond = file.read<double>("/candidate/beyond");
  std::vector<double> bends;
  if (file.has("/candidate/bend")) bends = file.read<double>("/candidate/bend");
  const std::size_t limits = list.limits.size(), bends_each = file.length("bend");
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const auto first = beyond.begin() + static_cast<std::ptrdiff_t>(k * limits);
    list.candidates.push_back({changes[k], refusals[k], rejected[k] != 0,
                               std::vector<double>(first, first + static_cast<std::ptrdiff_t>(limits))});
    if (bends.empty() || !refusals[k].empty()) continue;
    const auto bend = bends.begin() + static_cast<std::ptrdiff_t>(k * bends_each);
    list.candidates.back().bends.assign(bend, bend + static_cast<std::ptrdiff_t>(bends_each));
  }
  return list;
}

ScreenedList screening_of(const Job& job, const std::string& candidates, ScreenedBy by,
                          std::optional<double> longest_bracket, const std::filesystem::path& folder) {
  const std::filesystem::path draft = folder / "screened.yaml", list = folder / "candidates.yaml";
  write_text_if_changed(draft, with_mark(job_text(job), Mark::yaml), Sync::never);
  write_text_if_changed(list, with_mark(candidates, Mark::yaml), Sync::never);
  const PassingFile screening("screening.h5");
  std::vector<std::string> arguments{draft.string(), "--screen", list.string(), "-o", screening.path().string(),
                                     "--quiet"};
  if (longest_bracket) arguments.insert(arguments.end(), {"--bracket", fmt::format("{:.6g}", 1e3 * *longest_bracket)});
  if (by == ScreenedBy::short_runs) arguments.push_back("--by-short-runs");
  if (run_stage_program("dresslife-sim", arguments) != 0)
    throw StageFailed({draft.string()}, "cannot be screened (see above)", "correct the errors above");
  return read_screening(screening.path());
}

}  // namespace dresslife::pipeline
