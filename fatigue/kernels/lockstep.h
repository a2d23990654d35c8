// Repeating counting (F1) with stress (F3, F4) and damage of several histories at once, one in each lane of a
// register: the innermost loop of the stage, compiled once per instruction set (body.h).
//
// Neighbouring wires turn at the same samples and close the same loops nearly always, so one flow of control
// serves all lanes: a step takes the next reversal of each, closes loops until no lane closes any, and opens
// the next. A lane that has nothing to close waits. What a lane computes depends on its own history alone.
//
// Everything here is plain data and pointers, so that no shared inline function can be compiled for the wrong
// machine.
#pragma once

#include <cstddef>

#include "fatigue/log_table.h"
#include "pipeline/base/instruction_set.h"

namespace dresslife::fatigue {

/// What the loop reads for a material.
struct LockstepTables {
  /// Stress range over strain range: `elastic` times it below branch.low, beyond branch.high `far_branch`.
  double elastic = 0;
  LogTable::View branch;
  double (*far_branch)(const void* material, double range) = nullptr;

  /// Damage by a table over amplitude, or amplitude times largest stress: 0 below its low end, at_high from
  /// its high end on.
  LogTable::View damage;
  double damage_at_high = 0;
  bool times_stress_max = false;
  /// Instead of the table, where it is not null.
  double (*damage_of)(const void* material, double amplitude, double stress_max,
                      double stress_mean) = nullptr;
  const void* material = nullptr;  ///< handed to the functions

  double endurance = 0;  ///< amplitudes up to it do no damage

  /// Size of the stress at the largest |strain| of a history that a part of its offset (F22) has left, where
  /// it is not null; else there it lies on the cyclic curve. largest: with its sign; share: StrainList's.
  double (*first_stress)(const void* material, double largest, double range, double share) = nullptr;
};

/// Strains of the reversals of one history [1].
struct StrainList {
  const float* strain;
  std::size_t size;
  double share = expected_share;  ///< of the offset that is left
  /// That which is expected over the history's life.
  static constexpr double expected_share = -1;
};

/// Memory of the loop, as wide as the widest register.
struct alignas(64) LockstepLine {
  unsigned char bytes[64];
};

struct Lockstep {
  std::size_t lanes;
  /// Lines that it needs for lists of up to this many reversals.
  std::size_t (*lines)(std::size_t longest);
  /// Damage of up to `lanes` histories. Returns bits: set for those that do not alternate. Their damage is undefined.
  unsigned (*sum)(const LockstepTables&, const StrainList* histories, std::size_t count, LockstepLine* memory,
                  double* damage);
};

/// Precondition: this machine has it.
const Lockstep& lockstep_for(pipeline::InstructionSet set);

}  // namespace dresslife::fatigue
