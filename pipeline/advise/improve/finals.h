// Runs the best candidates and the original jobs again and keeps all their files.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/advise/improve/improvement.h"
#include "pipeline/advise/improve/tolerance.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Runs the stages of a study that are not up to date. Returns its rows.
using MakeRows = std::function<std::vector<RankingRow>(const Study&)>;

/// The jobs with one set of changes.
struct Final {
  std::vector<std::string> jobs;  ///< names
  double hours = 0;               ///< p10 life of the worst job
  std::size_t trial = 0;
  Merit merit{};                               ///< merit without offsets by the mounting tolerance
  std::optional<WithinTolerance> tolerance{};  ///< absent: not evaluated
  /// exceeds_more() than the original jobs, without offsets: cases within the tolerance do not know their shares
  bool exceeds_more = false;
};

struct Finals {
  Study study;
  std::vector<Final> of;  ///< the original jobs first
  std::vector<RankingRow> rows;

  const Final* best_drawn() const;  ///< best candidate by `merit`; null: no candidate
  /// Returns the best candidate by its merit within the tolerance, if this was evaluated; one that exceeds limits at other values
  /// more often only if all do. Null: no candidate.
  const Final* best() const;
  /// Returns whether the candidate is clearly better than the original jobs, within the tolerance if both were evaluated, and does
  /// not exceed limits at other values more often.
  bool is_gain(const Final& candidate) const;
  /// Returns whether a mode gets worse by the candidate, so that it is no gain although it keeps more limits.
  bool fails_earlier(const Final& candidate) const;
  /// Returns the row of the worst of its jobs; null: none is done.
  const RankingRow* worst_row(const Final& of) const;

 private:
  /// Returns the merits of the candidate and of the original jobs, within the tolerance if both were evaluated.
  std::pair<Merit, Merit> compared(const Final& candidate) const;
};

/// Runs the finalists and the original jobs: with two objectives the whole Pareto front, with one objective the best few. Takes
/// the motions and strains of their trials.
Finals finals_of(const Improvement& found, const ImproveRequest& request, const MakeRows& make_rows);

/// Removes the files of trials that the search does not keep. during_search: except those that finals_of() may take.
void remove_trial_files(const Improvement& found, const StudyPlaces& places, bool during_search);

/// Evaluates the finalists within the mounting tolerance (T1), and the original jobs if they may be better within it. With two
/// objectives evaluates only the best by merit.
void judge(Finals& finals, const Improvement& found, const ImproveRequest& request, const MountingTolerance& tolerance,
           const StudyPlaces& places, const MakeRows& make_rows, const ToleranceProgress& progress = {});

/// Returns the share of samples in which the wires of the worst job of `best` live longer than those of the worst original job;
/// absent if no input is uncertain.
std::optional<double> share_longer(const Finals& finals, const Final& best, const StudyPlaces& places);

}  // namespace dresslife::pipeline
