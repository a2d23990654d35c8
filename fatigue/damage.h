// Damage of a strain history (Miner 1945), (10): D = sum over cycles of count / N, life = 1 / D repeats.
//
// Two evaluations of the same model: evaluate_cycles() lists every cycle with its stress and damage, exact;
// DamageCounter sums a history's damage from tables, for the millions of histories of a dresspack.
// Assumptions: damage adds up linearly, in any order; the repeated history starts from the largest |strain|
// on the cyclic curve (README.md, F4), and from there the stress that it is off centre by may relax
// (relaxation.h), so that each repeat is nearly like the one before.
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

/// A counted cycle with its stress and what it does.
struct DamagingCycle {
  Cycle cycle;
  double stress_max = 0, stress_mean = 0;  ///< [Pa]
  double damage = 0;                       ///< count / N
};

/// Every cycle of a history under `settings.counting`, in the order in which they close; exact stress and
/// life. Of the stress that a repeated history is off centre by (F22) `share` is left.
std::vector<DamagingCycle> evaluate_cycles(std::span<const Reversal> reversals,
                                           const pipeline::Material& material,
                                           const pipeline::Fatigue& settings, double share = 1);

/// Stress [Pa] along a history (sample) as evaluate_cycles() has it at the reversals: of a repeat that began
/// at its largest |strain|, where it is counted as repeated. Same arguments.
std::vector<double> stress_along(std::span<const double> strain, const pipeline::Material& material,
                                 const pipeline::Fatigue& settings, double share = 1);

/// (10) over listed cycles.
double sum_of_damage(std::span<const DamagingCycle> cycles);

/// The two samples to which a cycle's damage may be assigned: where its range opens, and where the range is complete.
/// (The loop itself closes later, when the strain returns to the cycle's begin.) Both assignments contain the whole
/// damage. The share of a program line is the mean of the two.
enum class Moment { opens, closes };

/// Damage placed in time, (sample).
std::vector<double> damage_over_time(std::span<const DamagingCycle> cycles, std::size_t samples,
                                     Moment moment = Moment::closes);

/// Damage by program step, (step): sum of `damage` (sample) over the samples of each step.
/// Samples outside any line (-1) count for none. Precondition: step (sample) lies in [-1, steps).
std::vector<double> damage_by_step(std::span<const double> damage, std::span<const std::int32_t> step,
                                   std::size_t steps);

/// Damage of histories that are made of one material; built once, const in use.
class DamageCounter {
 public:
  /// set: instructions to count with. longest: a cycle that the metal would bear more often [reversals] does no
  /// damage. @throws pipeline::InputError as pipeline::instruction_set().
  DamageCounter(const pipeline::Material& material, const pipeline::Fatigue& settings,
                pipeline::InstructionSet set = pipeline::instruction_set(), double longest = most_reversals);
  ~DamageCounter();
  DamageCounter(DamageCounter&&) noexcept;

  /// Memory that one thread reuses between histories.
  struct Workspace {
    std::vector<double> period, strain, stress;
    std::vector<std::uint32_t> open;
    std::vector<LockstepLine> lines;
  };
  /// Damage per repeat of the history with these reversal strains; where its mean stress relaxes, with the
  /// share of the offset that is expected over its life, or with the `share` that is given. Relative
  /// difference from the sum over evaluate_cycles(): below `table_error` for b <= -0.05.
  double operator()(std::span<const float> strains, Workspace& workspace,
                    double share = StrainList::expected_share) const;
  static constexpr double table_error = 1e-5;
  /// The same of many histories, (history): several times as fast. Each one's damage is the same whatever the
  /// others are.
  void operator()(std::span<const StrainList> histories, std::span<double> damage,
                  Workspace& workspace) const;

  /// Whether the mean over a life is another than operator() gives: where the offset falls from repeat to
  /// repeat.
  bool settles() const;
  /// 1 / life (F23): what operator() gives but where the offset falls.
  double settled_damage(std::span<const float> strains, Workspace& workspace) const;
  /// Mean share of the offset over a life of so many repeats.
  double share_over(double repeats, std::span<const float> strains) const;

  /// Whether rises and falls must alternate: where the history is counted once, as half cycles.
  bool must_alternate() const;

  /// The history's cycles with stress and damage by the same tables, in the order in which they close. Their
  /// sum is what operator() gives with this share, to rounding.
  std::vector<DamagingCycle> cycles(std::span<const Reversal> reversals, double share = 1) const;

 private:
  double damage_once(const StrainList& strains, Workspace& workspace) const;

  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

/// Repeats to failure; infinity where the damage is 0.
double life_in_repeats(double damage);
double hours(double repeats, double motion_duration);  ///< duration of one repeat [s]

}  // namespace dresslife::fatigue
