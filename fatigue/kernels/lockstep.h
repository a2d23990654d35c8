// Repeating counting (F1) with stress (F3, F4) and damage of several histories at once, one in each lane of a register. This
// is the innermost loop of the stage, compiled once per instruction set (body.h).
//
// Neighbouring wires nearly always turn at the same samples and close the same loops, so one flow of control serves all lanes: a
// step takes the next reversal of each lane, closes loops until no lane closes any, and opens the next loop. A lane without a
// loop to close waits. The result of a lane depends only on its own history.
//
// This header contains only plain data and pointers, so that no shared inline function is compiled for the wrong machine.
#pragma once

#include <cstddef>

#include "fatigue/log_table.h"
#include "pipeline/base/instruction_set.h"

namespace dresslife::fatigue {

/// Material data of the loop.
struct LockstepTables {
  /// Stress range as a function of strain range: `elastic` times it below branch.low, `far_branch` beyond branch.high.
  double elastic = 0;
  LogTable::View branch;
  double (*far_branch)(const void* material, double range) = nullptr;

  /// Table of damage over amplitude, or over amplitude times largest stress: 0 below its low end, at_high from its high end on.
  LogTable::View damage;
  double damage_at_high = 0;
  bool times_stress_max = false;
  /// Used instead of the table if it is not null.
  double (*damage_of)(const void* material, double amplitude, double stress_max, double stress_mean) = nullptr;
  const void* material = nullptr;  ///< argument of the functions

  double endurance = 0;  ///< amplitudes up to it do no damage

  /// Returns the size of the stress at the history's largest |strain| after the offset (F22) has relaxed to `share`. Null: the
  /// stress lies on the cyclic curve. largest: with its sign; share: as in StrainList.
  double (*first_stress)(const void* material, double largest, double range, double share) = nullptr;
};

/// Strains of the reversals of one history [1].
struct StrainList {
  const float* strain;
  std::size_t size;
  double share = expected_share;  ///< remaining share of the offset
  /// The share expected over the history's life.
  static constexpr double expected_share = -1;
};

/// Unit of the loop's memory: the size of the widest register.
struct alignas(64) LockstepLine {
  unsigned char bytes[64];
};

struct Lockstep {
  std::size_t lanes;
  /// Returns the number of LockstepLine for lists of up to `longest` reversals.
  std::size_t (*lines)(std::size_t longest);
  /// Computes the damage of up to `lanes` histories. Returns bits, set for histories that do not alternate; their damage is
  /// undefined.
  unsigned (*sum)(const LockstepTables&, const StrainList* histories, std::size_t count, LockstepLine* memory,
                  double* damage);
};

/// Precondition: this machine can run the set.
const Lockstep& lockstep_for(pipeline::InstructionSet set);

}  // namespace dresslife::fatigue
