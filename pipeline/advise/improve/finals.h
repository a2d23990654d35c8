// Runs the best candidates and the original jobs again and keeps all their files.
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
  Merit merit{};                               ///< as drawn
  std::optional<WithinTolerance> tolerance{};  ///< absent: not evaluated
};

struct Finals {
  Study study;
  std::vector<Final> of;  ///< the original jobs first
  std::vector<RankingRow> rows;

  const Final* best_drawn() const;  ///< of the candidates, by merit; null: there is none
  /// Of the candidates by merit within the tolerance, if evaluated.
  const Final* best() const;
  /// Whether the candidate is clearly better than the original jobs, within the tolerance if both were evaluated.
  bool is_gain(const Final& candidate) const;
  /// Of the worst of its jobs; null: none is done.
  const RankingRow* worst_row(const Final& of) const;
};

/// With two objectives the whole Pareto front, with one the best few.
Finals finals_of(const Improvement& found, const ImproveRequest& request, const MakeRows& make_rows);

/// Evaluates the finalists within the mounting tolerance (T1), and the original jobs if they may be better there; with two objectives
/// the best by merit only.
void judge(Finals& finals, const Improvement& found, const ImproveRequest& request,
           const MountingTolerance& tolerance, const StudyPlaces& places, const MakeRows& make_rows,
           const ToleranceProgress& progress = {});

/// Share of samples in which the wires of the worst job of `best` live longer than those of the worst original job; absent
/// where nothing is uncertain.
std::optional<double> share_longer(const Finals& finals, const Final& best, const StudyPlaces& places);

/// Whether a row is of one of these jobs.
bool is_of(const RankingRow& row, const std::vector<std::string>& jobs);

}  // namespace dresslife::pipeline
