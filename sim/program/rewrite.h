// Changes of a program's lines, written in its own language and as a patch (unified diff) for `patch` and `git
// apply`. All other bytes of the file stay the same; each changed line has a comment with the reason.
//
//   speed          RAPID: [0.7*v500.v_tcp,...]; KRL: BAS(#VEL_PTP,..) before and after; Fanuc, INFORM, URScript: the number
//   configuration  RAPID: [p10.trans,p10.rot,[1,0,0,0],p10.extax]; KRL: S and T; Fanuc: CONFIG, in a new P[n] if
//                  other lines use the old P[n]
//   joints         of a target in joint angles
//   point          RAPID: MoveAbsJ, KRL: PTP {A1 ..}: an additional line before the move
//
// A change that cannot be written is an InputError at the line. The caller reads the new text
// (sim/program/import.h) and compares the result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/import.h"

namespace dresslife::sim {

struct LineChange {
  pipeline::Where where{};                          ///< line of the instruction
  std::optional<double> speed{};                    ///< factor of the instruction's speed
  std::optional<ArmConfiguration> configuration{};  ///< new configuration of the target
  std::vector<double> joints{};                     ///< new target [rad]; empty: unchanged
  std::vector<double> point{};                      ///< additional target before the move [rad]; empty: none
  std::string reason{};                             ///< some words in ASCII
};

struct Rewritten {
  std::string text, patch;
  std::vector<int> numbers;  ///< of the file's lines in the changed text
};

/// Returns the changed text of a file and the patch. file: the file's name in the program's places; bytes: its
/// contents; program: the result of reading it. Changes of other files are ignored. shown: the file's name in the patch.
Rewritten rewritten(Language language, const std::string& file, const std::string& bytes, const Program& program,
                    const std::vector<LineChange>& changes, const std::string& shown);

}  // namespace dresslife::sim
