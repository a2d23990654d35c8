// Changes of a program's lines, written in its own language and as a patch (unified diff) that `patch` and `git
// apply` take. Everything else in the file stays as it is, byte by byte; each changed line has the reason beside it.
//
//   speed          RAPID: [0.7*v500.v_tcp,...]; KRL: BAS(#VEL_PTP,..) before and behind; Fanuc, INFORM, URScript: the number
//   configuration  RAPID: [p10.trans,p10.rot,[1,0,0,0],p10.extax]; KRL: S and T; Fanuc: CONFIG, of a new P[n] where
//                  other lines use the old one
//   joints         of a target in joint angles
//   point          RAPID: MoveAbsJ, KRL: PTP {A1 ..}: a line before it
//
// A change that a writer cannot write is an InputError at the line. The caller reads the text back
// (sim/program/import.h) and compares it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/import.h"

namespace dresslife::sim {

struct LineChange {
  pipeline::Where where{};                        ///< of the instruction: a line of the file
  std::optional<double> speed{};                  ///< share of its speed
  std::optional<ArmConfiguration> configuration{};  ///< of its target
  std::vector<double> joints{};                   ///< its target instead [rad]; empty: as it is
  std::vector<double> point{};                    ///< joint angles on the way to it [rad]; empty: none
  std::string reason{};                           ///< ASCII, some words
};

struct Rewritten {
  std::string text, patch;
};

/// file: as the program's places name it, and `bytes` its contents. program: as it was read from them. Changes of
/// other files are left out. shown: the file's name in the patch.
Rewritten rewritten(Language language, const std::string& file, const std::string& bytes, const Program& program,
                    const std::vector<LineChange>& changes, const std::string& shown);

}  // namespace dresslife::sim
