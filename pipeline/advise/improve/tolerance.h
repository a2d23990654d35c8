// Selection of the best routing within the mounting tolerance.
//
// (T1) m_w = min(m, m_1, ..., m_n)   m: merit (merit.h) without offset; m_i: merit with one offset by the tolerance, of a clamp,
//                                    a ring, a length or the turn of the end (nudges.h); the least merit if the job does not run
// (T2) t_i ~ t q_i / q               t: life in a full run; q: life in a run without uncertain inputs, which takes 0.12 to 0.37
//                                    of the time; i: with offset i
//
// A run without uncertain inputs has the limits of the full run, because limits are those of the job's own values. Lives by modes
// without a validated law have the same ratio t_i / t in both (measured for jacket wear and abrasion). So (T2) estimates only the
// wires' life. Its error (a factor of 1.6, rms) is smaller than the numerical error of a p10 (1.9 to 2.3).
// First all m_i are estimated. Then the two with the shortest life of the wires run in full, among those with the worst limits or
// modes, and more until the shortest life is that of a full run.
// The finalist with the largest m_w so far is evaluated next. The search ends when the m_w of the best is known.
// Three finalists are compared, and more as long as each of them has an m_i that does not run. Cases in which another finalist
// lost most are evaluated first.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/nudges.h"
#include "pipeline/report/improvement_page.h"

namespace dresslife::pipeline {

/// Runs the nudges with these indices. Returns the outcomes in the same order.
using RunNudges = std::function<std::vector<Outcome>(const std::vector<std::size_t>&)>;

struct Finalist {
  Outcome drawn;
  std::vector<Nudge> nudges;
  RunNudges run;
  /// Runs without uncertain inputs. Returns first the outcome without offset, then those of the nudges. Absent: all runs are full.
  RunNudges run_known{};
};

/// Returns a finalist with its nudges and both of its runs. drawn: its outcome without offset. jobs_with: returns its jobs with further
/// changes, as jobs of a run with this short name. run: returns the outcomes of jobs in their order.
Finalist finalist_of(const Outcome& drawn, const MountingTolerance& tolerance,
                     const std::function<std::vector<StudyJob>(const std::vector<std::string>& sets,
                                                               const std::string& name)>& jobs_with,
                     const std::function<std::vector<Outcome>(const std::vector<StudyJob>&)>& run);

/// Returns the outcome of a nudge by (T2). off, own: in runs without uncertain inputs, with the offset and without. drawn: in a full
/// run without offset. A life whose ratio is not finite is the shorter one.
Outcome estimated(const Outcome& off, const Outcome& own, const Outcome& drawn);

/// State before the next runs. In the unit of a full run: done, those that follow next, and all if the leading finalist stays
/// the best.
struct ToleranceCount {
  double done = 0, next = 0, likely = 0;
  std::string words;  ///< "8 of 24 cases estimated"
};
using ToleranceProgress = std::function<void(const ToleranceCount&)>;

/// The usual time of all these runs, in full runs of one job: 24 cases at 0.2 of a full run, and four full runs.
inline constexpr double usual_tolerance_time = 9;

struct WithinTolerance {
  std::vector<ImprovementStory::Nudge> nudges;  ///< evaluated nudges
  std::vector<std::size_t> numbers;             ///< (evaluated) index in Finalist::nudges, rising
  Merit worst;                                  ///< m_w of the evaluated nudges
  Outcome worst_outcome;            ///< the shortest life, the largest violation and the earliest modes of all cases
  bool whole = false;               ///< whether m_w is known
  std::vector<Outcome> outcomes{};  ///< (evaluated)
};

/// Evaluates the nudges of one finalist until m_w is known or `enough` returns true for the worst merit so
/// far, without estimated lives. others: finalists of the same job, which determine the order.
WithinTolerance within_tolerance(const Finalist& finalist, const Outcome& as_it_is,
                                 const std::function<bool(const Merit&)>& enough,
                                 const std::vector<WithinTolerance>& others, const ToleranceProgress& progress);

/// Returns the results of the finalists that had to be evaluated, in their order; at least one is whole. best_first: finalists by
/// falling merit. as_it_is: outcome of the original job (merit_of()). own: index of the original job, which is in the answer, at
/// least with the bound of its merit without offset.
std::vector<WithinTolerance> within_tolerance(const std::vector<Finalist>& best_first, const Outcome& as_it_is,
                                              const ToleranceProgress& progress = {},
                                              std::optional<std::size_t> own = {});

/// Returns the index of the largest m_w among the whole results. own: index of the original job. It stays the choice if no other
/// result is clearly better than its bound (merit.h). Precondition: at least one is whole.
std::size_t best_within(const std::vector<WithinTolerance>& judged, std::optional<std::size_t> own = {});

/// Returns a line: "With a clamp or length off by 10 mm, .. or an end turned by 10 deg the wires live at least 0.7 times as long,
/// ..."; empty without nudges.
std::string tolerance_words(const std::vector<ImprovementStory::Nudge>& nudges, const MountingTolerance& tolerance);

}  // namespace dresslife::pipeline
