// Relative life: the cycles of a cable's rating test that do the damage of one hour of a program.
//
// With L_p the repeats of the program, and L_r the cycles of the rig, until the worst conductor of that cable
// has lost fatigue.failed_wires_percent of its wires at one place, all wires' lives median
// (/conductor/place_life), and t the seconds of a repeat,
//     cycles per hour = (3600 / t) L_r / L_p,      relative life = rated cycles / cycles per hour.
// The maker's number replaces the model's: a factor by which both lives are wrong cancels.
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
  Study rigs;  ///< each once; the name of a rig's job is the digest of its settings
  std::vector<RatedCable> cables;
};

/// Whether a cable in it has a rating.
bool has_ratings(const Job& job);

/// The rigs of all ratings, each with the strain and fatigue settings of its job, but a gate of 1e-6 at most
/// as all rigs have it. Precondition: an expanded study; jobs that cannot be run are left out.
RatedStudy rated_study(const Study& study);

/// Sets the relative life of every finished row: of several ratings the shortest. rigs: rows of rated.rigs. Returns a
/// line for each rating without a result, with the reason.
std::vector<std::string> relate(const RatedStudy& rated, const std::vector<RankingRow>& rigs,
                                std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
