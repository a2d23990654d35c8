// Relative life: one hour of a program does the damage of so many cycles of the test in which a cable is
// rated.
//
// With L_p the repeats of the program, and L_r the cycles of the rig, until the worst conductor of that cable
// has lost fatigue.failed_wires_percent of its wires at one place, all wires' lives median
// (/conductor/place_life), and t the seconds of a repeat,
//     cycles per hour = (3600 / t) L_r / L_p,      relative life = rated cycles / cycles per hour.
// The maker's number takes the place of the model's: a factor by which both lives are wrong cancels.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// A rating of a cable of a job, and the job of its rig.
struct RatedCable {
  std::string job;        ///< of the study
  std::string dresspack;  ///< its name where the job has several; else empty
  std::string cable;      ///< its name; empty: all of the dresspack, which is a cable itself
  std::string name;       ///< for people
  std::string rig_job;    ///< of rigs
  std::string rig;        ///< in words
  double rated_cycles = 0;
};

struct RatedStudy {
  Study rigs;  ///< each once: a rig's job is named by the digest of what it says
  std::vector<RatedCable> cables;
};

/// Whether a maker promises anything of a cable in it.
bool has_ratings(const Job& job);

/// The rigs of all ratings, each with the strain and fatigue settings of its job, but a gate of 1e-6 at most
/// as all rigs have it. Precondition: an expanded study; jobs that cannot be run are left out.
RatedStudy rated_study(const Study& study);

/// Puts the relative life into every row that is done: of several ratings the one with the shortest. rigs: of
/// rated.rigs. Returns a line for each rating that says nothing, with the reason.
std::vector<std::string> relate(const RatedStudy& rated, const std::vector<RankingRow>& rigs,
                                std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
