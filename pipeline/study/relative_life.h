// Relative life: the cycles of a cable's rating test that do the damage of one hour of a program.
//
// L_p: repeats of the program, L_r: cycles of the rig, until the worst conductor of that cable has lost
// fatigue.failed_wires_percent of its wires at one place, with the median life of all wires (/conductor/place_life).
// t: duration of one repeat [s].
//     cycles per hour = (3600 / t) L_r / L_p,      relative life = rated cycles / cycles per hour.
// The maker's number replaces the model's life: a factor that makes both computed lives wrong cancels.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// A rating of a cable of a job, with the job that simulates its rig.
struct RatedCable {
  std::string job;        ///< name of the job in the study
  std::string dresspack;  ///< name of the dresspack if the job has several; else empty
  std::string cable;      ///< name of the cable; empty: the whole dresspack, which is a cable itself
  std::string name;       ///< name of the cable for messages
  std::string rig_job;    ///< name of the job in RatedStudy::rigs
  std::string rig;        ///< description of the rig
  double rated_cycles = 0;
};

struct RatedStudy {
  Study rigs;  ///< each rig once; the name of a rig's job is the digest of its settings
  std::vector<RatedCable> cables;
};

/// Returns whether a cable of the job has a rating.
bool has_ratings(const Job& job);

/// Returns the rigs of all ratings, each with the strain and fatigue settings of its job, and with a gate of at most 1e-6, as
/// in all rigs. Jobs that cannot be run are left out. Precondition: an expanded study.
RatedStudy rated_study(const Study& study);

/// Sets the relative life of every finished row, from the rating with the shortest life. rigs: rows of rated.rigs. Returns a
/// line with the reason for each rating without a result.
std::vector<std::string> relate(const RatedStudy& rated, const std::vector<RankingRow>& rigs,
                                std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
