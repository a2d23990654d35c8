// Damage of a strain history (Miner 1945), (10): D = sum over cycles of count / N, life = 1 / D repeats.
//
// The model is evaluated in two ways. evaluate_cycles() lists every cycle with its exact stress and damage. DamageCounter sums
// the damage of a history from tables, for the millions of histories of a dresspack.
// Assumptions: damage adds up linearly, in any order. The repeated history starts on the cyclic curve at its largest |strain|
// ((F4) in fatigue/stress_path.h). From there its offset stress may relax (relaxation.h), so each repeat is nearly equal to the
// previous one.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fatigue/kernels/lockstep.h"
#include "fatigue/rainflow.h"
#include "fatigue/strain_life.h"
#include "pipeline/base/instruction_set.h"
#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

/// A counted cycle with its stress and damage.
struct DamagingCycle {
  Cycle cycle;
  double stress_max = 0, stress_mean = 0;  ///< [Pa]
  double damage = 0;                       ///< count / N
};

/// Returns every cycle of a history under `settings.counting`, in the order in which they close, with exact stress and life.
/// share: remaining share of the offset stress (F22) of a repeated history.
std::vector<DamagingCycle> evaluate_cycles(std::span<const Reversal> reversals, const pipeline::Material& material,
                                           const pipeline::Fatigue& settings, double share = 1);

/// Returns the stress [Pa] along a history (sample), which agrees with evaluate_cycles() at the reversals. If the history is
/// counted as repeated, the path starts at its largest |strain|. Arguments as in evaluate_cycles().
std::vector<double> stress_along(std::span<const double> strain, const pipeline::Material& material,
                                 const pipeline::Fatigue& settings, double share = 1);

/// Returns (10) over listed cycles.
double sum_of_damage(std::span<const DamagingCycle> cycles);

/// The two samples to which a cycle's damage can be assigned: where its range opens, and where the range is complete.
/// (The loop itself closes later, when the strain returns to the cycle's begin.) Each assignment contains the whole
/// damage. The share of a program line is the mean of the two.
enum class Moment { opens, closes };

/// Returns the damage by sample: (sample).
std::vector<double> damage_over_time(std::span<const DamagingCycle> cycles, std::size_t samples,
                                     Moment moment = Moment::closes);

/// Returns the damage by program step (step): sum of `damage` (sample) over the samples of each step. Samples outside any line
/// (-1) are not counted. Precondition: step (sample) lies in [-1, steps).
std::vector<double> damage_by_step(std::span<const double> damage, std::span<const std::int32_t> step,
                                   std::size_t steps);

/// Effect of a compressive mean stress: by the rule of the job, or that of zero mean stress, (F38):
///     s_m < 0:  s_max is replaced by s_max - s_m, then s_m by 0.
/// (F38) is for the bound of glued cables. Glued wires keep a compressive mean stress that slip removes. With its effect a glued
/// life can exceed the life with friction, so a lower bound must not contain it.
enum class Compression { by_rule, without_effect };

/// Damage of histories of one material. Built once, then only read.
class DamageCounter {
 public:
  /// set: instructions for counting. longest: a cycle with a longer life [reversals] does no damage.
  /// @throws pipeline::InputError as pipeline::instruction_set().
  DamageCounter(const pipeline::Material& material, const pipeline::Fatigue& settings,
                pipeline::InstructionSet set = pipeline::instruction_set(), double longest = most_reversals,
                Compression compression = Compression::by_rule);
  ~DamageCounter();
  DamageCounter(DamageCounter&&) noexcept;

  /// Memory that one thread uses for one history after the other.
  struct Workspace {
    std::vector<double> period, strain, stress;
    std::vector<std::uint32_t> open;
    std::vector<LockstepLine> lines;
  };
  /// Returns the damage per repeat of the history with these reversal strains. share: remaining share of the offset if the mean
  /// stress relaxes; default: the share expected over the life. Relative difference from the sum over evaluate_cycles(): below
  /// `table_error` for b <= -0.05.
  double operator()(std::span<const float> strains, Workspace& workspace,
                    double share = StrainList::expected_share) const;
  static constexpr double table_error = 1e-5;
  /// Computes the damage of many histories, (history), several times as fast. The damage of one history does not depend on the
  /// other histories of the call.
  void operator()(std::span<const StrainList> histories, std::span<double> damage, Workspace& workspace) const;

  /// Returns whether the offset falls from repeat to repeat. Then the mean damage over a life differs from that of operator().
  bool settles() const;
  /// Returns 1 / life (F23); the value of operator() if the offset does not fall.
  double settled_damage(std::span<const float> strains, Workspace& workspace) const;
  /// Returns the mean share of the offset over a life of `repeats`.
  double share_over(double repeats, std::span<const float> strains) const;

  /// Returns whether rises and falls must alternate: true if the history is counted once, as half cycles.
  bool must_alternate() const;

  /// Returns the history's cycles with stress and damage from the same tables, in the order in which they close. Their sum is
  /// the value of operator() with this share, to rounding.
  std::vector<DamagingCycle> cycles(std::span<const Reversal> reversals, double share = 1) const;

 private:
  double damage_once(const StrainList& strains, Workspace& workspace) const;

  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

/// Returns the repeats to failure; infinity for a damage of 0.
double life_in_repeats(double damage);
double hours(double repeats, double motion_duration);  ///< duration of one repeat [s]

}  // namespace dresslife::fatigue
