// The best of what a search tried, run once more with all their files kept, beside the jobs as they are.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/tolerance.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Runs what is not up to date of a study.
using MakeRows = std::function<std::vector<RankingRow>(const Study&)>;

/// Of the jobs with one set of changes.
struct Final {
  std::vector<std::string> jobs;  ///< names
  double hours = 0;               ///< of the worst, p10
  std::size_t trial = 0;
  std::optional<WithinTolerance> tolerance{};  ///< absent: it was not judged by that
};

struct Finals {
  Study study;
  std::vector<Final> of;  ///< the jobs as they are first
  std::vector<RankingRow> rows;

  const Final* longest() const;  ///< longest life of what was changed; null: nothing was
  const Final* best() const;     ///< longest life within the tolerance, if that was judged
  /// Of the worst of its jobs; null: none is done.
  const RankingRow* worst_row(const Final& of) const;
};

/// Of two aims the whole front, of one the best few.
Finals finals_of(const Improvement& found, const ImproveRequest& request, const MakeRows& make_rows);

/// Judges the finalists by their life with a clamp, a ring or the length off by `off` [m] (T1); of two aims the longest
/// life alone.
void judge(Finals& finals, const Improvement& found, const ImproveRequest& request, double off,
           const StudyPlaces& places, const MakeRows& make_rows);

/// Share of draws in which the worst job of `best` lives longer than that of the jobs as they are; absent
/// where nothing is uncertain.
std::optional<double> share_longer(const Finals& finals, const Final& best, const StudyPlaces& places);

/// Whether a row is of one of these jobs.
bool is_of(const RankingRow& row, const std::vector<std::string>& jobs);

}  // namespace dresslife::pipeline
